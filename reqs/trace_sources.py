"""The tests' sources: which items they name, known before anything is built. They are read as text: what is commented out counts here, and not in the reports."""
import re

import trace_reports

FOLDERS = ('ut', 'ft')
NOT_OURS = 'ut/gates/'  # fixtures of the gates' own tests
VERIFIES = re.compile(r'\bVERIFIES\(\s*((?:"[^"\n]*"\s*)+)\)')


def read_source(path, shown):
    """A test for each VERIFIES: what the source names, with no result yet."""
    text = path.read_text(encoding='utf-8', errors='replace')
    for match in VERIFIES.finditer(text):
        place = f'{shown}:{text.count(chr(10), 0, match.start()) + 1}'
        names = ' '.join(re.findall(r'"([^"]*)"', match.group(1))).split()
        yield trace_reports.Test('the test', '', '', names, shown, place)


def read_sources(root):
    """The tests of ut and ft, and the problem that there are none."""
    paths = {path.relative_to(root).as_posix(): path for folder in FOLDERS for path in sorted((root / folder).rglob('*.cpp'))}
    tests = [test for shown, path in paths.items() if not shown.startswith(NOT_OURS) for test in read_source(path, shown)]
    return tests, [] if tests else [f'{root}: no test below {" and ".join(FOLDERS)} names a requirement: write VERIFIES("LASSO-AREA-nnn~REVISION")']


def check_named(tests, items):
    """Active items of method test that no test names."""
    for item in items:
        if item.method == 'test' and item.active and not trace_reports.tests_of(item, tests):
            yield f'{item.place}: {item.id} is named by no test: write one with VERIFIES("{item.name}"), or plan the item'
