"""Counts the instructions that the emulated 603e executes between two functions of a program (count_plugin.c)."""
import bisect
import collections
import re
import subprocess

import instructions

# The counter's own test: a loop of so many instructions between the markers.
LOOP = 1000000
LOOP_TOLERANCE = 20
PROBE = r'''
extern "C" {
[[gnu::noinline]] void lasso_estimate_begins() { asm volatile(""); }
[[gnu::noinline]] void lasso_estimate_ends() { asm volatile("" : : : "memory"); }
}
int main() {
  lasso_estimate_begins();
  asm volatile("mtctr %0\n1: bdnz 1b" : : "r"(LOOP) : "ctr");
  lasso_estimate_ends();
}
'''


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def build_plugin(out):
    plugin = out / 'count_plugin.so'
    run('gcc', '-std=c11', '-O2', '-Wall', '-Wextra', '-Werror', '-shared', '-fPIC', '-o', plugin, 'ft/ppc603e/count_plugin.c')
    return plugin


def functions(program):
    """Ascending addresses of the program's functions, and their names."""
    rows = [line.split(' ', 2) for line in run('powerpc-linux-gnu-nm', '-C', '-n', '--defined-only', program).splitlines()]
    rows = [(int(address, 16), name) for address, kind, name in rows if kind in 'tTwW']
    return [row[0] for row in rows], [row[1] for row in rows]


def brief(name):
    """A function's name without arguments, template arguments and what the compiler made of it."""
    name = name.replace('(anonymous namespace)::', '').removeprefix('void ')
    while re.search(r'<[^<>]*>', name):
        name = re.sub(r'<[^<>]*>', '', name)
    return name.split('(')[0].split(' [')[0].split()[-1]


def markers(starts, names):
    return [starts[names.index(name)] for name in ('lasso_estimate_begins', 'lasso_estimate_ends')]


def functions_with_unit(program, starts):
    """Which of the functions that begin there have instructions of the floating-point unit."""
    code = run('powerpc-linux-gnu-objdump', '-d', '--no-show-raw-insn', program).splitlines()
    places = (line.split(':', 1)[0] for line in code if instructions.FLOATING.search(line))
    return {bisect.bisect_right(starts, int(place, 16)) - 1 for place in places}


def self_test(gate, plugin):
    source, program, counts = (gate.out / name for name in ('probe.cpp', 'probe', 'probe.txt'))
    with open(source, 'w', encoding='ascii') as file:
        file.write(PROBE)
    run('powerpc-linux-gnu-g++', '-mcpu=603e', '-O2', '-static', f'-DLOOP={LOOP}', '-o', program, source)
    begin, end = markers(*functions(program))
    run('qemu-ppc', '-cpu', '603e', '-plugin', f'{plugin},begin={begin:x},end={end:x},out={counts}', program)
    with open(counts, encoding='ascii') as lines:
        counted = int(lines.readline().split()[1])
    if not LOOP <= counted <= LOOP + LOOP_TOLERANCE:
        gate.stop(f'{counted} instructions counted in a loop of {LOOP}')


def split(blocks, starts, names):
    totals = collections.Counter()
    for address, n in blocks:
        totals[brief(names[bisect.bisect_right(starts, address) - 1])] += n
    return totals


def count(program, plugin, ends, counts, *arguments):
    """Instructions of each pass, instructions by block, and what the program said."""
    options = f'{plugin},begin={ends[0]:x},end={ends[1]:x},out={counts}'
    said = run('qemu-ppc', '-cpu', '603e', '-plugin', options, program, *arguments)
    calls, blocks = [], []
    with open(counts, encoding='ascii') as lines:
        for kind, *values in map(str.split, lines):
            if kind == 'call':
                calls.append(int(values[0]))
            else:
                blocks.append((int(values[0], 16), int(values[1])))
    return calls, blocks, said


def prepare(gate):
    """The tools, and the plugin, which counts a loop rightly."""
    for tool in ('qemu-ppc', 'powerpc-linux-gnu-g++', 'powerpc-linux-gnu-nm'):
        gate.tool(tool)
    plugin = build_plugin(gate.out)
    self_test(gate, plugin)
    return plugin
