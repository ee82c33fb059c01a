"""Where the flight sources can be changed by a little, and to what: the mutants that `make mutants` draws from.

The sources are read as text, not parsed. clang-format puts a space on both sides of a binary operator and none beside the brackets of a
template, so that ` < ` is a comparison. What no test could judge is blanked out first: comments, texts, preprocessor lines, assertions of
the compiler, heads and arguments of templates, sizes of arrays, and constant tables.
"""
import collections
import hashlib
import re

import waivers

COMMENT = r'//[^\n]*|/\*.*?\*/'
TEXT = r"""'(?:\\.|[^'\\\n])+'(?!\w)|"(?:\\.|[^"\\\n])*\""""
NO_CODE = re.compile(rf'{COMMENT}|^[ ]*\#(?:[^\n]*\\\n)*[^\n]*|{TEXT}', re.DOTALL | re.MULTILINE)
COMMENT_OR_TEXT = re.compile(f'{COMMENT}|{TEXT}', re.DOTALL)
NO_SITES = re.compile('|'.join((
    r'\bstatic_assert\s*\([^;]*;',
    r'^[ ]*template [^;{]*?$(?=\n)',  # clang-format breaks the line behind a template's head
    r'^[ ]*using [^;]*;',
    r'\[\[.*?\]\]',
    r'\boperator *[^\s\w(]+(?=\()',
    r'\)[^;{}()=]*= 0;',  # pure virtual
)), re.MULTILINE)
SIZE = re.compile(r'(?<=\w|[>&*])(?<!return)(?<!else)( \w+|\(&\w+\))(?:\[[\w ]+\])+(?= = |;|,|\)| \{)')  # of a declared array
TABLE = re.compile(r'\bconst(?:expr)? [^;={}()]*\[[^\]]*\] = \{(?=\s*\n)')  # a constant array of several lines
TEMPLATE_ARGUMENTS = re.compile(r'(?<=\w)<(?! )[^<>;{}|]*>')
RELATIONS = {'<': ('<=', '>='), '<=': ('<', '>'), '>': ('>=', '<='), '>=': ('>', '<'), '==': ('!=',), '!=': ('==',)}
OPERATORS = RELATIONS | {'&&': ('||',), '||': ('&&',), '+': ('-',), '-': ('+',), '*': ('/',), '/': ('*',), '%': ('*',), '<<': ('>>',),
                         '>>': ('<<',), '&': ('|',), '|': ('&',), '^': ('|',), '+=': ('-=',), '-=': ('+=',), '*=': ('/=',), '/=': ('*=',),
                         '|=': ('&=',), '&=': ('|=',), '^=': ('|=',), '<<=': ('>>=',), '>>=': ('<<=',)}
BINARY = re.compile(r'(?<= )(?:<<=|>>=|&&|\|\||<<|>>|[<>=!+\-*/|&^]=|[<>+\-*/%&|^])(?=[ \n])')
STEP = re.compile(r'\+\+|--')
NOT = re.compile(r'!(?=[\w(])')
NUMBER = re.compile(r"(?<![\w.'])(?:0[xX][\da-fA-F'.]+(?:[pP][+-]?\d+)?|\d[\d']*(?:\.\d*)?(?:[eE][+-]?\d+)?)(?:[uUlLfF]*)(?![\w.'])")
TRUTH = re.compile(r'\b(?:true|false)\b')
CONDITION = re.compile(r'\b(?:if|while) \(')
HEAD = re.compile(r'\s*(?:(?:(?:if|if constexpr|for|while|switch) \()|else\b|do\b|(?:case (?:[^:;]|::)*|default):(?!:))')
CALL = re.compile(r'(?:\(void\))?[\w:.>\[\]-]+(?:<[\w:, ]*>)?\(.*\)', re.DOTALL)
ASSIGNMENT = re.compile(r'\*?\w[\w.:>*-]*(?:[(\[][^=;]*?[)\]][\w.:>*-]*)* (?:[+\-*/%&|^]|<<|>>)?= .*', re.DOTALL)
STATEMENT_STEP = re.compile(r'(?:\+\+|--)[\w.>\[\]()-]+|[\w.>\[\]()-]+(?:\+\+|--)')
NO_STATEMENT = re.compile(r'(?:return|break|continue|using|if|for|while|switch|const|static|constexpr|auto|throw|delete|new|goto)\b')
RETURN = re.compile(r'return (.+)', re.DOTALL)
SAME_AS_EMPTY = re.compile(r'\{\}|0|0\.0|false|nullptr')
SCOPE = re.compile(r'\b(?:namespace|class|struct|union|enum)\b[^()]*$')
BODY = re.compile(r'(?:[)\]}:]|\belse|\bdo)(?:\s*(?:const|noexcept|override|final|mutable|-> [\w:<>&* ]+))*$')
LAMBDA = re.compile(r'\](?:\([^()]*\))?(?: mutable| -> [\w:<>&* ]+)*$')
MATCHING = {'(': ')', '{': '}'}

