"""reqs/waivers.csv: what the coverage gates may leave open, with the reason.

A row names a line by its text (`line`, without the space around it), so that it survives edits elsewhere in the file. A row whose line is
gone, reads the same as another, or needs no waiver any more is a finding. At most 1 % of each figure may be waived.
"""
import csv
import dataclasses
import re

TABLE = 'reqs/waivers.csv'
COLUMNS = ['file', 'line', 'gate', 'reason']
GATES = ('coverage', 'mcdc')
ROOMS = ('fsw', 'hal_lcs')  # where each line and decision is measured
LIMIT_PERCENT = 1
SOURCES = ('.cpp', '.hpp')
# What would take code out of a measurement without a row: a marker, an attribute, or another name for the file.
MARKER = re.compile(r'[GL]COVR?_EXCL|no_profile_instrument_function|no_instrument_function|pragma\s+GCC\s+optimize|system_header|'
                    r'^\s*(?:#|%:)\s*(?:line\b|\d)')
NO_SOURCES = ('.clang-tidy', 'CMakeLists.txt', '.md')


@dataclasses.dataclass(frozen=True)
class Miss:
    """What the tests did not show: `count` of the figure `kind` at a line."""
    file: str
    number: int
    kind: str
    count: int
    what: str


def sources(top):
    """The measured files, from `top`."""
    return sorted(path for room in ROOMS for path in (top / room).rglob('*') if path.suffix in SOURCES)


def check_sources(gate, top, measured):
    """Nothing hides from the measurement: no marker, no source by another name, and every one that is compiled was measured."""
    for path in sorted(path for room in ROOMS for path in (top / room).rglob('*') if path.is_file()):
        if not path.name.endswith(SOURCES + NO_SOURCES):
            gate.find(f'{path.relative_to(top).as_posix()}: not measured: name sources {" or ".join(SOURCES)}')
    for path in sources(top):
        name = path.relative_to(top).as_posix()
        for number, line in enumerate(path.read_text(encoding='utf-8', errors='replace').splitlines(), 1):
            if MARKER.search(line):
                gate.find(f'{name}:{number}: a marker takes code out of the measurement: remove it, and waive its line in {TABLE}')
        if path.suffix == '.cpp' and name not in measured:
            gate.find(f'{name}: no data: is it compiled and linked into a unit test?')
    if not measured:
        gate.stop(f'nothing was measured below {top}: are the tests built with coverage, and did they run?')


class Row:
    def __init__(self, place, fields):
        self.place, self.file, self.line, self.gate, self.reason = place, *(fields[name].strip() for name in COLUMNS)
        self.number = None

    def find_line(self, gate, top):
        path = top / self.file
        lines = path.read_text(encoding='utf-8').splitlines() if path.is_file() else []
        numbers = [number for number, line in enumerate(lines, 1) if line.strip() == self.line]
        if len(numbers) == 1:
            self.number = numbers[0]
        elif numbers:
            gate.find(f'{self.place}: {self.file} reads `{self.line}` at lines {numbers}: make the line that is meant unlike the others')
        else:
            gate.find(f'{self.place}: no line of {self.file} reads `{self.line}`: write it as it is now, or remove the row')


def read_rows(gate, top):
    path = top / TABLE
    if not path.is_file():
        gate.stop(f'{path} is missing: it needs at least its first line, {",".join(COLUMNS)}')
    with open(path, encoding='utf-8', newline='') as file:
        reader = csv.DictReader(file)
        if reader.fieldnames != COLUMNS:
            gate.stop(f'{TABLE}:1: the columns are {reader.fieldnames}; expected {",".join(COLUMNS)}')
        for fields in reader:
            place = f'{TABLE}:{reader.line_num}'
            if None in fields or None in fields.values() or not all(value.strip() for value in fields.values()):
                gate.find(f'{place}: a row has {len(COLUMNS)} fields, none empty (quote those with commas)')
            elif fields['gate'] not in GATES:
                gate.find(f'{place}: there is no gate "{fields["gate"]}"; those with waivers are {", ".join(GATES)}')
            else:
                yield Row(place, fields)


def apply(gate, top, misses, totals):
    """The misses without a waiver are findings, also rows that nothing needs; the figures say what was reached. Gives the misses waived."""
    rows = {}
    for row in read_rows(gate, top):
        row.find_line(gate, top)
        if row.gate == gate.name and row.number is not None:
            if (row.file, row.number) in rows:
                gate.find(f'{row.place}: {row.file}:{row.number} has a row already')
            rows[row.file, row.number] = row
    waived = [miss for miss in misses if (miss.file, miss.number) in rows]
    needed = {(miss.file, miss.number) for miss in waived}
    for key, row in rows.items():
        if key not in needed:
            gate.find(f'{row.place}: stale: {row.file}:{row.number} is covered without it; remove the row')
    for miss in misses:
        if (miss.file, miss.number) not in rows:
            gate.find(f'{miss.file}:{miss.number}: {miss.what}: test it, remove it, or waive it with a reason in {TABLE}')
    for kind, total in totals.items():
        add_figure(gate, kind, total, sum(m.count for m in misses if m.kind == kind), sum(m.count for m in waived if m.kind == kind))
    return waived


def add_figure(gate, kind, total, missed, waived):
    if waived * 100 > total * LIMIT_PERCENT:
        gate.find(f'{waived} of {total} {kind} are waived, more than {LIMIT_PERCENT} %: test some of them')
    share = 100 * (total - missed + waived) / total if total else 100
    # 99.96 % is not 100 %: cut, never rounded up.
    gate.figure(kind, f'{int(share * 10) / 10:g} % of {total}' + (f' ({waived} waived)' if waived else ''))
