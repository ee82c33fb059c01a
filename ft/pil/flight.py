"""A flight of the rig with words of its own, in a folder of its own, and what its telemetry says."""
import os
import re

import emulator
import run

FRAMES, SECONDS = 3, 240  # of a short one, and of the host
TELEMETRY = re.compile(r'telemetry: mode (-?\d+), reset_cause (-?\d+), (\d+) poses, \d+ valid, last valid (-?\d+), other bytes (\d+), lost scans (-?\d+), last loss (-?\d+)')


def fly(gate, host, elf, name, *more, mission=run.MISSION, scenario=run.SCENARIO, frames=FRAMES, seconds=SECONDS, **options):
    folder = gate.out / name
    os.makedirs(folder, exist_ok=True)
    code, said, machine = emulator.fly(f'{host}/ft/pil/pil_rig', elf, [mission, scenario, frames, folder, *more], folder, seconds, **options)
    print('\n'.join(f'  {line}' for line in said.splitlines()))
    return code, said, machine
