"""Which loop of the sources a loop of the image is: the innermost one that all its instructions come from, inlined functions followed."""
import collections
import posixpath
import re

import image as image_module

NEARLY_ALL = 0.8  # of a loop's instructions
PLACE = re.compile(r'(\S*?):(\d+|\?)(?: \(discriminator \d+\))?$')


class Lines:
    """Of each instruction its lines, from the function that it is in to the innermost inlined one: (file, line)."""

    def __init__(self, path, root):
        self.path, self.root, self.frames = path, root, {}

    def load(self, addresses):
        """All at once: the debugging information of an image takes long to read."""
        given = '\n'.join(f'{at:x}' for at in addresses)
        at = None
        for line in image_module.run(f'{image_module.CROSS}addr2line', '-e', self.path, '-i', '-a', given=given).splitlines():
            found = PLACE.match(line.strip())
            if line.startswith('0x'):
                at = int(line, 16)
                self.frames[at] = []
            elif found and found[2] not in ('?', '0'):
                self.frames[at].insert(0, (self.brief(found[1]), int(found[2])))

    def brief(self, path):
        """Of a file of the repository its path in it."""
        return posixpath.normpath(path).removeprefix(f'{self.root}/')

    def path_of(self, at, read):
        """Loops and inlined calls that lead to the instruction, outer ones first."""
        steps = []
        for path, line in self.frames.get(at, []):
            source = read(path)
            steps += [('loop', loop) for loop in (source.around(line) if source else [])]
            steps.append(('call', (path, line)))
        return steps


def common(paths):
    """What all begin with."""
    first = min(paths, key=len, default=[])
    for i, step in enumerate(first):
        if any(path[i] != step for path in paths):
            return first[:i]
    return first


def held(step, paths):
    """In how many of the paths it is."""
    return sum(step in path for path in paths)


def headed(path):
    """Of a path the place of the innermost loop whose head it leads through; -1 where it leads through none."""
    found, line = -1, None
    for place in range(len(path) - 1, -1, -1):
        kind, what = path[place]
        if kind == 'call':
            line = what[1]
        elif what.first <= line <= what.head:
            found = max(found, place)
    return found


def ends(function, loop):
    """The branches that end a pass: those that lead back, or where they ask nothing, the header's."""
    back = [function.blocks[at].code[-1] for at in loop.latches(function)]
    asking = [one for one in back if one.op not in ('b', 'bctr')]
    return asking or [function.blocks[loop.header].code[-1]]


def deeper(place, paths, last):
    """The innermost loop, deeper than that place, that holds most of the paths and all the last ones; and how large a share."""
    found = collections.Counter(step for path in paths for step in path[place + 1:] if step[0] == 'loop' and all(step in end for end in last))
    most = [step for step, count in found.items() if 2 * count > len(paths)]
    step = max(most, key=lambda each: max(path.index(each) for path in paths if each in path), default=None)
    return (step[1], found[step] / len(paths)) if step else (None, 0)


class Place:
    """Where a loop of the image comes from: `loop` of the sources, with `depth` loops down to it, by `calls` that were inlined. `inside`: a
    deeper one that most of it is in, with its end; None where there is none. `is_most`: nearly all is."""

    def __init__(self, shared, paths, last):
        loops = [what for kind, what in shared if kind == 'loop']
        self.loop, self.depth = (loops[-1] if loops else None), len(loops)
        self.calls = [what for kind, what in shared if kind == 'call']
        self.inside, share = deeper(len(shared) - 1, paths, last)
        self.is_most = share >= NEARLY_ALL


def source_place(function, loop, lines, read):
    """By the innermost loop of the sources that all instructions of the loop have in common, or a deeper one whose head its end is in, as is
    most of it."""
    addresses = [one.address for at in sorted(loop.blocks) for one in function.blocks[at].code]
    paths = [lines.path_of(at, read) for at in addresses if lines.frames.get(at)]
    shared, last = common(paths), [lines.path_of(end.address, read) for end in ends(function, loop)]
    for path in last:
        place = headed(path)
        if place >= len(shared) and 2 * held(path[place], paths) > len(paths):
            shared = path[:place + 1]
    return Place(shared, paths, last)
