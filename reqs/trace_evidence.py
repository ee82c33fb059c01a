"""Evidence of analyses, inspections and demonstrations: the file, what it has to say, and the command by which a reader repeats it (reqs/README.md)."""
import functools
import operator
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / 'cfg/quality'))
from gate import command_of  # noqa: E402
import gate_table  # noqa: E402

COMPARE = {'<=': operator.le, '>=': operator.ge, '=': operator.eq, '<': operator.lt, '>': operator.gt}
FIGURE = re.compile(r'\{(<=|>=|<|>|=) ?([\d.,]+)\}')  # in a text of `shows`: a number stands here, and keeps this limit
NUMBER = r'(-?\d[\d,]*(?:\.\d+)?)'
FORM = re.compile(r'make [a-z][a-z0-9-]*( [A-Z_]+=("[^"]*"|\S+))*|mdat [a-z]+( \S+)*')


@functools.cache
def make_gates(root):
    """The commands that take away their old summary first, and so leave one."""
    return gate_table.begun(_makefile(root))


@functools.cache
def make_targets(root):
    return re.findall(r'^([a-z][a-z0-9-]*):', _makefile(root), re.MULTILINE)


def _makefile(root):
    makefile = root / 'Makefile'
    return makefile.read_text(encoding='utf-8') if makefile.is_file() else ''


def is_file_within(root, name):
    """A file with words in it, and none that is generated or hidden."""
    root, path = root.resolve(), (root / name.split('#')[0]).resolve()
    if not path.is_relative_to(root) or not path.is_file() or path.relative_to(root).parts[0].startswith(('out', '.')):
        return False
    return path.read_bytes().strip() != b''


def words_of(root, name):
    return ' '.join((root / name.split('#')[0]).read_text(encoding='utf-8', errors='replace').split())


def number(text):
    return float(text.replace(',', '').rstrip('.'))


def missing_of(text, words):
    """None where `words` says `text`, and each place that does keeps the limits of its {figures}; else what is wrong, for a sentence."""
    parts = FIGURE.split(' '.join(text.split()))
    limits = list(zip(parts[1::3], parts[2::3]))
    found = list(re.finditer(NUMBER.join(map(re.escape, parts[::3])), words))
    if not found:
        return f'does not say "{text}"'
    for place in found:
        for value, (relation, limit) in zip(place.groups(), limits):
            if not COMPARE[relation](number(value), number(limit)):
                return f'says "{place.group()}", where {relation} {limit} is asked'
    return None


def check_command(item, root, words):
    if not item.command:
        return
    name = item.command.split()[1] if FORM.fullmatch(item.command) else ''
    if not name or (item.command.startswith('make ') and name not in make_targets(root)):
        yield f'{item.at("command")}: {item.id}: {item.command!r} is no command of this repository: write "make TARGET" or "mdat ACTION", as a reader types it'
    elif ' '.join(item.command.split()) not in words:
        yield f'{item.at("command")}: {item.id}: {item.evidence} does not name its command {item.command!r}: say there what repeats the figures'
    if not any(char.isdigit() for text in item.shows for char in text):
        yield f'{item.at("command")}: {item.id} has figures that a command prints, but no "shows" with a figure: quote them from {item.evidence}, with limits such as {{<= 0.5}}'


def check_evidence(item, root):
    """Problems of the evidence of an active item that no test alone verifies."""
    if not item.evidence:
        yield f'{item.at("method")}: {item.id} has no evidence of its {item.method}: add "evidence: FILE"'
        return
    if not is_file_within(root, item.evidence):
        yield f'{item.at("evidence")}: {item.id}: there is no file {item.evidence} in the repository, or it is empty: write it or correct the path'
        return
    words = words_of(root, item.evidence)
    yield from check_command(item, root, words)
    for text in item.shows:
        wrong = missing_of(text, words)
        if wrong:
            yield f'{item.at("shows")}: {item.id}: its evidence {item.evidence} {wrong}: correct one of the two'
    if not item.shows and not (item.gate and re.search(rf'\bmake {command_of(item.gate)}\b(?!-)', words)):
        also = f', nor does the file name make {command_of(item.gate)}' if item.gate else ''
        yield f'{item.at("evidence")}: {item.id}: nothing says what {item.evidence} has to show{also}: add "shows" with the words or figures that count'


def check_repeatable(items, tests_of):
    """Active items of another method that neither gate nor test nor command repeats. tests_of(item): the tests that name it."""
    for item in items:
        if item.active and item.method != 'test' and not item.gate and not item.command and not tests_of(item):
            yield (f'{item.place}: {item.id} is repeated by nothing: name a gate, write a test with VERIFIES("{item.name}"), '
                   'or give the command that prints the figures of its evidence')
