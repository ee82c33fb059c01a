"""The traceability matrix as one HTML page and as CSV, from the items, the tests and the gates' results."""
import collections
import csv
import html
import os
import pathlib

import trace_gates
import trace_hazards
import trace_reports

STYLE = (pathlib.Path(__file__).parent / 'trace_matrix.css').read_text(encoding='utf-8')
COLUMNS = ('id', 'revision', 'area', 'status', 'safety', 'method', 'text', 'rationale', 'parent', 'children', 'targets', 'tests', 'evidence',
           'shows', 'command', 'missing', 'gate', 'gate_result', 'verdict')
escape = html.escape


def area_title(area):
    return area.replace('_', ' ')


class Matrix:
    def __init__(self, root, items, tests, gates, problems, standing, safety):
        self.root, self.items, self.tests, self.gates, self.problems, self.standing, self.safety = root, items, tests, gates, problems, standing, safety
        self.children = collections.defaultdict(list)
        for item in items:
            if not item.is_need:  # a need with a parent is a problem, and would lead the tree in a circle
                self.children[item.parent].append(item)

    def verdict(self, item):
        """verified, missing, failed, evidence, planned, or why it is not known here: not run, a sample, short form, unchanged."""
        if not item.active:
            return 'planned'
        results = {(test.platform, test.result) for test in trace_reports.tests_of(item, self.tests)}
        if any(result == 'failed' for _, result in results):
            return 'failed'
        if item.method == 'test':
            left = [platform for platform in item.targets if (platform, 'passed') not in results]
            reasons = [self.standing.get(platform, 'missing') for platform in left]
            return 'missing' if 'missing' in reasons else next(iter(reasons), 'verified')
        gate = self.gates.get(item.gate, 'passed')
        return {'passed': 'evidence' if item.evidence else 'missing'}.get(gate, gate)

    def areas(self, status):
        grouped = {}
        for item in self.items:
            if item.status == status:
                grouped.setdefault(item.area, []).append(item)
        return grouped

    def figures(self):
        """The summary, in words for a person."""
        active = [item for item in self.items if item.active]
        traced = [item for item in active if self.verdict(item) in ('verified', 'evidence')]
        by_test = [item for item in active if item.method == 'test']
        passed = collections.Counter(test.platform for test in self.tests if test.result == 'passed')
        waiting = [item for item in active if self.verdict(item) in ('not run', 'a sample')]
        figures = {
            'active items traced': f'{len(traced)} of {len(active)}',
            'by passing tests': f'{sum(self.verdict(item) == "verified" for item in by_test)} of {len(by_test)}',
            'by evidence': f'{len(traced) - sum(self.verdict(item) == "verified" for item in by_test)} of {len(active) - len(by_test)}',
            'mission needs': str(sum(item.is_need for item in self.items)),
            'planned items': str(len(self.items) - len(active)),
            'safety relevant': f'{sum(item.safety for item in active)} active, {sum(item.safety for item in self.items if not item.active)} planned',
            'tests passed': ', '.join(f'{count} on {platform}' for platform, count in sorted(passed.items())) or 'none',
        }
        figures |= trace_hazards.figures(self.safety, self.items, self.verdict)
        if waiting:
            figures['waiting for a gate'] = ', '.join(sorted({item.gate for item in waiting}))
        left = collections.Counter(verdict for verdict in map(self.verdict, active) if verdict in ('unchanged', 'short form'))
        if left:
            figures['left to make verify'] = ', '.join(f'{count} {why}' for why, count in sorted(left.items()))
        return figures

    def row(self, item):
        tests = [f'{test.platform} {test.name} {test.result}' for test in trace_reports.tests_of(item, self.tests)]
        return (item.id, item.rev, item.area, item.status, str(item.safety).lower(), item.method, item.text, item.rationale, item.parent,
                ' '.join(child.id for child in self.children[item.id]), ' '.join(item.targets) if item.method == 'test' else '', '; '.join(tests),
                item.evidence, '; '.join(item.shows), item.command, item.missing, item.gate, self.gates.get(item.gate, ''), self.verdict(item))

    def write_csv(self, path):
        with open(path, 'w', encoding='utf-8', newline='') as file:
            writer = csv.writer(file)
            writer.writerow(COLUMNS)
            writer.writerows(self.row(item) for item in self.items)

    def write_html(self, path, title):
        path.write_text(Page(self, title, os.path.relpath(self.root, path.parent)).text(), encoding='utf-8')


def count_of(things, name, plural):
    return f'{len(things)} {name if len(things) == 1 else plural}'


def link_to(item_id):
    return f'<a href="#{item_id}">{item_id}</a>'


