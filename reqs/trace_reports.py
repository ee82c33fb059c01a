"""The tests' reports: reads GoogleTest's XML of each platform, and checks the items that the tests name."""
import dataclasses
import os
import re
import xml.etree.ElementTree as ET

import trace_gates

NAME = re.compile(r'(LASSO-[A-Z]{3,4}-\d{3})~([1-9]\d*)')
# The platforms whose reports are read: folder below out/, and the command that writes it.
REPORTS = {'host': ('test', 'make test'), 'ppc603e': ('ppc-test', 'make ppc-test')}


@dataclasses.dataclass
class Test:
    name: str
    platform: str
    result: str  # passed, failed, skipped, disabled
    verifies: list  # names ID~REV
    report: str
    source: str  # file:line, where the report says it


def result_of(case):
    if case.get('status') == 'notrun' or case.get('result') == 'suppressed':
        return 'disabled'
    if case.find('failure') is not None or case.find('error') is not None:
        return 'failed'
    if case.get('result') != 'completed' or case.find('skipped') is not None:
        return 'skipped'
    return 'passed'


def read_report(path, platform, shown):
    tests = []
    for suite in ET.parse(path).getroot().iter('testsuite'):
        for case in suite.findall('testcase'):
            names = [p.get('value', '') for p in case.iter('property') if p.get('name') == 'verifies']
            name = f'{suite.get("name")}.{case.get("name")}'
            file = re.sub(r'^(\.\./)+', '', case.get('file', ''))  # as the compiler saw it from its build folder
            source = f'{file}:{case.get("line")}' if file else ''
            tests.append(Test(name, platform, result_of(case), sorted(set(' '.join(names).split())), shown, source))
    return tests


def failed_programs(path, shown):
    """From ctest's own report: programs that failed, whether or not they left a report."""
    for case in ET.parse(path).getroot().iter('testcase'):
        if case.get('status') != 'run':
            yield f'{shown}: the test program {case.get("name")} did not pass ({case.get("status")}): correct it and run the tests again'


def check_run(out, name, command):
    """Reports stay where a later run stopped before its tests, or was of broken sources: the run has to have ended well."""
    try:
        result = trace_gates.result_of(out, name)
    except ValueError as error:
        return [str(error)]
    return [] if result in ('passed', trace_gates.SHORT) else [f'{os.path.relpath(out / name)}: {command} did not pass last time ({result}): run it again']


def standing(out):
    """Platforms whose tests a landing did not run, or not all of them, and why: no test of theirs is missed then."""
    found = {}
    for platform, (name, _) in REPORTS.items():
        try:
            found[platform] = trace_gates.result_of(out, name)
        except ValueError:
            pass  # read_platform says so
    return {platform: result for platform, result in found.items() if result in (trace_gates.SHORT, trace_gates.UNCHANGED)}


def read_platform(out, platform):
    """The tests of one platform and the problems found in its reports. Where its gate was skipped what lies there is of an older run."""
    name, command = REPORTS[platform]
    folder = out / name
    if standing(out).get(platform) == trace_gates.UNCHANGED:
        return [], []
    files = sorted(path for path in folder.glob('*.xml') if path.name != 'ctest.xml')
    if not files:
        return [], [f'{os.path.relpath(folder)}: no reports of {platform}: run {command} first']
    tests, problems = [], check_run(out, name, command)
    for path in [*files, folder / 'ctest.xml']:
        shown = os.path.relpath(path)
        try:
            if path.name == 'ctest.xml':
                problems += failed_programs(path, shown)
            else:
                tests += read_report(path, platform, shown)
        except ET.ParseError as error:
            problems.append(f'{shown}:{error.position[0]}: not valid XML ({error}): run {command} again')
        except OSError as error:
            problems.append(f'{shown}: not readable ({error.strerror}): run {command} again')
    if not tests and not problems:
        problems.append(f'{os.path.relpath(folder)}: the reports hold no test: run {command} again')
    return tests, problems


def check_names(tests, items):
    """Tests that name what does not exist, or another revision of it."""
    by_id = {item.id: item for item in items}
    problems = set()
    for test in tests:
        place = test.source or test.report
        for name in test.verifies:
            match = NAME.fullmatch(name)
            if match is None:
                problems.add(f'{place}: {test.name} names {name!r}: write VERIFIES("LASSO-AREA-nnn~REVISION")')
            elif match.group(1) not in by_id:
                problems.add(f'{place}: {test.name} names {name}, an unknown id: correct it, or add the item to reqs/')
            elif by_id[match.group(1)].rev != int(match.group(2)):
                item = by_id[match.group(1)]
                problems.add(f'{place}: {test.name} verifies {name}, but {item.at("rev")} is at revision {item.rev}: '
                             f'check the test against the new text, then write {item.name}')
    return sorted(problems)


def tests_of(item, tests):
    return [test for test in tests if item.name in test.verifies]


def check_verified(items, tests, standing_platforms=()):
    """Active items of method test without a passing test on each of their platforms, and any item with a test that failed."""
    for item in items:
        naming = tests_of(item, tests)
        for test in naming:
            if test.result == 'failed':
                yield f'{item.place}: {item.id}: its test {test.name} failed on {test.platform} ({test.report}): correct the cause'
        if item.method != 'test' or not item.active:
            continue
        for platform in item.targets:
            results = [test.result for test in naming if test.platform == platform]
            if 'passed' not in results and platform not in standing_platforms:
                also = f' ({", ".join(sorted(set(results)))} does not count)' if results else ''
                yield (f'{item.place}: {item.id} has no passing test on {platform}{also}: '
                       f'write one with VERIFIES("{item.name}"), or plan the item')
