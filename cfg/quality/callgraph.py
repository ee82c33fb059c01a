"""The call graph that GCC writes (-fcallgraph-info=su), and the stack that it needs."""
import re

NODE = re.compile(r'node: \{ title: "([^"]*)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"')
SIZE = re.compile(r'\\n(\d+) bytes \((.*?)\)')
POINTER = '__indirect_call'


class Unbounded(Exception):
    pass


class Step:
    """What a function calls that is not compiled here: a name, and the bytes allowed for it."""

    def __init__(self, name, size):
        self.name, self.size = name, size


class CallGraph:
    """`elsewhere`: patterns of functions that are not in the graph, and their bytes. `indirect`: rows as in cfg/quality/prove.toml."""

    def __init__(self, files, elsewhere, indirect):
        self.elsewhere, self.rows, self.used = elsewhere, indirect, set()
        self.frames, self.labels, self.calls, self.deepest = {}, {}, {}, {}
        for path in files:
            for line in path.read_text(encoding='utf-8').splitlines():
                self.read(line)

    def read(self, line):
        node, edge = NODE.match(line), EDGE.match(line)
        if edge:
            self.calls.setdefault(edge.group(1), set()).add(edge.group(2))
        if not node:
            return
        title, label = node.groups()
        size = SIZE.search(label)
        if size:  # else it is declared here, and defined elsewhere
            self.labels[title] = label
            bounded = size.group(2) in ('static', 'dynamic,bounded')
            frame = max(self.frames.get(title) or 0, int(size.group(1)))
            self.frames[title] = frame if bounded and self.frames.get(title, 0) is not None else None

    def name(self, title):
        return self.labels.get(title, title).split('\\n')[0]

    def place(self, title):
        return (self.labels[title].split('\\n') + [''])[1]

    def matching(self, pattern):
        return sorted(t for t in self.frames if re.search(pattern, f'{self.name(t)} {self.place(t)}'))

    def depth(self, title, above=()):
        """Bytes of the deepest path from this function, and the path: (name, bytes) from the top. Unbounded if there is no bound."""
        if title in above:
            raise Unbounded('recursion: ' + ' > '.join(map(self.name, above[above.index(title):] + (title,))))
        if title not in self.deepest:
            self.deepest[title] = self.measure(title, above + (title,))
        return self.deepest[title]

    def measure(self, title, path):
        if title not in self.frames:
            raise Unbounded(f'unknown function {title}, called by {self.name(path[-2])}: no .ci file describes it')
        if self.frames[title] is None:
            raise Unbounded(f'dynamic frame: {self.name(title)} ({self.place(title)})')
        below = [(0, [])]
        for target in self.targets(title):
            allowed = self.allowance(target)
            below.append((allowed.size, [(allowed.name, allowed.size)]) if allowed else self.depth(target, path))
        size, chain = max(below, key=lambda item: item[0])
        return self.frames[title] + size, [(self.name(title), self.frames[title])] + chain

    def targets(self, title):
        """Titles and Steps that the function calls, pointers resolved."""
        targets = {self.body(target) for target in self.calls.get(title, set())}
        if POINTER not in targets:
            return sorted(targets)
        for number, row in enumerate(self.rows):
            if re.search(row['from'], self.name(title)):
                self.used.add(number)
                reached = [Step(f'({row["behind"]})', row['stack'])] if 'behind' in row else self.matching(row['to'])
                if not reached:
                    raise Unbounded(f'indirect call in {self.name(title)}: nothing matches {row["to"]}')
                return sorted(targets - {POINTER}) + reached
        raise Unbounded(f'indirect call in {self.name(title)} ({self.place(title)}): no row says what it can reach')

    @staticmethod
    def base(title):
        """A complete constructor or destructor (C1, D1) shares the body of the base's (C2, D2) where no base is virtual."""
        return re.sub(r'([CD])1E', r'\g<1>2E', title)

    def body(self, title):
        base = self.base(title)
        return base if title not in self.frames and base in self.frames else title

    def allowance(self, target):
        if isinstance(target, Step):
            return target
        if target not in self.frames:
            for pattern, size in self.elsewhere.items():
                if re.fullmatch(pattern, target):
                    return Step(target, size)
        return None