Mutant = collections.namedtuple('Mutant', 'file number start end text replacement line mutated kind')


def blank(match):
    return re.sub(r'[^\n]', ' ', match.group())


def blank_text(match):
    text = match.group()
    return f'"{"_" * (len(text) - 2)}"' if text[0] == '"' else "'_'".ljust(len(text)) if text[0] == "'" else blank(match)


def close_of(text, start):
    """Where the bracket that is opened at `start` is closed."""
    opening, depth = text[start], 0
    for i in range(start, len(text)):
        depth += (text[i] == opening) - (text[i] == MATCHING[opening])
        if depth == 0:
            return i
    return len(text) - 1


def masked(text):
    """The text with nothing left but code that may be changed; all places are as they were."""
    text = NO_CODE.sub(blank_text, text)
    text = NO_SITES.sub(blank, text)
    for match in reversed(list(TABLE.finditer(text))):
        end = close_of(text, match.end() - 1)
        text = text[:match.start()] + re.sub(r'[^\n]', ' ', text[match.start():end]) + text[end:]
    text = SIZE.sub(lambda match: re.sub(r'\d', '_', match.group()), text)
    while True:
        text, count = TEMPLATE_ARGUMENTS.subn(lambda match: re.sub(r'[^\n]', '_', match.group()), text)
        if count == 0:
            return text


def kind_of_brace(before):
    """What a brace after this text opens: the members of a type or namespace, statements, or an initialiser."""
    before = before.rstrip()
    if SCOPE.search(before):
        return 'scope'
    if before.count('(') == before.count(')'):
        return 'code' if not before or BODY.search(before) else 'initialiser'
    return 'code' if LAMBDA.search(before) else 'initialiser'


def statements(text):
    """Spans of the statements within functions, without the heads of what governs them."""
    kinds, depths, start = ['scope'], [0], 0
    for i, letter in enumerate(text):
        if letter in '()':
            depths[-1] += 1 if letter == '(' else -1
        elif letter == '{':
            kinds.append(kind_of_brace(text[start:i]))
            depths.append(0)
            start = start if kinds[-1] == 'initialiser' else i + 1
        elif letter == '}' and len(kinds) > 1:
            depths.pop()
            start = start if kinds.pop() == 'initialiser' else i + 1
        elif letter == ';' and depths[-1] == 0:
            if kinds[-1] == 'code':
                yield without_heads(text, start, i)
            start = i + 1


def without_heads(text, start, end):
    while match := HEAD.match(text, start, end):
        start = match.end() if match.group()[-1] != '(' else close_of(text, match.end() - 1) + 1
    while start < end and text[start].isspace():
        start += 1
    return start, end


