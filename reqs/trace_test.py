#!/usr/bin/env python3
"""Unit tests of the trace check: each plants one violation in a small sound repository and looks for the message that names it."""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOUND = HERE.parent / 'ut/gates/trace/sound'
NEED = (SOUND / 'reqs/needs.yaml').read_text()
ITEM, PLANNED = re.findall(r'- id:.*?(?=- id:|\Z)', (SOUND / 'reqs/abc.yaml').read_text(), re.DOTALL)
PASSED = '<testcase name="IsLong" file="../../ut/box_test.cpp" line="7" status="run" result="completed">{}</testcase>'
NAMES = '<properties><property name="verifies" value="{}"/></properties>'
REPORT = '<?xml version="1.0"?><testsuites><testsuite name="Box">{}</testsuite></testsuites>'


class TraceTest(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.top)
        shutil.copytree(SOUND, self.top, dirs_exist_ok=True)

    def write(self, name, text):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())

    def edit(self, name, old, new):
        text = (self.top / name).read_text()
        self.assertIn(old, text)
        self.write(name, text.replace(old, new))

    def report(self, test, folder='test'):
        self.write(f'out/{folder}/ut_box.xml', REPORT.format(test))

    def run_trace(self, *options, **environment):
        return subprocess.run([HERE / 'trace', *options, self.top], cwd=self.top, capture_output=True, text=True, check=False,
                              env=os.environ | {'LASSO_OUT': str(self.top / 'out')} | environment)

    def fails(self, *expected, complete=False):
        """The check fails, says all of the texts, and the summary says so too."""
        done = self.run_trace(*(['--complete'] if complete else []))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertFalse('Traceback' in done.stderr, done.stderr[-1000:])
        for text in expected:
            self.assertIn(text, done.stderr)
        self.assertFalse(json.loads((self.top / 'out/trace/summary.json').read_text())['passed'])

    def passes(self):
        done = self.run_trace()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(json.loads((self.top / 'out/trace/summary.json').read_text())['passed'])
        return done

    # The sound repository, and what is written.

    def test_sound_repository_passes(self):
        self.assertIn('2 of 2 active items traced', self.passes().stdout)

    def test_matrix_in_csv(self):
        self.passes()
        with open(self.top / 'out/trace/matrix.csv', encoding='utf-8', newline='') as file:
            rows = {row['id']: row for row in csv.DictReader(file)}
        self.assertEqual(list(rows), ['LASSO-NEED-001', 'LASSO-ABC-001', 'LASSO-ABC-002'])
        self.assertEqual(rows['LASSO-ABC-001']['tests'], 'host Box.IsLong passed; ppc603e Box.IsLong passed')
        self.assertEqual(rows['LASSO-ABC-001']['verdict'], 'verified')
        self.assertEqual(rows['LASSO-ABC-001']['children'], 'LASSO-ABC-002')
        self.assertEqual(rows['LASSO-NEED-001']['evidence'], 'docs/page.md')
        self.assertEqual(rows['LASSO-ABC-002']['verdict'], 'planned')

    def test_matrix_in_html(self):
        self.edit('reqs/abc.yaml', '3 m long', '3 m < 4 m & long')
        self.passes()
        page = (self.top / 'out/trace/matrix.html').read_text()
        for text in ('3 m &lt; 4 m &amp; long', 'id="LASSO-ABC-001"', 'href="../../docs/page.md"', 'Box.IsLong', 'no problem'):
            self.assertIn(text, page)
        self.assertGreater(page.index('<b>LASSO-ABC-002</b>'), page.index('Planned items'))
        for name in page.split('href="../../')[1:]:
            self.assertTrue((self.top / name.split('"')[0]).is_file())

    def test_failed_check_is_in_the_matrix(self):
        self.report(PASSED.format(''))
        self.fails('LASSO-ABC-001 has no passing test on host')
        self.assertIn('The trace check failed: 1 problems', (self.top / 'out/trace/matrix.html').read_text())

    # Items.

    def test_duplicate_id(self):
        self.write('reqs/xyz.yaml', ITEM)
        self.fails('reqs/xyz.yaml:1: LASSO-ABC-001 was used before (reqs/abc.yaml:1)')

    def test_missing_parent(self):
        self.edit('reqs/abc.yaml', 'parent: LASSO-NEED-001', 'parent: LASSO-NEED-009')
        self.fails('reqs/abc.yaml:5: LASSO-ABC-001: its parent LASSO-NEED-009 does not exist')

    def test_no_parent(self):
        self.edit('reqs/abc.yaml', '  parent: LASSO-NEED-001\n', '')
        self.fails('reqs/abc.yaml:1: LASSO-ABC-001 has no parent')

    def test_circular_parents(self):
        self.edit('reqs/abc.yaml', 'parent: LASSO-NEED-001', 'parent: LASSO-ABC-002')
        self.fails('LASSO-ABC-001 is its own ancestor', 'LASSO-ABC-002 is its own ancestor', 'LASSO-NEED-001 has no children')

    def test_own_parent(self):
        self.edit('reqs/abc.yaml', 'parent: LASSO-NEED-001', 'parent: LASSO-ABC-001')
        self.fails('LASSO-ABC-001 is its own ancestor')

    def test_descendant_of_a_circle_ends(self):
        self.write('reqs/xyz.yaml', PLANNED.replace('ABC-002', 'XYZ-001').replace('ABC-001', 'ABC-002'))
        self.edit('reqs/abc.yaml', 'parent: LASSO-NEED-001', 'parent: LASSO-ABC-002')
        self.fails('LASSO-ABC-001 is its own ancestor')

    def test_need_without_children(self):
        self.write('reqs/needs.yaml', NEED + NEED.replace('NEED-001', 'NEED-002'))
        self.fails('reqs/needs.yaml:11: LASSO-NEED-002 has no children')

    def test_need_with_a_parent(self):
        self.write('reqs/needs.yaml', NEED + '  parent: LASSO-ABC-001\n')
        self.fails('needs have no parent')

    def test_vague_word(self):
        for word in ('robust', 'As Needed', 'user-friendly', 'fast', 'appropriately'):
            with self.subTest(word):
                self.write('reqs/abc.yaml', (ITEM + PLANNED).replace('3 m long', f'{word} built'))
                self.fails(f'reqs/abc.yaml:3: LASSO-ABC-001 says "{word}"')

    def test_word_of_the_field_is_not_vague(self):
        self.edit('reqs/abc.yaml', '3 m long', 'sent most significant byte first, in the breakfast room')
        self.passes()

    def test_number_of_demands(self):
        self.edit('reqs/abc.yaml', 'The box shall open.', 'The box opens.')
        self.fails('reqs/abc.yaml:11: LASSO-ABC-002 has 0 "shall"')
        self.edit('reqs/abc.yaml', 'The box opens.', 'The box shall open and shall close.')
        self.fails('LASSO-ABC-002 has 2 "shall"')

    def test_demand_in_a_rationale(self):
        self.edit('reqs/abc.yaml', 'It has a lid.', 'It shall have a lid.')
        self.fails('reqs/abc.yaml:12: LASSO-ABC-002 demands something in its rationale')

    def test_inspection_without_evidence(self):
        self.edit('reqs/needs.yaml', '  evidence: docs/page.md\n', '')
        self.fails('reqs/needs.yaml:5: LASSO-NEED-001 has no evidence of its inspection')

    def test_evidence_that_is_not_there(self):
        for name in ('docs/other.md', 'docs', '../../etc/passwd', 'docs/empty.md', 'docs/blank.md', 'out/test/ctest.xml', '.git/HEAD'):
            with self.subTest(name):
                self.write('docs/empty.md', '')
                self.write('docs/blank.md', ' \n\n')
                self.write('.git/HEAD', 'ref: refs/heads/main\n')
                self.write('reqs/needs.yaml', NEED.replace('docs/page.md', name))
                self.fails(f'reqs/needs.yaml:8: LASSO-NEED-001: there is no file {name}')

    def test_evidence_that_says_something_else(self):
        self.edit('docs/page.md', '1,500', '900')
        self.fails('LASSO-NEED-001: its evidence docs/page.md says "Seen 1,200 times of 900", where >= 1000 is asked')
        self.edit('docs/page.md', 'Seen', 'Heard')
        self.fails('reqs/needs.yaml:9: LASSO-NEED-001: its evidence docs/page.md does not say')

    def test_needs_that_are_planned_say_why(self):
        self.edit('reqs/needs.yaml', 'status: active', 'status: planned')
        self.fails('LASSO-NEED-001 is a planned need: say by "missing" what it still lacks')
        self.write('reqs/needs.yaml', NEED + '  missing: Eyes.\n')
        self.fails('LASSO-NEED-001 is active: remove "missing"')

    def test_evidence_of_what_is_tested(self):
        self.edit('reqs/abc.yaml', 'safety: true\n', 'safety: true\n  evidence: docs/page.md\n')
        self.fails('LASSO-ABC-001 is verified by test: remove its evidence')

    def test_targets_of_what_is_not_tested(self):
        self.write('reqs/needs.yaml', NEED + '  targets: [host]\n')
        self.fails('LASSO-NEED-001 is verified by inspection: targets are for tests')

    # Malformed files.

    def test_not_yaml(self):
        self.edit('reqs/abc.yaml', '"The box shall be 3 m long."', 'The box: shall: be')
        self.fails('reqs/abc.yaml:3: not valid YAML', 'quote texts')

    def test_not_text(self):
        self.write('reqs/abc.yaml', b'- id: \xff\xfe\n')
        self.fails('reqs/abc.yaml:1: not readable', 'UTF-8')

    def test_not_a_file(self):
        (self.top / 'reqs/xyz.yaml').mkdir()
        self.fails('reqs/xyz.yaml:1: not readable (Is a directory): check the file')

    def test_a_file_that_nobody_reads(self):
        for name in ('reqs/xyz.yml', 'reqs/more/xyz.yaml'):
            with self.subTest(name):
                self.write(name, ITEM.replace('ABC', 'XYZ'))
                self.fails(f'{name}:1: not read: move its items')
                (self.top / name).unlink()

    def test_not_a_list(self):
        self.write('reqs/xyz.yaml', 'id: LASSO-XYZ-001\n')
        self.fails('reqs/xyz.yaml:1: not a list of items')
        self.write('reqs/xyz.yaml', '- just text\n')
        self.fails('reqs/xyz.yaml:1: not an item')
        self.write('reqs/xyz.yaml', '')
        self.fails('reqs/xyz.yaml:1: not a list of items')

    def test_missing_key(self):
        for number, line in enumerate(ITEM.splitlines()[1:], 2):
            if 'parent' not in line:
                with self.subTest(line):
                    self.write('reqs/abc.yaml', ITEM.replace(line + '\n', '') + PLANNED)
                    self.fails(f"reqs/abc.yaml:1: key '{line.split(':')[0].strip()}' is missing: add it")

    def test_unknown_key_and_key_twice(self):
        self.edit('reqs/abc.yaml', 'safety: true', 'safety: true\n  saftey: true\n  rev: 2')
        self.fails("reqs/abc.yaml:8: unknown key 'saftey'", "reqs/abc.yaml:9: key 'rev' twice")

    def test_wrong_type(self):
        for right, wrong, expected in (('rev: 2', 'rev: two', 'a whole number from 1'), ('rev: 2', 'rev: 0', 'a whole number from 1'),
                                       ('safety: true', 'safety: maybe', 'true or false'), ('status: active', 'status: done', 'one of active, planned'),
                                       ('method: test', 'method: [test]', 'one of test'), ('id: LASSO-ABC-001', 'id: ABC-1', 'LASSO-AREA-nnn'),
                                       ('rationale: It has to fit.', 'rationale: 7', 'a sentence'), ('rev: 2', 'rev: 2\n  targets: host', 'a list of host'),
                                       ('rev: 2', 'rev: 2\n  targets: [moon]', 'a list of host')):
            with self.subTest(wrong):
                self.write('reqs/abc.yaml', ITEM.replace(right, wrong) + PLANNED)
                self.fails('reqs/abc.yaml:', wrong.split('\n')[-1].split(':')[0].strip() + ' is ', f'write {expected}')

    def test_no_requirements(self):
        shutil.rmtree(self.top / 'reqs')
        self.fails('reqs: no requirements found below')

    # Reports.

    def test_unknown_id(self):
        self.report(PASSED.format(NAMES.format('LASSO-ABC-001~2 LASSO-ABC-777~1')))
        self.fails('ut/box_test.cpp:7: Box.IsLong names LASSO-ABC-777~1, an unknown id')

    def test_stale_revision(self):
        self.edit('reqs/abc.yaml', 'rev: 2', 'rev: 3')
        self.fails('Box.IsLong verifies LASSO-ABC-001~2, but reqs/abc.yaml:2 is at revision 3', 'LASSO-ABC-001 has no passing test on host')

    def test_name_without_revision(self):
        self.report(PASSED.format(NAMES.format('LASSO-ABC-001')))
        self.fails("names 'LASSO-ABC-001': write VERIFIES", 'LASSO-ABC-001 has no passing test on host')

    def test_what_does_not_count(self):
        case = '<testcase name="IsLong" status="{}" result="{}">' + NAMES.format('LASSO-ABC-001~2') + '{}</testcase>'
        for status, result, child, word in (('run', 'skipped', '<skipped message="not here"/>', 'skipped'), ('run', 'completed', '<skipped/>', 'skipped'),
                                            ('notrun', 'suppressed', '', 'disabled'), ('notrun', 'completed', '', 'disabled'),
                                            ('run', 'suppressed', '', 'disabled'), ('run', 'completed', '<failure message="1 != 2"/>', 'failed')):
            with self.subTest(word):
                self.report(case.format(status, result, child))
                self.fails(f'LASSO-ABC-001 has no passing test on host ({word} does not count)')

    def test_failed_test_beside_a_passing_one(self):
        failed = PASSED.format(NAMES.format('LASSO-ABC-001~2') + '<failure message="1 != 2"/>').replace('IsLong', 'IsWide')
        self.report(PASSED.format(NAMES.format('LASSO-ABC-001~2')) + failed)
        self.fails('LASSO-ABC-001: its test Box.IsWide failed on host')

    def test_test_on_the_wrong_platform(self):
        self.edit('reqs/abc.yaml', 'method: test', 'method: test\n  targets: [host, ppc603e]')
        self.passes()
        self.report(PASSED.format(''), 'ppc-test')
        self.fails('LASSO-ABC-001 has no passing test on ppc603e')

    def test_program_that_crashed(self):
        self.edit('out/test/ctest.xml', 'status="run"', 'status="fail"')
        self.fails('out/test/ctest.xml: the test program ut_box did not pass')

    def test_absent_reports(self):
        shutil.rmtree(self.top / 'out/ppc-test')
        self.fails('out/ppc-test: no reports of ppc603e: run make ppc-test first')

    def test_reports_of_a_run_that_did_not_end(self):
        (self.top / 'out/test/summary.json').unlink()
        self.fails('out/test: make test did not pass last time (not run): run it again')

    def test_reports_of_a_run_that_failed(self):
        self.edit('out/ppc-test/summary.json', 'true', 'false')
        self.fails('out/ppc-test: make ppc-test did not pass last time (failed): run it again')

    def test_absent_list_of_programs(self):
        (self.top / 'out/test/ctest.xml').unlink()
        self.fails('out/test/ctest.xml: not readable', 'run make test again')

    def test_cut_report(self):
        self.write('out/test/ut_box.xml', REPORT.format(PASSED)[:80])
        self.fails('out/test/ut_box.xml:1: not valid XML', 'run make test again')

    def test_report_without_tests(self):
        self.report('')
        self.fails('out/test: the reports hold no test')

    # Gates.

    def rest_on_golden(self, summary):
        self.write('reqs/needs.yaml', NEED + '  gate: golden\n')
        if summary is not None:
            self.write('out/golden/summary.json', summary if isinstance(summary, str) else json.dumps(summary))

    def test_gate_passed_or_not_run(self):
        self.rest_on_golden(None)
        self.assertIn('golden waiting for a gate', self.passes().stdout)
        self.rest_on_golden({'gate': 'golden', 'passed': True, 'figures': {}})
        self.assertNotIn('waiting', self.passes().stdout)

    def test_gate_failed(self):
        self.rest_on_golden({'gate': 'golden', 'passed': False, 'figures': {}})
        self.fails('reqs/needs.yaml:11: LASSO-NEED-001 rests on make golden, which failed')

    def test_gate_that_has_run_as_a_sample(self):
        self.rest_on_golden({'gate': 'golden', 'passed': True, 'figures': {}, 'sample': '3 of 360'})
        self.passes()
        self.fails('LASSO-NEED-001 rests on make golden, which has run as a sample: run it whole', complete=True)

    # What a landing leaves to make verify.

    def test_gate_that_is_unchanged_or_has_run_in_its_short_form(self):
        for word, mark in (('unchanged', {'as_of': '0123456789'}), ('short form', {'form': 'landing'})):
            with self.subTest(word):
                self.rest_on_golden({'gate': 'golden', 'passed': True, 'figures': {}} | mark)
                self.assertIn(f'1 {word} left to make verify', self.passes().stdout)
                self.fails(f'LASSO-NEED-001 rests on make golden, of which only this is known: {word}; run it whole', complete=True)

    def test_platform_that_is_unchanged(self):
        shutil.rmtree(self.top / 'out/ppc-test')
        self.edit('reqs/abc.yaml', 'method: test', 'method: test\n  targets: [host, ppc603e]')
        self.write('out/ppc-test/summary.json', '{"gate": "ppc-test", "passed": true, "figures": {}, "as_of": "0123456789"}')
        self.assertIn('1 unchanged left to make verify', self.passes().stdout)
        self.fails('the tests of ppc603e have not run whole (unchanged): run make ppc-test', complete=True)

    def test_old_reports_of_a_platform_that_is_unchanged(self):
        self.report(PASSED.format('<failure message="1 != 2"/>'))
        self.write('out/test/summary.json', '{"gate": "test", "passed": true, "figures": {}, "as_of": "0123456789"}')
        self.passes()

    def test_platform_in_its_short_form(self):
        self.edit('reqs/abc.yaml', 'method: test', 'method: test\n  targets: [host, ppc603e]')
        self.report(PASSED.format(''), 'ppc-test')
        self.write('out/ppc-test/summary.json', '{"gate": "ppc-test", "passed": true, "figures": {}, "form": "landing"}')
        self.assertIn('1 short form left to make verify', self.passes().stdout)
        self.fails('the tests of ppc603e have not run whole (short form): run make ppc-test', complete=True)
        self.report(PASSED.format('<failure message="1 != 2"/>' + NAMES.format('LASSO-ABC-001~2')), 'ppc-test')
        self.fails('LASSO-ABC-001: its test Box.IsLong failed on ppc603e')

    def test_gate_summary_malformed(self):
        for text in ('{\n"gate": ', '{}', '[]', '{"gate": "other", "passed": true, "figures": {}}', '{"gate": "golden", "passed": 1, "figures": {}}'):
            with self.subTest(text):
                self.rest_on_golden(text)
                self.fails('out/golden/summary.json:', 'run make golden again')

    def test_gate_that_does_not_exist(self):
        self.edit('Makefile', 'golden', 'silver')
        self.rest_on_golden(None)
        self.fails('LASSO-NEED-001: there is no make golden yet')

    def test_target_that_is_no_gate(self):
        self.write('reqs/needs.yaml', NEED + '  gate: clean\n')
        self.fails('LASSO-NEED-001: there is no make clean yet that is a gate')

    def test_gate_that_is_this_check(self):
        self.edit('Makefile', 'golden', 'trace')
        self.write('reqs/needs.yaml', NEED + '  gate: trace\n')
        self.fails('LASSO-NEED-001 cannot rest on this check itself')

    # The tool.

    def test_missing_yaml_library(self):
        self.write('without/yaml.py', 'raise ImportError')
        done = self.run_trace(PYTHONPATH=str(self.top / 'without'))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('install the Debian package python3-yaml', done.stderr)


if __name__ == '__main__':
    unittest.main()
