"""A run of mdat that the tests read: recorded, with its folder; flown once."""
import atexit
import functools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / 'python'))
MDAT = os.environ.get('LASSO_MDAT', str(TOP / 'out/build/mdat/mdat'))
MISSION = TOP / 'cfg/missions/hubble_tenth.toml'
FRAMES = 12


@functools.lru_cache(None)
def folder():
    held = tempfile.TemporaryDirectory()
    atexit.register(held.cleanup)
    return pathlib.Path(held.name)


def mdat(*arguments):
    """What mdat prints; its own complaint where it fails."""
    done = subprocess.run([MDAT, *map(str, arguments)], cwd=folder(), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f'mdat {arguments[0]}: exit code {done.returncode}: {done.stderr}')
    return done.stdout


@functools.lru_cache(None)
def run():
    """The folder with run/ (results) and spin.mcap."""
    mdat('run', MISSION, '--scenario', 'spin', '--frames', FRAMES, '--no-report', '--record', 'spin.mcap', '--out', 'run')
    return folder()


@functools.lru_cache(None)
def decoded():
    """What mdat decode says of the run's telemetry: numbers as they read back to the same bits."""
    return json.loads(mdat('decode', run() / 'run/telemetry.ccsds', '--format', 'json'))['packets']
