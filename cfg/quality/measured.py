#!/usr/bin/env python3
"""What figures are of: commit, date and machine, and the sources that decide them.

measured.py NAME FILE: adds this to FILE, the JSON results in out/NAME (command_of in gate.py). docs/figures writes no figure whose sources have changed since.
"""
import datetime
import hashlib
import json
import os
import pathlib
import subprocess
import sys

import gate as gates

FLIGHT = ('CMakeLists.txt', 'cfg/capacities.hpp', 'cfg/cmake/options.cmake', 'cfg/cmake/rooms.cmake', 'fsw', 'hal_lcs')
SIMULATION = ('cfg/missions', 'cfg/models', 'hal_sim', 'mdat/common', 'mdat/missiondb', 'mdat/modelc', 'mdat/run')
TARGET = ('bsp', 'cfg/toolchains')
SOURCES = {
    'run': (*FLIGHT, *SIMULATION),
    'bench': (*FLIGHT, *SIMULATION, 'ft/bench'),
    'benchmark': (*FLIGHT, *SIMULATION, 'ft/bench', 'mdat/benchmark', 'mdat/bodies', 'mdat/replay'),
    'count-estimate': (*FLIGHT, *SIMULATION, *TARGET, 'ft/golden', 'ft/ppc603e'),
    'prove': (*FLIGHT, *TARGET),
}


def first_line(*command):
    try:
        return next(iter(subprocess.run(command, capture_output=True, text=True, check=False).stdout.splitlines()), '')
    except OSError:
        return ''


def sources(name, top=gates.TOP):
    """A digest of the sources of results in out/NAME as they are now; empty outside of a repository."""
    files = subprocess.run(['git', '-C', str(top), 'ls-files', '-z', '--', *SOURCES[name]], capture_output=True, check=False).stdout.split(b'\0')
    digest = hashlib.sha256()
    for file in filter(None, sorted(files)):
        path = pathlib.Path(top, os.fsdecode(file))
        digest.update(file + b'\0' + (hashlib.sha256(path.read_bytes()).digest() if path.is_file() else b''))
    return digest.hexdigest() if any(files) else ''


def processor():
    try:
        lines = pathlib.Path('/proc/cpuinfo').read_text(encoding='utf-8').splitlines()
    except OSError:
        return 'unknown'
    return next((line.split(':', 1)[1].strip() for line in lines if line.startswith('model name')), 'unknown')


def measured(name):
    return {'commit': gates.commit(), 'date': datetime.date.today().isoformat(), 'processor': processor(), 'cores': os.cpu_count(),
            'compiler': first_line('g++', '--version'), 'sources': sources(name)}


def main(name, file):
    path = pathlib.Path(file)
    path.write_text(json.dumps(json.loads(path.read_text(encoding='utf-8')) | {'measured': measured(name)}, indent=1) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main(*sys.argv[1:])