class Page:
    def __init__(self, matrix, title, top):
        self.matrix, self.title, self.top = matrix, title, top

    def text(self):
        parts = (self.head(), self.problems(), self.overview(), self.needs(), *self.section('active', 'Active items'),
                 *self.section('planned', 'Planned items: no test until the capability lands'), self.unnamed(), '</main>')
        return '\n'.join(part for part in parts if part) + '\n'

    def head(self):
        cards = ''.join(f'<div><b>{escape(value)}</b><span>{escape(label)}</span></div>' for label, value in self.matrix.figures().items())
        return (f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>3DLASSO traceability</title>\n<style>{STYLE}</style>\n<main>'
                f'<h1>3DLASSO: requirements and their verification</h1>\n<p class="sub">{escape(self.title)}</p>\n<div class="cards">{cards}</div>')

    def problems(self):
        if not self.matrix.problems:
            return '<p class="good">The trace check found no problem.</p>'
        rows = ''.join(f'<li>{escape(problem)}</li>' for problem in self.matrix.problems)
        return f'<div class="bad"><b>The trace check failed: {len(self.matrix.problems)} problems</b><ul>{rows}</ul></div>'

    def overview(self):
        active, planned = self.matrix.areas('active'), self.matrix.areas('planned')
        rows = ''
        for area in dict.fromkeys([*active, *planned]):
            verdicts = collections.Counter(self.matrix.verdict(item) for item in active.get(area, []))
            counts = [len(active.get(area, [])), verdicts['verified'], verdicts['evidence'], verdicts['not run'],
                      verdicts['missing'] + verdicts['failed'], len(planned.get(area, []))]
            target = 'active' if area in active else 'planned'
            rows += f'<tr><td><a href="#{target}-{area}">{area_title(area)}</a></td>' + ''.join(f'<td>{count or "–"}</td>' for count in counts) + '</tr>'
        heads = ''.join(f'<th>{name}</th>' for name in ('area', 'active', 'by test', 'by evidence', 'gate not run', 'open', 'planned'))
        return f'<h2>Areas</h2><table class="overview"><tr>{heads}</tr>{rows}</table>'

    def needs(self):
        rows = ''.join(self.node(item) for item in self.matrix.items if item.is_need)
        return f'<h2>From needs to requirements</h2><ul class="tree">{rows}</ul>'

    def node(self, item):
        return f'<li class="{item.status}">{link_to(item.id)} {escape(item.text)}{self.branch(item)}</li>'

    def branch(self, item):
        children = self.matrix.children[item.id]
        if not children:
            return ''
        rows = ''.join(self.node(child) for child in children)
        return f'<details><summary>{count_of(children, "child", "children")}</summary><ul>{rows}</ul></details>'

    def section(self, status, heading):
        grouped = self.matrix.areas(status)
        yield f'<h2>{heading}</h2>' if grouped else ''
        for area, items in grouped.items():
            yield f'<h3 id="{status}-{area}">{area_title(area)} <small>reqs/{area}.yaml</small></h3><table class="items">'
            yield '<tr><th>item</th><th>demand and reason</th><th>from</th><th>verification</th></tr>'
            yield from (self.item(item) for item in items)
            yield '</table>'

    def item(self, item):
        safety = '<span class="safety" title="safety relevant">safety</span>' if item.safety else ''
        verdict = self.matrix.verdict(item)
        mark = '' if verdict == 'planned' else f'<span class="mark {verdict.replace(" ", "-")}">{verdict}</span>'
        parent = link_to(item.parent) if item.parent else ''
        return (f'<tr id="{item.id}" class="{item.status}"><td><b>{item.id}</b>~{item.rev}<br>{safety}</td>'
                f'<td>{escape(item.text)}<p>{escape(item.rationale)}</p></td><td>{parent}</td>'
                f'<td>{item.method}{self.where(item)} {mark}{self.evidence(item)}</td></tr>')

    def where(self, item):
        return f' on {" and ".join(item.targets)}' if len(item.targets) > 1 else ''

    def evidence(self, item):
        parts = []
        if item.evidence:
            parts.append(f'<br><a href="{self.top}/{escape(item.evidence)}">{escape(item.evidence)}</a>')
        if item.shows:
            parts.append(f'<details><summary>what it has to say</summary><ul>{"".join(f"<li>{escape(text)}</li>" for text in item.shows)}</ul></details>')
        if item.command:
            parts.append(f'<br>repeat: <code>{escape(item.command)}</code>')
        if item.missing:
            parts.append(f'<br>missing: {escape(item.missing)}')
        if item.gate:
            parts.append(f'<br>make {escape(trace_gates.command_of(item.gate))}: {self.matrix.gates.get(item.gate, "not run")}')
        tests = trace_reports.tests_of(item, self.matrix.tests)
        if tests:
            parts.append(f'<details><summary>{count_of({test.name for test in tests}, "test", "tests")}</summary>{self.test_list(tests)}</details>')
        return ''.join(parts)

    def test_list(self, tests):
        results = {}
        for test in tests:
            results.setdefault(test.name, []).append(f'{test.platform} {test.result}')
        return '<ul>' + ''.join(f'<li>{escape(name)} <i>{", ".join(sorted(found))}</i></li>' for name, found in sorted(results.items())) + '</ul>'

    def unnamed(self):
        names = sorted({test.name for test in self.matrix.tests if not test.verifies and test.result != 'disabled'})
        if not names:
            return ''
        return f'<h2>Tests that name no item</h2><details><summary>{len(names)} tests</summary><p>{escape(", ".join(names))}</p></details>'
