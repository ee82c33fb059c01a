"""The table of the gates (gates.toml): what each proves, what its result depends on, where it builds, and what it waits for."""
import dataclasses
import fnmatch
import pathlib
import re
import tomllib

import gate as gates

PLACE = 'cfg/quality/gates.toml'
TIERS = ('landing', 'verify')
BEGUN = re.compile(r'^([a-z][a-z0-9-]*):.*\n\t\$\(begin\)$|^\$\(call begin,([\w-]+)\)$', re.MULTILINE)  # in the Makefile


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    proves: str
    tier: str
    page: str = ''
    landing: str = ''
    verify: str = ''
    inputs: tuple = ()
    folders: tuple = ()
    after: tuple = ()
    cost: tuple = (0, 0)

    def words(self, tier):
        """Those of make: its target, and arguments."""
        return [*gates.command_of(self.name).split(), *(self.landing if tier == 'landing' else self.verify).split()]

    def whole(self, tier):
        """Whether the form of that tier says as much as that of verify."""
        return tier == 'verify' or self.landing == self.verify

    def depends_on(self, file):
        return matches(self.inputs, file)

    def shares(self, other):
        """Whether both build in one folder."""
        return any(fnmatch.fnmatchcase(mine, theirs) or fnmatch.fnmatchcase(theirs, mine) for mine in self.folders for theirs in other.folders)


def begun(makefile):
    """What takes away its old summary first, and so leaves one: gates and campaigns, each by the name of its folder below out/."""
    return [target or of_family for target, of_family in BEGUN.findall(makefile)]


def matches(patterns, file):
    """Whether the last of the patterns that fits the file takes it in."""
    inside = False
    for pattern in patterns:
        name = pattern.removeprefix('!')
        if file == name or (name.endswith('/') and file.startswith(name)) or fnmatch.fnmatchcase(file, name):
            inside = not pattern.startswith('!')
    return inside


def expand(patterns, groups, within=()):
    """The patterns, with what each group stands for in its place."""
    for pattern in patterns:
        name = pattern.removeprefix('@')
        if name == pattern:
            yield pattern
        elif name not in groups or name in within:
            raise ValueError(f'{PLACE}: group {name} does not exist, or contains itself')
        else:
            yield from expand(groups[name], groups, (*within, name))


def parse(text):
    """The rows by name, in the order of the file. ValueError: what is wrong in it."""
    try:
        table = tomllib.loads(text)
        groups = table.get('groups', {})
        rows = {name: make_row(name, fields, groups) for name, fields in table.get('gate', {}).items()}
    except (tomllib.TOMLDecodeError, TypeError) as error:
        raise ValueError(f'{PLACE}: {error}') from error
    return {name: wait_for(row, rows) for name, row in rows.items()}


def make_row(name, fields, groups):
    lists = {key: tuple(fields[key]) for key in ('folders', 'after', 'cost') if key in fields}
    row = Row(name=name, **fields | lists | {'inputs': tuple(expand(fields.get('inputs', ()), groups))})
    if row.tier not in TIERS or len(row.cost) != 2:
        raise ValueError(f'{PLACE}: gate {name}: tier is {" or ".join(TIERS)}, and cost two numbers')
    return row


def wait_for(row, rows):
    """The row with the names of all gates that it waits for."""
    names = tuple(name for name, other in rows.items() if '*' not in other.after) if '*' in row.after else row.after
    for name in names:
        if name not in rows or list(rows).index(name) >= list(rows).index(row.name):
            raise ValueError(f'{PLACE}: gate {row.name} waits for {name}, which does not stand before it')
    return dataclasses.replace(row, after=names)


def read(top):
    try:
        return parse((pathlib.Path(top) / PLACE).read_text(encoding='utf-8'))
    except OSError as error:
        raise ValueError(f'{PLACE}: {error.strerror}: give the top of the repository') from error
