"""The most instructions that a call of a function can take: the dearest way through its blocks, its loops as often as they may run."""
import collections
import re

import counted
import image as image_module
import loops as loops_module
import values as values_module


class Unbounded(Exception):
    """A call that leads nowhere, or to itself."""


class Unstated(Exception):
    """What neither the sources nor the table say."""


class Cost:
    """Instructions; of them those of the function itself, and how often it calls what, on its dearest way."""

    def __init__(self, total=0, own=0, calls=None):
        self.total, self.own, self.calls = total, own, calls or {}

    def times(self, count):
        return Cost(self.total * count, self.own * count, {key: n * count for key, n in self.calls.items()})

    def plus(self, other):
        calls = dict(self.calls)
        for key, n in other.calls.items():
            calls[key] = calls.get(key, 0) + n
        return Cost(self.total + other.total, self.own + other.own, calls)


class Costs:
    """`bounds`: how often loops run and what pointers reach. `names`: the numbers that bounds are made of. `left_out`: functions that count as nothing."""

    def __init__(self, image, bounds, names, left_out=()):
        self.image, self.bounds, self.names, self.left_out = image, bounds, names, left_out
        self.known, self.loop_totals, self.under_way = {}, {}, []
        self.missing, self.unstated, self.shared = {}, set(), {}

    def of(self, address, size=None):
        key = (address, size)
        if key in self.known:
            return self.known[key]
        function = self.image.functions.get(address)
        if address == 0:  # a weak function that this image does not have
            return Cost()
        if function is None:
            raise Unbounded(f'{address:x}: no function begins there')
        if key in self.under_way:
            raise Unbounded(f'{function.title} calls itself')
        if any(re.search(pattern, function.title) for pattern in self.left_out) or address in self.image.never_return:
            self.known[key] = Cost()
            return self.known[key]
        self.under_way.append(key)
        self.known[key] = self.walk(function, size)
        self.under_way.pop()
        return self.known[key]

    def prepare(self, function):
        """Its loops, what is known of its registers, and how often loops run by their own code: the same for all costs of the image."""
        if function.address not in self.image.prepared:
            loops = loops_module.find_loops(function)
            values = values_module.Values(function, loops)
            counts = {loop.header: counted.header_runs(function, loop, values) for loop in loops_module.flat(loops)}
            self.image.prepared[function.address] = loops, values, counts
        return self.image.prepared[function.address]

    def walk(self, function, size):
        loops, values, _ = self.prepare(function)
        edges = {at: block.successors for at, block in function.blocks.items()}
        nodes = {at: self.block(function, block, values) for at, block in function.blocks.items()}
        return self.dearest(function, nodes, edges, {function.address}, loops, size)[0]

    def block(self, function, block, values):
        cost = Cost(len(block.code), len(block.code))
        for one in block.calls():
            cost = cost.plus(self.call(function, one, values))
        if block.tail is not None:
            cost = cost.plus(self.call(function, block.code[-1], values, block.tail))
        return cost

    def call(self, function, one, values, target=None):
        """What the call takes: the dearest of the functions that it can reach."""
        target = target if target is not None else one.target
        try:
            reached = self.bounds.targets(function, one, values) if target in (None, 'pointer') else [target]
            keys = [(at, self.size_of(function, one, values, at)) for at in reached]
        except Unstated as error:
            self.unstated.add(str(error))
            return Cost()
        key = max(keys, key=lambda each: self.of(*each).total, default=None)
        return Cost(self.of(*key).total, 0, {key: 1}) if key else Cost()

    def size_of(self, function, one, values, at):
        """The bytes that a function whose loops depend on them is called for; None for others."""
        called = self.image.functions[at].title if at in self.image.functions else ''
        register = self.bounds.sized(called)
        if register is None:
            return None
        name, size = values.at(one.address).of(register)
        return size if name is None else self.bounds.bytes_of(function, called, self.names)

    def dearest(self, function, nodes, edges, first, loops, size):
        """The dearest way from `first`, and the dearest that ends at each block; loops are one step each."""
        steps, place = dict(nodes), {at: at for at in edges}
        for loop in loops:
            cost = self.loop(function, loop, nodes, edges, size)
            for at in loop.blocks:
                place[at] = loop.header
                steps.pop(at)
            steps[loop.header] = cost
        graph = {at: set() for at in steps}
        for at, following in edges.items():
            graph[place[at]] |= {place[to] for to in following if to in place and place[to] != place[at]}
        ways = longest(graph, steps, {place[at] for at in first if at in place})
        best = max(ways, key=lambda at: ways[at][0], default=None)
        return (collect(best, ways, steps) if best is not None else Cost()), ways, place, steps

    def loop(self, function, loop, nodes, edges, size):
        inside = {at: [to for to in edges[at] if to in loop.blocks and to != loop.header] for at in loop.blocks}
        part = {at: nodes[at] for at in loop.blocks}
        entries = set(loop.entries) | {loop.header}
        _, ways, place, steps = self.dearest(function, part, inside, entries, loop.inner, size)
        back = self.best_of(ways, place, steps, [at for at in loop.blocks if loop.header in edges[at]])
        out = self.best_of(ways, place, steps, [at for at in loop.blocks if set(edges[at]) - loop.blocks or function.blocks[at].leaves])
        runs, shared = self.runs(function, loop, size)
        # Loops of the image that are one loop of the sources, whose ways the compiler has separated, have its passes together: each counts as
        # the dearest, once for all of them.
        passes = [self.shared[function.address, inner.header, size] for inner in loop.inner if (function.address, inner.header, size) in self.shared]
        dearest = max([back, *passes], key=lambda each: each.total)
        if shared:
            self.shared[function.address, loop.header, size] = dearest
        cost = out if shared else dearest.times(runs - 1 + (len(loop.entries) > 1)).plus(out)
        self.loop_totals[function.address, loop.header, size] = (runs, dearest.total, cost.total)
        return cost

    @staticmethod
    def best_of(ways, place, steps, ends):
        reached = [place[at] for at in ends if place[at] in ways]
        return collect(max(reached, key=lambda at: ways[at][0]), ways, steps) if reached else Cost()

    def runs(self, function, loop, size):
        """How often the header runs, at most; and does it share these passes with the loop around it?"""
        names = self.names if size is None else {**self.names, 'bytes': size}
        count = self.prepare(function)[2][loop.header]
        if count is not None:
            together = self.bounds.together(function, loop, names)
            return (count if together is None else min(count, together + 1)), False
        stated = self.bounds.runs(function, loop, names)
        if stated is None:
            self.missing[function.address, loop.header] = (function, loop)
            return 2, False
        return stated + 1, self.bounds.is_shared(function, loop)


def longest(graph, steps, first):
    """Of each step that is reached: (instructions of the dearest way to its end, the step before)."""
    ways = {}
    for at in reversed(loops_module.postorder(lambda at: sorted(graph[at]), sorted(first))):
        if at in first:
            ways.setdefault(at, (steps[at].total, None))
        for to in graph[at]:
            total = ways[at][0] + steps[to].total
            if to not in ways or ways[to][0] < total:
                ways[to] = (total, at)
    return ways


def collect(end, ways, steps):
    own, calls, total, at = 0, collections.Counter(), ways[end][0], end
    while at is not None:
        own += steps[at].own
        for key, n in steps[at].calls.items():
            calls[key] += n
        at = ways[at][1]
    return Cost(total, own, dict(calls))