def changed_numbers(text):
    """A literal + 1, 0 and doubled, of its own type."""
    decimal = re.fullmatch(r"([\d']+)([uUlL]*)", text)
    if decimal:
        value, suffix = int(decimal.group(1).replace("'", '')), decimal.group(2)
        return tuple(f'{one}{suffix}' for one in sorted({value + 1, 0, 2 * value} - {value}))
    if re.fullmatch(r'0\.0?[fF]?', text):
        return (text.replace('0', '1', 1),)
    return (f'({text} + 1)', f'(0 * {text})', f'(2 * {text})')


def token_changes(text):
    """(start, end, replacement, kind) of single words."""
    for match in BINARY.finditer(text):
        operator = match.group()
        kind = 'condition' if operator in RELATIONS or operator in ('&&', '||') else 'operator'
        for other in OPERATORS.get(operator, ()):
            yield *match.span(), other, kind
    for match in STEP.finditer(text):
        yield *match.span(), '--' if match.group() == '++' else '++', 'operator'
    for match in NOT.finditer(text):
        yield *match.span(), '', 'condition'
    for match in NUMBER.finditer(text):
        divides = text[:match.start()].endswith(('/ ', '% '))  # by 0 there is nothing to compute: anything may come of it
        for other in changed_numbers(match.group()):
            if not divides or not re.match(r'\(?0', other):
                yield *match.span(), other, 'constant'
    for match in TRUTH.finditer(text):
        yield *match.span(), 'false' if match.group() == 'true' else 'true', 'constant'


def condition_changes(text, original):
    """A whole condition is negated where no operator in it already is."""
    for match in CONDITION.finditer(text):
        start, end = match.end(), close_of(text, match.end() - 1)
        inner = text[start:end]
        if not BINARY.search(inner) and not inner.startswith('!') and ';' not in inner and ' = ' not in inner:
            yield start, end, f'!({original[start:end]})', 'condition'


def statement_changes(text):
    """Calls and assignments are left out, returned values are those of `{}`."""
    for start, end in statements(text):
        statement = text[start:end]
        returned = RETURN.fullmatch(statement)
        if returned and not SAME_AS_EMPTY.fullmatch(returned.group(1)):
            yield start + len('return '), end, '{}', 'return value'
        elif not NO_STATEMENT.match(statement):
            kinds = ((CALL, 'call left out'), (ASSIGNMENT, 'assignment left out'), (STATEMENT_STEP, 'assignment left out'))
            kind = next((kind for pattern, kind in kinds if pattern.fullmatch(statement)), None)
            if kind:
                yield start, end, '', kind


def line_around(code, start, end, replacement):
    """The line or lines of a change, before and after, with single spaces."""
    first = code.rfind('\n', 0, start) + 1
    last = code.find('\n', end)
    last = len(code) if last < 0 else last
    return tuple(' '.join(text.split()) for text in (code[first:last], code[first:start] + replacement + code[end:last]))


def mutants_of(name, original):
    """All mutants of one file."""
    text = masked(original)
    code = COMMENT_OR_TEXT.sub(lambda match: match.group() if match.group()[0] in '\'"' else blank(match), original)
    for start, end, replacement, kind in sorted({*token_changes(text), *condition_changes(text, original), *statement_changes(text)}):
        yield Mutant(name, original.count('\n', 0, start) + 1, start, end, original[start:end], replacement, *line_around(code, start, end, replacement), kind)


def mutants(top):
    """All mutants of the flight sources below `top`."""
    for path in waivers.sources(top):
        yield from mutants_of(path.relative_to(top).as_posix(), path.read_text(encoding='utf-8'))


def ranked(every, seed):
    """In the order of their draw, each with its key. The key is made of the file, the line as it reads and the change, so that the draw
    of a mutant does not depend on edits elsewhere."""
    seen = collections.Counter()
    keyed = []
    for mutant in every:
        words = (mutant.file, mutant.line, mutant.mutated)
        seen[words] += 1
        keyed.append((hashlib.sha256('\0'.join((str(seed), *words, str(seen[words]))).encode()).hexdigest()[:16], mutant))
    return sorted(keyed)
