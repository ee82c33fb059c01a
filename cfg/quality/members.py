"""How many data members each class of a C++ source has: the names ending in an underscore that its body declares. Structs are records."""
import re

MOST = 20
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
CLASS = re.compile(r'\bclass\s+(\w+)(?:\s+final)?\s*(?::[^{;]*)?\{')
IN_BRACKETS = re.compile(r'\([^()]*\)')
MEMBER = re.compile(r'\b([a-z]\w*_)\b(?=\s*(?:\[[^\]]*\]\s*)*(?:=|,|\{\}|$))')


def classes(text):
    """Name and number of members of each class, nested ones by themselves."""
    text = NO_CODE.sub(' ', text)
    for found in CLASS.finditer(text):
        yield found.group(1), len(members(declarations(text, found.end())))


def declarations(text, at):
    """What is declared in the body that begins there, with {} for what stands in braces and () for what stands in brackets."""
    depth, body = 1, []
    while depth > 0 and at < len(text):
        depth += {'{': 1, '}': -1}.get(text[at], 0)
        if depth == 1:
            body.append('{}' if text[at] == '}' else text[at])
        at += 1
    flat, rest = None, ''.join(body)
    while flat != rest:
        flat, rest = rest, IN_BRACKETS.sub('', rest)
    return flat.replace('{}', '{};').split(';')


def members(all_declared):
    return {name for declared in all_declared for name in MEMBER.findall(declared.strip())}
