"""A linked image of the PowerPC: its functions, and the blocks of each, read from objdump's listing."""
import re
import struct
import subprocess

CROSS = 'powerpc-linux-gnu-'
HEAD = re.compile(r'^([0-9a-f]+) <(.*)>:$')
LINE = re.compile(r'^ *([0-9a-f]+):\t(\S+)\s*(.*)$')
TARGET = re.compile(r'(?:^|,)([0-9a-f]+) <')
CONDITIONAL = re.compile(r'b(eq|ne|lt|gt|le|ge|so|ns|un|nu|dnz|dz)[a-z]*$')
TABLE_LOOK = 14  # instructions before a jump through a table that say where the table is, and how long


class Unreadable(Exception):
    """What the image does that this program cannot follow."""


def run(*command, given=None):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True, input=given).stdout


class Instruction:
    __slots__ = ('address', 'op', 'args', 'target')

    def __init__(self, address, op, args):
        self.address, self.op, self.args = address, op.rstrip('+-'), args
        found = TARGET.search(args) if op.startswith('b') else None
        self.target = int(found[1], 16) if found else None

    def is_call(self):
        return self.op in ('bl', 'bctrl', 'blrl', 'bla')

    def ends_block(self):
        return self.op[0] == 'b' and not self.is_call() and self.op != 'brinc'

    def is_return(self):
        return self.op == 'blr' or self.op in ('rfi',)

    def falls_through(self):
        return not (self.op in ('b', 'blr', 'bctr', 'rfi'))

    def operands(self):
        return self.args.split(' ')[0].split(',')


class Block:
    """Instructions that run one after the other. `calls`: their calls, by target (None: through a pointer)."""

    def __init__(self, code):
        self.code, self.start, self.successors, self.tail, self.leaves = code, code[0].address, [], None, False

    def calls(self):
        return [one for one in self.code if one.is_call()]


class Function:
    def __init__(self, name, address, code):
        self.name, self.address, self.code = name, address, code
        self.title = name
        self.blocks = {}


class Image:
    def __init__(self, path):
        self.path = path
        self.sections = self.read_sections()
        self.functions = {}
        self.read(run(f'{CROSS}objdump', '-d', '--no-show-raw-insn', '-j', '.text', path))
        self.functions = {at: function for at, function in self.functions.items() if function.code}
        self.starts = sorted(self.functions)
        titles = run(f'{CROSS}c++filt', given='\n'.join(self.functions[at].name for at in self.starts)).splitlines()
        for at, title in zip(self.starts, titles):
            self.functions[at].title = title
        self.never_return, self.prepared = set(), {}
        self.link()

    def read_sections(self):
        """(address, size, bytes) of what is loaded; big-endian ELF32."""
        data = self.path.read_bytes()
        offset, size, count = struct.unpack('>I', data[32:36])[0], *struct.unpack('>HH', data[46:50])
        rows = [struct.unpack('>10I', data[offset + i * size:offset + i * size + 40]) for i in range(count)]
        return [(row[3], row[5], data[row[4]:row[4] + row[5]]) for row in rows if row[1] == 1 and row[2] & 2]

    def symbols(self):
        return [line for line in run(f'{CROSS}nm', '-C', '--defined-only', self.path).splitlines() if line.count(' ') >= 2]

    def word(self, address):
        for start, size, data in self.sections:
            if start <= address < start + size:
                return struct.unpack('>i', data[address - start:address - start + 4])[0]
        raise Unreadable(f'{address:x}: no constant is there')

    def read(self, listing):
        function = None
        for line in listing.splitlines():
            head, body = HEAD.match(line), LINE.match(line)
            if head:
                function = Function(head[2], int(head[1], 16), [])
                self.functions[function.address] = function
            elif body and function:
                function.code.append(Instruction(int(body[1], 16), body[2], body[3]))

    def link(self):
        """Blocks of all functions; anew while more functions are found that never return."""
        while True:
            for function in self.functions.values():
                function.blocks = make_blocks(self, function)
            silent = {at for at, function in self.functions.items() if not returns(function, self.never_return)}
            if silent == self.never_return:
                return
            self.never_return = silent

    def table(self, code, place):
        """Targets of the jump through a table at code[place]: `cmplwi rX,N; bgt default`, and offsets at the table's own address."""
        before = code[max(0, place - TABLE_LOOK):place]
        most = next((int(one.operands()[-1]) for one in reversed(before) if one.op == 'cmplwi'), None)
        lwzx = next((one for one in reversed(before) if one.op == 'lwzx'), None)
        if most is None or lwzx is None:
            return None
        for base in lwzx.operands()[1:]:
            high = next((one for one in before if one.op == 'lis' and one.operands()[0] in (base, *sources(before, base))), None)
            low = next((one for one in before if one.op == 'addi' and one.operands()[0] == base), None)
            if high and low:
                at = (int(high.operands()[1]) << 16) + int(low.operands()[2])
                return [at + self.word(at + 4 * i) for i in range(most + 1)]
        return None


def sources(code, register):
    return [one.operands()[1] for one in code if one.op == 'addi' and one.operands()[0] == register]


def make_blocks(image, function):
    code, first, last = function.code, function.address, function.code[-1].address
    tables = {i: image.table(code, i) for i, one in enumerate(code) if one.op == 'bctr'}
    leaders = {first}
    for i, one in enumerate(code):
        if not one.ends_block() and not (one.is_call() and one.target in image.never_return):
            continue
        leaders |= {one.target} if one.target is not None and first <= one.target <= last and not one.is_call() else set()
        leaders |= set(tables.get(i) or [])
        leaders |= {code[i + 1].address} if i + 1 < len(code) else set()
    blocks, current = {}, []
    for one in code:
        if one.address in leaders and current:
            blocks[current[0].address] = Block(current)
            current = []
        current.append(one)
    blocks[current[0].address] = Block(current)
    for block in blocks.values():
        join(image, function, block, tables)
    return reachable(blocks, first)


def join(image, function, block, tables):
    """Where the block goes on to."""
    end, after = block.code[-1], block.code[-1].address + 4
    first, last = function.address, function.code[-1].address
    if end.is_call() and end.target in image.never_return:
        return
    if end.op == 'bctr':
        targets = tables[function.code.index(end)]
        block.successors = sorted(set(targets)) if targets else []
        block.tail = None if targets else 'pointer'
        block.leaves = targets is None
        return
    if end.ends_block() and end.target is not None:
        if first <= end.target <= last and end.target != first:
            block.successors.append(end.target)
        elif end.target == first:  # a loop to the function's own beginning
            block.successors.append(first)
        else:
            block.tail, block.leaves = end.target, True
    if end.ends_block() and end.target is None:
        block.leaves = True
    if end.falls_through() and after <= last and after not in block.successors:
        block.successors.append(after)


def reachable(blocks, first):
    found, open_ = {}, [first]
    while open_:
        at = open_.pop()
        if at not in found:
            found[at] = blocks[at]
            open_ += blocks[at].successors
    return dict(sorted(found.items()))


def returns(function, never_return):
    """Does any path of it end by a return, or in a function that returns?"""
    return any(block.leaves and block.tail not in never_return for block in function.blocks.values())
