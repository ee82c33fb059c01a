"""What is known of a register before each instruction: a number, or a number more than some unknown value that has a name.

A value is (name, offset); its name is None for a number. Where two ways meet with different values the register has a new name. A block
that leads back gives a new name to all that its loop changes. So two values of one name differ by what their offsets say.
"""
import loops as loops_module

CALL_CHANGES = ['r0'] + [f'r{i}' for i in range(3, 13)] + ['ctr', 'lr']
NO_RESULT = ('st', 'cmp', 'fcmp', 'b', 'tw', 'mtctr', 'mtlr', 'mtcr', 'dcb', 'icb', 'sync', 'isync', 'nop', 'lf', 'f', 'cr', 'eieio', 'mtspr', 'mtsr', 'mtmsr')
MASK = 0xFFFFFFFF


def signed(number):
    number &= MASK
    return number - (1 << 32) if number & 0x80000000 else number


class State(dict):
    """Values of registers."""

    def of(self, register):
        return self.get(register) or (('start', register), 0)


def integer(text):
    return int(text, 0)


def memory(operand):
    """Offset and register of 8(r3); None of anything else."""
    if '(' not in operand:
        return None
    offset, register = operand.rstrip(')').split('(')
    return integer(offset), register


def base(register, state):
    return (None, 0) if register in ('0', 'r0') else state.of(register)


def result(one, state):
    """(register, value) that the instruction leaves, or None."""
    op, args = one.op.rstrip('.'), one.operands()
    if op == 'mtctr':
        return 'ctr', state.of(args[0])
    if op in ('li', 'lis'):
        return args[0], (None, signed(integer(args[1]) << (16 if op == 'lis' else 0)))
    if op in ('addi', 'addic', 'addis', 'subi'):
        name, offset = base(args[1], state) if op != 'addic' else state.of(args[1])
        return args[0], (name, signed(offset + (integer(args[2]) << (16 if op == 'addis' else 0))))
    if op == 'mr':
        return args[0], state.of(args[1])
    return computed(op, args, state, one)


def computed(op, args, state, one):
    if op in ('ori', 'oris') and state.of(args[1])[0] is None:
        return args[0], (None, signed(state.of(args[1])[1] | integer(args[2]) << (16 if op == 'oris' else 0)))
    if op in ('slwi', 'srwi', 'mulli') and state.of(args[1])[0] is None:
        number, by = state.of(args[1])[1], integer(args[2])
        return args[0], (None, signed({'slwi': number << by, 'srwi': (number & MASK) >> by, 'mulli': number * by}[op]))
    if op in ('add', 'subf'):
        one_, other = state.of(args[1]), state.of(args[2])
        if op == 'add' and None in (one_[0], other[0]):
            return args[0], (one_[0] or other[0], signed(one_[1] + other[1]))
        if op == 'subf' and one_[0] == other[0]:
            return args[0], (None, signed(other[1] - one_[1]))
        if op == 'subf' and one_[0] is None:
            return args[0], (other[0], signed(other[1] - one_[1]))
    if op == 'lwz' and memory(args[1]):
        offset, register = memory(args[1])
        return args[0], (('load', one.address, base(register, state), offset), 0)
    if op.startswith(NO_RESULT) or not args or not args[0].startswith('r'):
        return None
    return args[0], (('made', one.address), 0)


def updated(one, state):
    """The address register of a load or store with update."""
    op = one.op
    if not op.startswith(('l', 'st')) or not op.rstrip('x').endswith('u'):
        return None
    args = one.operands()
    place = memory(args[1])
    if place:
        name, offset = state.of(place[1])
        return place[1], (name, signed(offset + place[0]))
    if op.endswith('ux'):
        return args[1], (('made', one.address, 'u'), 0)
    return None


def step(one, state):
    """Changes the state as the instruction does."""
    if one.is_call():
        for register in CALL_CHANGES:
            state[register] = (('made', one.address, register), 0)
        return
    moved, left = updated(one, state), result(one, state)
    if one.op == 'lmw':
        left = None
        for i in range(int(one.operands()[0][1:]), 32):
            state[f'r{i}'] = (('made', one.address, i), 0)
    if one.op.startswith('bd'):  # bdnz, bdz: counts down first
        name, offset = state.of('ctr')
        left = 'ctr', (name, signed(offset - 1))
    for change in (left, moved):
        if change:
            state[change[0]] = change[1]


class Values:
    """`before`: the state at the beginning of each block; `after`: at its end."""

    def __init__(self, function, loops):
        self.function, self.before, self.after = function, {}, {}
        self.changed_in, self.all_changes = {}, changes(function, function.blocks)
        for loop in loops_module.flat(loops):
            for entry in {loop.header, *loop.entries}:
                self.changed_in.setdefault(entry, set()).update(changes(function, loop.blocks))
        self.follow()

    def follow(self):
        ways = {at: [] for at in self.function.blocks}
        for at, block in self.function.blocks.items():
            for to in block.successors:
                ways[to].append(at)
        for at in sequence(self.function):
            self.before[at] = self.meet(at, ways[at])
            state = State(self.before[at])
            for one in self.function.blocks[at].code:
                step(one, state)
            self.after[at] = state

    def meet(self, at, ways):
        known = [self.after[way] for way in ways if way in self.after]
        if at == self.function.address:
            known.append(State())
        state, registers = State(), {register for one in known for register in one}
        changed = self.changed_in.get(at, set() if len(known) >= len(ways) else self.all_changes)
        for register in registers | changed:
            values = {one.of(register) for one in known}
            lost = register in changed or len(values) > 1
            state[register] = (('met', at, register), 0) if lost else values.pop()
        return state

    def at(self, address):
        """The state before the instruction there."""
        block = next(b for b in self.function.blocks.values() if b.start <= address <= b.code[-1].address)
        state = State(self.before[block.start])
        for one in block.code:
            if one.address == address:
                return state
            step(one, state)
        raise KeyError(address)

    def entering(self, loop, register):
        """The one value that it has where the loop is come to; None where it has several."""
        ways = [way for way in loop.enters(self.function) if loop.header in self.function.blocks[way].successors]
        values = {self.after[way].of(register) for way in ways}
        return values.pop() if len(values) == 1 and loop.header != self.function.address else None


def changes(function, places):
    """Registers that the blocks at these places may change."""
    state = State()
    for at in places:
        for one in function.blocks[at].code:
            step(one, state)
    return set(state)


def sequence(function):
    """Blocks, each after those that lead to it but for the ways back (reverse postorder)."""
    return loops_module.postorder(lambda at: function.blocks[at].successors, [function.address])[::-1]
