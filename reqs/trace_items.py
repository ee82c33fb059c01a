"""The items of reqs/*.yaml: reads them with the line of each key, and checks all that can be known without test reports (reqs/README.md)."""
import collections
import dataclasses
import pathlib
import re
import sys

try:
    import yaml
except ImportError:
    sys.exit('trace: PyYAML is missing: install the Debian package python3-yaml (cfg/packages/ensure trace)')

import trace_evidence  # noqa: E402

METHODS = ('test', 'analysis', 'inspection', 'demonstration')
STATUSES = ('active', 'planned')
PLATFORMS = ('host', 'ppc603e')
ID = re.compile(r'LASSO-[A-Z]{3,4}-\d{3}')
NEED = 'LASSO-NEED-'
OTHER_FILES = ('hazards.yaml', 'fmea.yaml')  # trace_hazards.py
# What cannot be measured. Words with a meaning of their own in the field (nominal, correctly rounded, best fit) are not listed.
VAGUE = re.compile(
    r'\b(adequate(ly)?|appropriate(ly)?|as (far|much|fast|soon|many) as (possible|practical)|as (needed|required|necessary|applicable)|'
    r'(where|when|if) (possible|practical|needed|necessary|applicable)|acceptabl[ey]|and/or|be able to handle|comfortabl[ey]|convenient(ly)?|'
    r'eas(y|ily)|efficient(ly)?|etc|fast(er|est)?|flexibl[ey]|generally|gracefully?|high[- ]performance|intuitive(ly)?|lightweight|'
    r'maximi[sz]e|minimi[sz]e|minimal|modern|normally|optimal(ly)?|proper(ly)?|quick(ly)?|rapid(ly)?|reasonabl[ey]|reliabl[ey]|robust(ly)?|'
    r'seamless(ly)?|(?<!most )(?<!least )significant(ly)?|simple|simply|slow(ly)?|state[- ]of[- ]the[- ]art|sufficient(ly)?|suitabl[ey]|tbc|tbd|tbr|timely|'
    r'typical(ly)?|user[- ]friendly|usually|versatile|should|might)\b', re.IGNORECASE)
SHALL = re.compile(r'\bshall\b', re.IGNORECASE)


@dataclasses.dataclass
class Item:
    id: str = ''
    rev: int = 0
    text: str = ''
    rationale: str = ''
    parent: str = ''  # empty for needs alone
    method: str = ''
    safety: bool = False
    status: str = ''
    evidence: str = ''  # file in the repository
    shows: tuple = ()  # what the evidence has to say, with limits of its figures
    command: str = ''  # that prints the figures of the evidence
    gate: str = ''  # make target whose last result speaks for the item
    missing: str = ''  # of a planned item: what it still needs
    targets: tuple = ('host',)
    area: str = ''
    place: str = ''  # file:line of the item
    lines: dict = dataclasses.field(default_factory=dict)  # key: file:line

    def at(self, key):
        return self.lines.get(key, self.place)

    @property
    def name(self):
        return f'{self.id}~{self.rev}'

    @property
    def is_need(self):
        return self.id.startswith(NEED)

    @property
    def active(self):
        return self.status == 'active'


def is_text(node):
    return isinstance(node, yaml.ScalarNode) and node.tag == 'tag:yaml.org,2002:str' and node.value.strip() != ''


def read_text(node):
    return node.value.strip() if is_text(node) else None


def read_match(pattern):
    return lambda node: node.value if is_text(node) and pattern.fullmatch(node.value) else None


def read_word(words):
    return lambda node: node.value if is_text(node) and node.value in words else None


def read_count(node):
    ok = isinstance(node, yaml.ScalarNode) and node.tag == 'tag:yaml.org,2002:int' and re.fullmatch(r'[1-9]\d*', node.value)
    return int(node.value) if ok else None


def read_flag(node):
    return {'true': True, 'false': False}.get(node.value) if isinstance(node, yaml.ScalarNode) else None


def read_targets(node):
    words = tuple(child.value for child in node.value) if isinstance(node, yaml.SequenceNode) else ()
    return words if words and all(word in PLATFORMS for word in words) and len(set(words)) == len(words) else None


def read_texts(node):
    texts = tuple(map(read_text, node.value)) if isinstance(node, yaml.SequenceNode) else (read_text(node),)
    return texts if texts and all(texts) else None


Key = collections.namedtuple('Key', 'required read expected')  # read(node) is None where the value is not as expected
KEYS = {
    'id': Key(True, read_match(ID), 'LASSO-AREA-nnn'),
    'rev': Key(True, read_count, 'a whole number from 1'),
    'text': Key(True, read_text, 'a sentence'),
    'rationale': Key(True, read_text, 'a sentence'),
    'parent': Key(False, read_match(ID), 'the id of an item, without its revision'),
    'method': Key(True, read_word(METHODS), 'one of ' + ', '.join(METHODS)),
    'safety': Key(True, read_flag, 'true or false'),
    'status': Key(True, read_word(STATUSES), 'one of ' + ', '.join(STATUSES)),
    'evidence': Key(False, read_text, 'a file of the repository'),
    'shows': Key(False, read_texts, 'a text that stands in the evidence, or a list of such'),
    'command': Key(False, read_text, 'a command of the repository'),
    'missing': Key(False, read_text, 'a sentence'),
    'gate': Key(False, read_text, 'the name of a make target'),
    'targets': Key(False, read_targets, 'a list of ' + ', '.join(PLATFORMS)),
}
Item.KEYS = KEYS


