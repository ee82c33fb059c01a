"""How often a loop's header runs, where its code says so: a counter with a first value, a step and a last value that are known."""
import values as values_module

STAY = {'lt': lambda a, b: a < b, 'gt': lambda a, b: a > b, 'le': lambda a, b: a <= b, 'ge': lambda a, b: a >= b,
        'ne': lambda a, b: a != b, 'eq': lambda a, b: a == b}
OPPOSITE = {'lt': 'ge', 'ge': 'lt', 'gt': 'le', 'le': 'gt', 'ne': 'eq', 'eq': 'ne'}
COMPARES = {'cmpwi': True, 'cmpw': True, 'cmplwi': False, 'cmplw': False}  # signed?
MOST = 1 << 20  # passes that are tried


def header_runs(function, loop, values):
    """The least of the counts that its tests give; None where none does."""
    if len(loop.entries) > 1:
        return None
    counts = [count_of(function, loop, values, at) for at in sorted(loop.blocks) if is_test(function, loop, at)]
    return min((count for count in counts if count is not None), default=None)


def is_test(function, loop, at):
    """Does the block leave the loop or stay in it, and is it passed once in each pass?"""
    following = function.blocks[at].successors
    stays = [to for to in following if to in loop.blocks]
    if len(following) != 2 or len(stays) != 1 or any(at in inner.blocks for inner in loop.inner):
        return False
    return not has_way_around(function, loop, at)


def has_way_around(function, loop, at):
    seen, open_ = set(), [loop.header] if loop.header != at else []
    while open_:
        place = open_.pop()
        if place in seen or place == at:
            continue
        seen.add(place)
        following = [to for to in function.blocks[place].successors if to in loop.blocks]
        if loop.header in following:
            return True
        open_ += following
    return False


def count_of(function, loop, values, at):
    block = function.blocks[at]
    branch = block.code[-1]
    taken_stays = branch.target in loop.blocks
    if branch.op in ('bdnz', 'bdz'):
        return by_counter(loop, values, branch, taken_stays == (branch.op == 'bdnz'))
    kind, field = condition(branch)
    if kind is None:
        return None
    compare = find_compare(block, field)
    if compare is None:
        return None
    return by_compare(function, loop, values, compare, kind if taken_stays else OPPOSITE[kind])


def condition(branch):
    """What the branch asks, of which field; None for others."""
    kind = branch.op[1:3]
    if branch.op not in {f'b{name}' for name in OPPOSITE}:
        return None, None
    first = branch.operands()[0]
    return kind, first if first.startswith('cr') else 'cr0'


def find_compare(block, field):
    for one in reversed(block.code[:-1]):
        if one.op in COMPARES and compared(one)[0] == field:
            return one
        if one.op.endswith('.') and field == 'cr0':
            return one
        if one.is_call() or sets_field(one, field):
            return None
    return None


def sets_field(one, field):
    return one.op.startswith(('fcmp', 'mtcr', 'mcr')) and field in one.args or one.op in ('mtcrf', 'cror')


def compared(one):
    args = one.operands()
    return (args[0], args[1], args[2]) if args[0].startswith('cr') else ('cr0', args[0], args[1])


def by_counter(loop, values, branch, stays_above_zero):
    name, offset = values.at(branch.address).of('ctr')
    first = values.entering(loop, 'ctr')
    if name != ('met', loop.header, 'ctr') or offset != 0 or first is None or first[0] is not None or not stays_above_zero:
        return None
    return first[1] if first[1] > 0 else None


def by_compare(function, loop, values, compare, kind):
    one, other = sides(values.at(compare.address), compare)
    for moving, fixed, stay in ((one, other, kind), (other, one, swapped(kind))):
        count = by_values(function, loop, values, moving, fixed, (stay, COMPARES.get(compare.op, True)))
        if count is not None:
            return count
    return None


def sides(state, compare):
    """The two values that are compared; of an instruction that ends with a point its result, and 0."""
    if compare.op not in COMPARES:
        values_module.step(compare, state)
        return state.of(compare.operands()[0]), (None, 0)
    _, left, right = compared(compare)
    return state.of(left), (None, values_module.integer(right)) if compare.op.endswith('i') else state.of(right)


def swapped(kind):
    return {'lt': 'gt', 'gt': 'lt', 'le': 'ge', 'ge': 'le'}.get(kind, kind)


def by_values(function, loop, values, moving, fixed, test):
    """`moving`: (the register's value at the header, more); `fixed`: the same in each pass."""
    name, more = moving
    if not (isinstance(name, tuple) and name[0] == 'met' and name[1] == loop.header):
        return None
    register = name[2]
    first, steps = values.entering(loop, register), {values.after[at].of(register) for at in loop.latches(function)}
    if first is None or len(steps) != 1:
        return None
    back = steps.pop()
    if back[0] != name or back[1] == 0 or first[0] != fixed[0] or is_of_loop(fixed[0], loop):
        return None
    return passes(first[1] + more, back[1], fixed[1], test)


def is_of_loop(name, loop):
    return isinstance(name, tuple) and len(name) > 1 and name[1] in loop.blocks


def passes(value, step, limit, test):
    stay, is_signed = test
    if not is_signed and (value < 0 or limit < 0):
        return None
    if stay == 'ne' and (limit - value) % step == 0 and (limit - value) // step >= 0:
        return (limit - value) // step + 1
    if stay not in ('lt', 'le', 'gt', 'ge') or (step > 0) != (stay in ('lt', 'le')):
        return None
    distance = (limit - value) if step > 0 else (value - limit)
    reach = distance - (1 if stay in ('lt', 'gt') else 0)
    return 1 if reach < 0 else reach // abs(step) + 2
