"""How often a loop runs at most, what a pointer reaches and how much is copied: of the sources, and of the table where they do not say."""
import re

import cost
import sources
from lines import source_place


class Table:
    """bounds.toml. Each row that is asked for is noted: one that never is names a loop that is no more. `indirect`: what pointers reach, as in
    cfg/quality/prove.toml."""

    def __init__(self, rows, indirect):
        self.rows, self.indirect, self.classes, self.used = rows, indirect, rows['behind'], set()

    def loop(self, path, text, kind='loops'):
        """What the table says of the loop of a file, by its head; None where it says nothing."""
        for file, rows in self.rows[kind].items():
            if path.endswith(file) and text in rows:
                self.used.add((file, text))
                return rows[text]
        return None

    def of_function(self, kind, title):
        for pattern, bound in self.rows[kind].items():
            if re.search(pattern, title):
                self.used.add((kind, pattern))
                return bound
        return None

    def unused(self):
        rows = [(file, text) for kind in ('loops', 'together') for file, loops in self.rows[kind].items() for text in loops]
        rows += [(kind, pattern) for kind in ('functions', 'bytes') for pattern in self.rows[kind]]
        return [row for row in rows if row not in self.used]


class Bounds:
    """`names`: the constants of all flight sources. `root`: the repository's folder."""

    def __init__(self, image, lines, table, root, names):
        self.image, self.lines, self.table, self.root, self.all_names = image, lines, table, root, names
        self.vtables, self.mapped, self.read_files = vtables(image), {}, {}

    def read(self, path):
        """A file of the repository, or a library's; None where it is neither."""
        place = self.root / path
        if place not in self.read_files:
            self.read_files[place] = sources.read_source(place) if place.is_file() else None
        return self.read_files[place]

    def place(self, function, loop):
        """Where in the sources a loop of the image is from."""
        key = function.address, loop.header
        if key not in self.mapped:
            if not self.lines.frames:
                self.lines.load([one.address for each in self.image.functions.values() if has_loop(each) for one in each.code])
            self.mapped[key] = source_place(function, loop, self.lines, self.read)
        return self.mapped[key]

    def where(self, function, loop):
        """The loop of the sources, and its depth. Where that would be the same as the loop around it, or one around that, and most of it is in a
        deeper one, it is that one if nearly all of it is; (None, 0) where it may be either."""
        place = self.place(function, loop)
        found, inside = (place.loop, place.depth), (place.inside, place.depth + 1)
        around = self.where(function, loop.parent) if loop.parent else (None, 0)
        if None in (place.loop, place.inside, around[0]) or (around[1] < place.depth and around != inside):
            return found
        return inside if place.is_most else (None, 0)

    def is_shared(self, function, loop):
        """Is the loop around it the same one of the sources? Not where the table has the function as a whole."""
        if loop.parent is None or self.table.of_function('functions', plain(function.title)) is not None:
            return False
        found = self.where(function, loop)
        return found[0] is not None and self.where(function, loop.parent) == found

    def runs(self, function, loop, names):
        """Passes of the loop, at most; None where neither the table nor the sources say."""
        whole = self.table.of_function('functions', plain(function.title))
        if whole is not None:
            return sources.evaluate(str(whole), {**self.all_names, **names})
        found, _ = self.where(function, loop)
        if found is None:
            return None
        stated, here = self.table.loop(str(found.path), found.text), self.names_in(function, found, names)
        try:
            return sources.evaluate(str(stated), here) if stated is not None else sources.runs_of(found, here)
        except sources.Unknown:
            return None

    def together(self, function, loop, names):
        """Passes of a loop whose own code says how often it runs, where the table says that all of them together are fewer; None elsewhere."""
        found, _ = self.where(function, loop)
        stated = self.table.loop(str(found.path), found.text, 'together') if found is not None else None
        return sources.evaluate(str(stated), self.names_in(function, found, names)) if stated is not None else None

    def names_in(self, function, found, names):
        copied = self.table.of_function('bytes', plain(function.title))
        return {'bytes': copied, **self.all_names, **sources.read_source(found.path).names, **names}

    def brief(self, path):
        """Of a file of the repository its path in it."""
        return str(path).removeprefix(f'{self.root}/')

    def sized(self, title):
        """The register that has the number of bytes on which the function's loops depend, or '' where none has; None of other functions."""
        return next((register for pattern, register in self.table.rows['sized'].items() if re.match(pattern, title)), None)

    def bytes_of(self, function, name, names):
        """How many bytes the function copies, fills or compares at once."""
        stated = self.table.of_function('bytes', plain(function.title))
        if stated is None:
            raise cost.Unstated(f'{plain(function.title)} calls {name.split("(")[0]} for a number of bytes that no row of the table says')
        return sources.evaluate(str(stated), {**self.all_names, **names})

    def targets(self, function, one, values):
        """Functions that a call through a pointer can reach, by the rows of cfg/quality/prove.toml."""
        row = next((row for row in self.table.indirect if re.search(row['from'], plain(function.title))), None)
        if row is None:
            raise cost.Unstated(f'{function.title} calls through a pointer, and no row of cfg/quality/prove.toml says what that can reach')
        if 'to' in row:
            return [at for at, other in self.image.functions.items() if re.search(row['to'], f'{as_compiler(other.title)} ')]
        return self.behind(function, one, values, row['behind'])

    def behind(self, function, one, values, name):
        names = self.table.classes.get(name)
        if names is None:
            raise cost.Unstated(f'{function.title} calls the {name}, and the table does not say what that is on this board')
        if isinstance(names, str):
            return [at for at, other in self.image.functions.items() if re.search(names, other.title)]
        offset = slot_of(values.at(one.address).of('ctr'))
        if offset is None:
            raise cost.Unstated(f'{function.title}: at {one.address:x} it calls a function that is not read from a table of virtual functions')
        return [self.image.word(self.vtables[each] + 8 + offset) for each in names]


def has_loop(function):
    return any(to <= at for at, block in function.blocks.items() for to in block.successors)


def as_compiler(title):
    """As the compiler's call graph writes it, which the patterns of cfg/quality/prove.toml are for."""
    return title.replace('(anonymous namespace)', '{anonymous}')


def plain(title):
    """The same without the arguments of a function template."""
    title = as_compiler(title)
    depth = 0
    for place, letter in enumerate(title):
        depth += (letter == '<') - (letter == '>')
        if letter == '(' and depth == 0:
            return without_arguments(title[:place]) + title[place:]
    return title


def without_arguments(name):
    """A name without the <...> that it ends with."""
    depth = 0
    for place in range(len(name) - 1, -1, -1):
        depth += (name[place] == '>') - (name[place] == '<')
        if depth == 0:
            return name[:place] if name.endswith('>') else name
    return name


def slot_of(value):
    """Offset of a virtual function in its table, where the value is one that was loaded from it."""
    name, more = value
    if more or not isinstance(name, tuple) or name[0] != 'load':
        return None
    table, place = name[2], name[3] + name[2][1]
    is_table = isinstance(table[0], tuple) and table[0][0] == 'load'
    return place if is_table else None


def vtables(image):
    found = {}
    for line in image.symbols():
        at, _, title = line.split(' ', 2)
        if title.startswith('vtable for '):
            found[title.removeprefix('vtable for ')] = int(at, 16)
    return found