def read_key(item, node, value, at, problems):
    name, keys = node.value if isinstance(node, yaml.ScalarNode) else 'of another type', item.KEYS
    if name not in keys:
        problems.append(f'{at}: unknown key {name!r}: the keys are {", ".join(keys)}')
        return
    if name in item.lines:
        problems.append(f'{at}: key {name!r} twice in one item: remove one')
    item.lines[name] = at
    result = keys[name].read(value)
    if result is None:
        shown = repr(value.value) if isinstance(value, yaml.ScalarNode) else 'of another type'
        problems.append(f'{at}: {name} is {shown}: write {keys[name].expected}')
    else:
        setattr(item, name, result)


def read_item(node, file, problems, kind=Item):
    """The item of one list entry; None, with the reasons in problems, where it is not one."""
    place = f'{file}:{node.start_mark.line + 1}'
    if not isinstance(node, yaml.MappingNode):
        problems.append(f'{place}: not an item: write "- id: LASSO-AREA-nnn" and its keys below')
        return None
    item, before = kind(place=place, area=pathlib.Path(file).stem), len(problems)
    for key, value in node.value:
        read_key(item, key, value, f'{file}:{key.start_mark.line + 1}', problems)
    for name, key in kind.KEYS.items():
        if key.required and name not in item.lines:
            problems.append(f'{place}: key {name!r} is missing: add it ({key.expected})')
    return item if len(problems) == before else None


def read_file(path, shown, kind=Item):
    """The items of one file and the problems found in it."""
    try:
        root = yaml.compose(path.read_text(encoding='utf-8'), Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        return [], [f'{shown}:{line}: not valid YAML ({error.problem}): quote texts that hold ": ", and check the indentation']
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        return [], [f'{shown}:1: not readable ({str(error).splitlines()[0]}): save the file as UTF-8 text']
    except OSError as error:
        return [], [f'{shown}:1: not readable ({error.strerror}): check the file and its permissions']
    if not isinstance(root, yaml.SequenceNode):
        return [], [f'{shown}:1: not a list of items: begin each item with "- id: LASSO-AREA-nnn"']
    problems = []
    items = [read_item(node, shown, problems, kind) for node in root.value]
    return [item for item in items if item is not None], problems


def read_items(root):
    """All items of ROOT/reqs/*.yaml in the files' order of names, needs first."""
    files = sorted((path for path in (root / 'reqs').glob('*.yaml') if path.name not in OTHER_FILES), key=lambda path: (path.stem != 'needs', path.stem))
    if not files:
        return [], [f'reqs: no requirements found below {root}: give the folder that holds reqs/']
    items, problems = [], []
    for path in sorted((root / 'reqs').rglob('*.y*ml')):
        if path not in files and path.relative_to(root / 'reqs').as_posix() not in OTHER_FILES:
            problems.append(f'{path.relative_to(root)}:1: not read: move its items to a file reqs/AREA.yaml')
    for path in files:
        found, wrong = read_file(path, str(path.relative_to(root)))
        items += found
        problems += wrong
    return items, problems


def check_wording(item):
    count = len(SHALL.findall(item.text))
    if count != 1:
        yield f'{item.at("text")}: {item.id} has {count} "shall": state one demand, or split the item'
    vague = VAGUE.search(item.text)
    if vague:
        yield f'{item.at("text")}: {item.id} says "{vague.group()}", which cannot be measured: give the figure or the property'
    if SHALL.search(item.rationale):
        yield f'{item.at("rationale")}: {item.id} demands something in its rationale: make that an item of its own'


def check_method(item, root):
    by_test = item.method == 'test'
    if by_test and (item.evidence or item.gate or item.shows or item.command):
        yield f'{item.place}: {item.id} is verified by test: remove its evidence, gate, shows and command, or change its method'
    if not by_test and 'targets' in item.lines:
        yield f'{item.at("targets")}: {item.id} is verified by {item.method}: targets are for tests'
    if by_test or not item.active:
        return
    if item.gate and item.gate not in trace_evidence.make_gates(root):
        yield f'{item.at("gate")}: {item.id}: there is no make {trace_evidence.command_of(item.gate)} yet that is a gate: correct the name, or plan the item until there is'
    yield from trace_evidence.check_evidence(item, root)


def check_status(item):
    if item.is_need and not item.active and not item.missing:
        yield f'{item.at("status")}: {item.id} is a planned need: say by "missing" what it still lacks'
    if item.active and item.missing:
        yield f'{item.at("missing")}: {item.id} is active: remove "missing", or plan the item'


def check_parent(item, by_id):
    if item.is_need:
        if item.parent:
            yield f'{item.at("parent")}: {item.id} is a mission need: needs have no parent'
        return
    if not item.parent:
        yield f'{item.place}: {item.id} has no parent: name the need or requirement that it follows from'
    elif item.parent not in by_id:
        yield f'{item.at("parent")}: {item.id}: its parent {item.parent} does not exist: correct the id'
    elif is_circular(item, by_id):
        yield f'{item.at("parent")}: {item.id} is its own ancestor by its parent {item.parent}: parents lead to a mission need'


def is_circular(item, by_id):
    seen, at = set(), item.parent
    while at in by_id and at not in seen:
        if at == item.id:
            return True
        seen.add(at)
        at = by_id[at].parent
    return False


def check_items(items, root):
    """Problems of the items among each other, in the order of their places."""
    by_id, problems = {}, []
    for item in items:
        if item.id in by_id:
            problems.append(f'{item.at("id")}: {item.id} was used before ({by_id[item.id].place}): give one of them a new number')
        by_id.setdefault(item.id, item)
    parents = {item.parent for item in items}
    for item in items:
        problems += [*check_wording(item), *check_parent(item, by_id), *check_method(item, root), *check_status(item)]
        if item.is_need and item.id not in parents:
            problems.append(f'{item.place}: {item.id} has no children: nothing would fulfil it')
    return problems
