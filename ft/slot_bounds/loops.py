"""Loops of a function: its strongly connected blocks, then those that are left within each without the way back to its header, and so on."""


class Loop:
    """`blocks`: addresses, those of inner loops as well. `inner`: loops within. `entries`: more than the header where it is not reducible."""

    def __init__(self, header, blocks, entries, parent):
        self.header, self.blocks, self.entries, self.parent, self.inner = header, blocks, entries, parent, []

    def latches(self, function):
        return [at for at in sorted(self.blocks) if self.header in function.blocks[at].successors]

    def enters(self, function):
        return sorted(at for at, block in function.blocks.items() if at not in self.blocks and set(block.successors) & self.blocks)


def components(edges):
    """Strongly connected components of a graph (Tarjan), each after those that it leads to."""
    number, low, stack, on_stack, found = {}, {}, [], set(), []
    for root in edges:
        if root in number:
            continue
        open_ = [(root, iter(edges[root]))]
        number[root] = low[root] = len(number)
        stack.append(root)
        on_stack.add(root)
        while open_:
            at, rest = open_[-1]
            following = next((n for n in rest), None)
            if following is None:
                open_.pop()
                if open_:
                    low[open_[-1][0]] = min(low[open_[-1][0]], low[at])
                if low[at] == number[at]:
                    found.append(take_off(stack, on_stack, at))
            elif following not in number:
                number[following] = low[following] = len(number)
                stack.append(following)
                on_stack.add(following)
                open_.append((following, iter(edges[following])))
            elif following in on_stack:
                low[at] = min(low[at], number[following])
    return found


def take_off(stack, on_stack, last):
    found = set()
    while True:
        at = stack.pop()
        on_stack.discard(at)
        found.add(at)
        if at == last:
            return found


def find_loops(function):
    """Its outermost loops; the others are within them."""
    edges = {at: list(block.successors) for at, block in function.blocks.items()}
    return within(edges, {function.address}, None)


def within(edges, first, parent):
    """Loops of a part of a function, whose blocks `first` are come to from outside of it."""
    found = []
    for part in components(edges):
        if len(part) == 1 and not part & set(edges[next(iter(part))]):
            continue
        outside = {to for at, following in edges.items() if at not in part for to in following}
        entries = sorted(at for at in part if at in first or at in outside)
        loop = Loop(entries[0], part, entries, parent)
        inside = {at: [to for to in edges[at] if to in part and to != loop.header] for at in part}
        loop.inner = within(inside, set(entries), loop)
        found.append(loop)
    return sorted(found, key=lambda loop: loop.header)


def flat(loops):
    return [one for loop in loops for one in [loop] + flat(loop.inner)]


def postorder(successors, roots):
    """Nodes that the roots lead to, each after those that it leads to but for the ways back. `successors` gives a node's."""
    seen, post = set(), []
    for root in roots:
        if root in seen:
            continue
        seen.add(root)
        open_ = [(root, iter(successors(root)))]
        while open_:
            at, rest = open_[-1]
            following = next((n for n in rest if n not in seen), None)
            if following is None:
                post.append(at)
                open_.pop()
            else:
                seen.add(following)
                open_.append((following, iter(successors(following))))
    return post
