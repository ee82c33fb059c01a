"""Loops of C++ sources: where each begins and ends, and how often it may run where its head says so."""
import ast
import functools
import operator
import pathlib
import re

COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
KEYWORD = re.compile(r'\b(for|while|do)\b(?=\s*[({])')
COUNTING = re.compile(r'for \((?:const )?[\w:]+ (\w+) = ([^;]+); ([^;]+); ([^;]+)\)')
CONSTANT = re.compile(r'constexpr\s+(?:static\s+)?(?:const\s+)?[\w:]+\s+(\w+)\s*(?:=\s*([^;{}]+)|\{([^;{}]+)\});')
ENUMERATOR = re.compile(r'\b(k\w+)\s*=\s*(\d+)\s*[,}]')
CAST = re.compile(r'(?:static_cast<[\w:]+>|std::size_t\{|std::uint32_t\{|lasso::|FlightImage::)')
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.floordiv, ast.FloorDiv: operator.floordiv,
             ast.Mod: operator.mod, ast.LShift: operator.lshift, ast.RShift: operator.rshift, ast.Pow: operator.pow}
FUNCTIONS = {'max': max, 'min': min}


class Unknown(Exception):
    """An expression that is no number."""


def blanked(text):
    """Comments and literals as blanks, lines as they are."""
    return COMMENT_OR_TEXT.sub(lambda found: re.sub(r'[^\n]', ' ', found[0]), text)


def evaluate(text, names):
    """The whole number that an expression of C++ or of the table says."""
    words = re.sub(r'(?<=[0-9a-fA-F])[uU][lL]*\b', '', CAST.sub('', text).replace('}', '').replace("'", ''))
    try:
        return compute(ast.parse(words.strip(), mode='eval').body, names)
    except (SyntaxError, Unknown, TypeError, KeyError, ZeroDivisionError, RecursionError) as error:
        raise Unknown(text) from error


def compute(node, names):
    if isinstance(node, ast.Constant) and isinstance(node.value, int):
        return int(node.value)
    if isinstance(node, ast.Name):
        value = names[node.id]
        return value if isinstance(value, int) else evaluate(value, names)
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](compute(node.left, names), compute(node.right, names))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -compute(node.operand, names)
    if isinstance(node, ast.Call) and getattr(node.func, 'id', None) in FUNCTIONS:
        return FUNCTIONS[node.func.id](*(compute(one, names) for one in node.args))
    raise Unknown(ast.dump(node))


def constants(texts):
    """Names of constants and what they are, of all sources; one that differs between files is known in none."""
    found = {}
    for text in texts:
        for name, value, braced in CONSTANT.findall(text):
            found.setdefault(name, set()).add((value or braced).strip())
    return {name: values.pop() for name, values in found.items() if len(values) == 1}


class SourceLoop:
    """Lines: where it begins, where its head and where it ends. `text`: its head, from the keyword to its closing parenthesis, in one line."""

    def __init__(self, path, first, head, last, text):
        self.path, self.first, self.head, self.last, self.text = path, first, head, last, text

    def place(self):
        return f'{self.path}:{self.first}'


class Source:
    def __init__(self, path, text):
        self.path, self.code = path, blanked(text)
        self.loops = sorted(self.read(), key=lambda loop: (loop.first, -loop.last))
        self.names = constants([self.code])

    def line(self, place):
        return self.code.count('\n', 0, place) + 1

    def read(self):
        ends = set()
        for found in KEYWORD.finditer(self.code):
            if found[1] == 'do':
                end = self.statement_end(found.end())
                end = self.code.index(';', end)
                ends.add(end)
                head, text = found.start(), 'do while ' + self.code[self.code.rindex('while', 0, end) + 5:end]
            else:
                head = self.closing(self.code.index('(', found.end()))
                end = self.statement_end(head + 1)
                if found[1] == 'while' and self.code[head + 1:].lstrip()[:1] == ';' and head + 1 + self.code[head + 1:].index(';') in ends:
                    continue
                text = self.code[found.start():head + 1]
            yield SourceLoop(self.path, self.line(found.start()), self.line(head), self.line(end), ' '.join(text.split()))

    def closing(self, place):
        """Of the bracket there."""
        depth = 0
        for i in range(place, len(self.code)):
            depth += (self.code[i] in '({[') - (self.code[i] in ')}]')
            if depth == 0:
                return i
        raise Unknown(f'{self.path}: a bracket is not closed')

    def statement_end(self, place):
        """Of the statement that begins there."""
        while self.code[place].isspace():
            place += 1
        if self.code[place] == '{':
            return self.closing(place)
        head = re.match(r'(for|while|if)\s*(constexpr\s*)?\(', self.code[place:])
        if head:
            end = self.statement_end(self.closing(place + head.end() - 1) + 1)
            other = re.match(r'\s*else\b', self.code[end + 1:])
            return self.statement_end(end + 1 + other.end()) if other else end
        while self.code[place] != ';':
            place = self.closing(place) if self.code[place] in '({[' else place
            place += 1
        return place

    def around(self, line):
        """The loops that hold this line, outer ones first."""
        return [loop for loop in self.loops if loop.first <= line <= loop.last]


def runs_of(loop, names):
    """Passes of a loop that counts between numbers; Unknown for others."""
    head = COUNTING.fullmatch(loop.text)
    if not head:
        raise Unknown(loop.text)
    name, first, tests, change = head.groups()
    for test in tests.split('&&'):
        asked = re.fullmatch(rf'\s*{name} (<|<=|>|>=|!=) (.+?)\s*', test)
        if not asked:
            continue
        try:
            return distance(evaluate(first, names), asked[1], evaluate(asked[2], names), step_of(name, change, names))
        except Unknown:
            continue
    raise Unknown(loop.text)


def step_of(name, change, names):
    for part in change.split(','):
        part = part.strip()
        if part in (f'++{name}', f'--{name}'):
            return 1
        by = re.fullmatch(rf'{name} [+-]= (.+)', part)
        if by:
            return evaluate(by[1], names)
    raise Unknown(change)


def distance(first, test, last, step):
    span = abs(last - first) + (1 if test in ('<=', '>=') else 0)
    return -(-span // step)


@functools.lru_cache(maxsize=None)
def read_source(path):
    return Source(path, pathlib.Path(path).read_text(encoding='utf-8', errors='replace'))
