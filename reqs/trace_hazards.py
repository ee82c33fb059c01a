"""Hazards (hazards.yaml) and failure modes (fmea.yaml): reads them, and checks that each has controls that exist, are active, and are shown (reqs/README.md)."""
import collections
import dataclasses
import re

import trace_items
from trace_items import Key, read_match, read_text, read_texts, read_word, yaml

SEVERITIES = {'catastrophic': 'loss of life, of the chaser or of the target', 'critical': 'injury, damage, or loss of the mission',
              'major': 'an approach is given up', 'minor': 'a loss of quality or of time'}
PARTS = ('sensor', 'link', 'memory', 'task', 'input')
HAZARD, FAILURE, REQUIREMENT = (re.compile(rf'LASSO-{area}-\d{{3}}') for area in ('HAZ', 'FME', '[A-Z]{3,4}'))
INDEPENDENT = 2  # controls of a catastrophic hazard, at least, that do not rest on each other's requirements
SHOWN = ('verified', 'evidence')
NOT_KNOWN_HERE = ('not run', 'a sample', 'short form', 'unchanged')  # trace --complete asks of the items themselves that they are known


@dataclasses.dataclass
class Control:
    text: str
    by: tuple  # ids of requirements


def read_ids(pattern):
    def read(node):
        ids = tuple(child.value for child in node.value) if isinstance(node, yaml.SequenceNode) else ()
        return ids if ids and all(isinstance(one, str) and pattern.fullmatch(one) for one in ids) and len(set(ids)) == len(ids) else None
    return read


def read_control(node):
    pairs = {key.value: value for key, value in node.value} if isinstance(node, yaml.MappingNode) else {}
    text, ids = pairs.keys() == {'control', 'by'} and (read_text(pairs['control']), read_ids(REQUIREMENT)(pairs['by'])) or (None, None)
    return Control(text, ids) if text and ids else None


def read_controls(node):
    controls = tuple(map(read_control, node.value)) if isinstance(node, yaml.SequenceNode) else ()
    return controls if controls and all(controls) else None


def read_faults(node):
    return read_ids(re.compile(r'[a-z_]+'))(node)


@dataclasses.dataclass
class Row:
    id: str = ''
    area: str = ''
    place: str = ''  # file:line
    lines: dict = dataclasses.field(default_factory=dict)  # key: file:line

    def at(self, key):
        return self.lines.get(key, self.place)


@dataclasses.dataclass
class Hazard(Row):
    title: str = ''
    cause: str = ''
    effect: str = ''
    severity: str = ''
    controls: tuple = ()
    remains: tuple = ()  # what the controls let pass, as measured
    spacecraft: tuple = ()  # what is left to it
    KEYS = {
        'id': Key(True, read_match(HAZARD), 'LASSO-HAZ-nnn'),
        'title': Key(True, read_text, 'a sentence'),
        'cause': Key(True, read_text, 'a sentence'),
        'effect': Key(True, read_text, 'a sentence'),
        'severity': Key(True, read_word(SEVERITIES), 'one of ' + ', '.join(SEVERITIES)),
        'controls': Key(True, read_controls, 'a list of "control: what it does" and "by: [LASSO-AREA-nnn, ...]"'),
        'remains': Key(True, read_texts, 'sentences'),
        'spacecraft': Key(True, read_texts, 'sentences'),
    }

    @property
    def ids(self):
        return [one for control in self.controls for one in control.by]


@dataclasses.dataclass
class Failure(Row):
    part: str = ''
    item: str = ''
    failure: str = ''
    effect: str = ''
    detection: str = ''
    faults: tuple = ()  # of the table of faults
    severity: str = ''
    hazards: tuple = ()
    controls: tuple = ()  # ids of requirements
    remains: str = ''
    KEYS = {
        'id': Key(True, read_match(FAILURE), 'LASSO-FME-nnn'),
        'part': Key(True, read_word(PARTS), 'one of ' + ', '.join(PARTS)),
        'item': Key(True, read_text, 'what fails'),
        'failure': Key(True, read_text, 'how it fails'),
        'effect': Key(True, read_text, 'a sentence'),
        'detection': Key(True, read_text, 'a sentence'),
        'faults': Key(False, read_faults, 'a list of faults of docs/faults.md'),
        'severity': Key(True, read_word(SEVERITIES), 'one of ' + ', '.join(SEVERITIES)),
        'hazards': Key(True, read_ids(HAZARD), 'a list of LASSO-HAZ-nnn'),
        'controls': Key(True, read_ids(REQUIREMENT), 'a list of LASSO-AREA-nnn'),
        'remains': Key(False, read_text, 'a sentence'),
    }

    @property
    def ids(self):
        return list(self.controls)


@dataclasses.dataclass
class Safety:
    """What the two files hold."""
    hazards: list
    failures: list

    @property
    def rows(self):
        return [*self.hazards, *self.failures]


