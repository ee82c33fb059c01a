"""Which files of the repository a source includes: read as text, so that what is left out by a condition counts as well."""
import functools
import pathlib
import re

QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


@functools.cache
def direct(top, name):
    """What a file includes, named from the top or from beside it; of a header that the build makes, what it is made of."""
    text = (top / name).read_text(encoding='utf-8', errors='replace')
    beside = pathlib.PurePath(name).parent
    places = (place for header in QUOTED.findall(text) for place in (header, (beside / header).as_posix(), f'{header}.in'))
    return frozenset(place for place in places if (top / place).is_file())


@functools.cache
def closure(top, name):
    """The file, and all that it includes by any chain."""
    found, new = {name}, {name}
    while new:
        new = {header for file in new for header in direct(top, file)} - found
        found |= new
    return frozenset(found)
