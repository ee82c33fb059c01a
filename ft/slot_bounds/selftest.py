"""The program's own test: works whose passes are known, bounded as the flight image is, and counted on the emulated 603e.

No count is above its bound; where only one way leads through a work, both are the same number.
"""
import pathlib
import sys

import bounds
import cost
import image
import lines

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / 'ppc603e'))
import counter  # noqa: E402

# Each work is called between two markers, by number, with eight times the second word.
WORKS = r'''
namespace {

constexpr int kRows = 7;
constexpr int kColumns = 5;
volatile int sink = 0;
int numbers[64];

[[gnu::noinline]] void touch(int i) { sink = i; }

}  // namespace

extern "C" {
[[gnu::noinline]] void lasso_estimate_begins() { asm volatile(""); }
[[gnu::noinline]] void lasso_estimate_ends() { asm volatile("" : : : "memory"); }

[[gnu::noinline]] void work_nothing(int) { asm volatile(""); }

// One way: its count is exact.
[[gnu::noinline]] void work_straight(int) {
  for (int i = 0; i < 1000; ++i) sink = i;
}

// The same, nested, with a call.
[[gnu::noinline]] void work_nested(int) {
  for (int i = 0; i < kRows; ++i) {
    for (int k = 0; k < kColumns; ++k) touch(k);
  }
}

// Passes by the argument, which the table says is at most 64: exact there but for the pass that is added to bounds of sources.
[[gnu::noinline]] void work_stated(int n) {
  for (int i = 0; i < n; ++i) touch(numbers[i]);
}

// The inner loop runs as often as the outer one has, so that its bound counts twice what it does.
[[gnu::noinline]] void work_triangle(int n) {
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) touch(k);
  }
}

// Two ways, of which the dearer one counts, and an end that comes early.
[[gnu::noinline]] void work_ways(int n) {
  for (int i = 0; i < 64; ++i) {
    if (numbers[i] == n) {
      touch(i);
      touch(i + 1);
    } else if (numbers[i] > n) {
      return;
    }
  }
}
}

// The program's beginning: words of the command line lie on the stack.
asm(".globl _start\n_start:\n lwz 3,0(1)\n addi 4,1,4\n b begin\n");

extern "C" [[noreturn]] void begin(int count, char** words) {
  void (*const works[])(int) = {work_nothing, work_straight, work_nested, work_stated, work_triangle, work_ways};
  const int which = count > 1 ? words[1][0] - '0' : 0, n = count > 2 ? words[2][0] - '0' : 0;
  lasso_estimate_begins();
  works[which](8 * n);
  lasso_estimate_ends();
  asm volatile("li 0,1\n li 3,0\n sc");
  for (;;) sink = 0;
}
'''

NAMES = ('nothing', 'straight', 'nested', 'stated', 'triangle', 'ways')
EXACT = ('nothing', 'straight', 'nested')
MOST = 8  # the largest second word: 64 passes
TABLE = {'behind': {}, 'functions': {}, 'bytes': {},
         'sized': {}, 'together': {}, 'loops': {'works.cpp': {'for (int i = 0; i < n; ++i)': 'n', 'for (int k = 0; k < i; ++k)': 'n'}}}
FLAGS = ('-mcpu=603e', '-O3', '-g', '-static', '-nostdlib', '-fno-pic', '-no-pie', '-msdata=none', '-fno-exceptions', '-fno-asynchronous-unwind-tables',
         '-fno-stack-protector')


def build(out):
    source, program = out / 'works.cpp', out / 'works'
    source.write_text(WORKS, encoding='ascii')
    counter.run('powerpc-linux-gnu-g++', *FLAGS, '-o', program, source)
    return program


def bounds_of(program, out):
    """Of each work, by its name."""
    works = image.Image(program)
    table = bounds.Table(TABLE, [])
    costs = cost.Costs(works, bounds.Bounds(works, lines.Lines(program, out), table, out, {}), {'n': 8 * MOST})
    found = {function.name.removeprefix('work_'): costs.of(at).total for at, function in works.functions.items() if function.name.startswith('work_')}
    if costs.missing:
        raise ValueError(f'{len(costs.missing)} loops of the works have no bound')
    return found


def counted(program, plugin, out):
    """Of each work with the largest argument, less what the markers take."""
    ends, found = counter.markers(*counter.functions(program)), {}
    for which, name in enumerate(NAMES):
        calls, _, _ = counter.count(program, plugin, ends, out / 'works.txt', which, MOST)
        found[name] = calls[0]
    around = found['nothing'] - 1
    return {name: count - around for name, count in found.items()}


def check(gate):
    plugin = counter.prepare(gate)
    program = build(gate.out)
    most, taken = bounds_of(program, gate.out), counted(program, plugin, gate.out)
    for name in NAMES:
        if taken[name] > most[name] or (name in EXACT and taken[name] != most[name]):
            gate.find(f'self-test: {name}: {taken[name]} instructions counted, bound {most[name]}')
    gate.figure('works of the self-test (counted, bound)', ', '.join(f'{name} {taken[name]} {most[name]}' for name in NAMES))