def read_safety(root):
    """Both files, and the problems found; nothing where neither is there."""
    found, problems = {}, []
    for name, kind in (('hazards', Hazard), ('fmea', Failure)):
        path = root / f'reqs/{name}.yaml'
        found[name], wrong = trace_items.read_file(path, f'reqs/{name}.yaml', kind) if path.is_file() else ([], [])
        problems += wrong
    return Safety(found['hazards'], found['fmea']), problems


def faults_of(root):
    """The names of the rows of docs/faults.md, which a test compares with the table that the component executes."""
    path = root / 'docs/faults.md'
    return re.findall(r'^\| ([a-z]+_[a-z_]+) \|', path.read_text(encoding='utf-8'), re.MULTILINE) if path.is_file() else []


def is_exercised(item):
    """By a test, or by a gate that runs something: not by reading alone."""
    return item.method == 'test' or (bool(item.gate) and item.method != 'inspection')


def check_row(row, by_id):
    for one in row.ids:
        if one not in by_id:
            yield f'{row.at("controls")}: {row.id}: its control {one} does not exist: correct the id, or add the item to reqs/'
        elif not by_id[one].active:
            yield f'{row.at("controls")}: {row.id}: its control {one} is only planned: name one that is there, or say under "remains" that there is none'
    if not any(one in by_id and by_id[one].active and is_exercised(by_id[one]) for one in row.ids):
        yield f'{row.at("controls")}: {row.id} has no control that a test or a gate exercises: name one'


def independent(hazard, by_id):
    """How many of its controls are exercised, each by items that none before it names."""
    used, count = set(), 0
    for control in hazard.controls:
        own = [one for one in control.by if one in by_id and is_exercised(by_id[one]) and one not in used]
        used |= set(control.by)
        count += bool(own)
    return count


def check_hazard(hazard, by_id, failures):
    yield from check_row(hazard, by_id)
    if hazard.severity == 'catastrophic' and independent(hazard, by_id) < INDEPENDENT:
        yield f'{hazard.at("controls")}: {hazard.id} is catastrophic, and has fewer than {INDEPENDENT} controls that are exercised and independent: add one'
    if not any(hazard.id in failure.hazards for failure in failures):
        yield f'{hazard.place}: {hazard.id} follows from no row of reqs/fmea.yaml: add the failure that leads to it'


def check_failure(failure, by_id, hazards, faults):
    yield from check_row(failure, by_id)
    for one in failure.hazards:
        if one not in hazards:
            yield f'{failure.at("hazards")}: {failure.id}: there is no hazard {one}: correct the id'
    for name in failure.faults:
        if name not in faults:
            yield f'{failure.at("faults")}: {failure.id}: the table of faults (docs/faults.md) has no {name}: correct the name'


def check_cover(safety, items, faults):
    """The other way round: safety items that control nothing, faults that no failure leads to."""
    used = {one for row in safety.rows for one in row.ids}
    for item in items:
        if item.safety and item.active and item.id not in used:
            yield f'{item.at("safety")}: {item.id} is relevant to safety, and controls no hazard and no failure: name it in reqs/hazards.yaml or reqs/fmea.yaml'
    named = {name for failure in safety.failures for name in failure.faults}
    for name in faults:
        if name not in named:
            yield f'docs/faults.md: the fault {name} is named by no row of reqs/fmea.yaml: add the failure that it detects'


def check_safety(safety, items, root):
    """Problems that can be known before tests have run."""
    if not safety.rows:
        return []
    by_id, faults, hazards = {item.id: item for item in items}, faults_of(root), {hazard.id for hazard in safety.hazards}
    problems = [f'{row.place}: {row.id} was used before: give one of them a new number' for row, first in with_first(safety.rows) if row is not first]
    for hazard in safety.hazards:
        problems += check_hazard(hazard, by_id, safety.failures)
    for failure in safety.failures:
        problems += check_failure(failure, by_id, hazards, faults)
    return [*problems, *check_cover(safety, items, faults)]


def with_first(rows):
    first = {}
    for row in rows:
        yield row, first.setdefault(row.id, row)


def check_shown(safety, items, verdict):
    """Controls whose tests do not pass, or whose gate failed: they control nothing. verdict(item) is the matrix's."""
    by_id = {item.id: item for item in items if item.active}  # what does not exist, or is planned, is told by check_row
    for row in safety.rows:
        found = {one: verdict(by_id[one]) for one in row.ids if one in by_id}
        bad = [f'{one} ({word})' for one, word in found.items() if word not in SHOWN and word not in NOT_KNOWN_HERE]
        if bad:
            yield f'{row.at("controls")}: {row.id}: controls that are not shown: {", ".join(bad)}: correct what they rest on'


def figures(safety, items, verdict):
    """For a person: rows whose controls are all shown."""
    by_id = {item.id: item for item in items}
    found = collections.Counter()
    for kind, rows in (('hazards', safety.hazards), ('failure modes', safety.failures)):
        found[kind] = sum(all(one in by_id and verdict(by_id[one]) in SHOWN for one in row.ids) for row in rows)
    return {f'{kind} with all controls shown': f'{found[kind]} of {len(rows)}' for kind, rows in (('hazards', safety.hazards), ('failure modes', safety.failures)) if rows}
