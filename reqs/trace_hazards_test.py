#!/usr/bin/env python3
"""Unit tests of the check of hazards and failure modes: each plants one violation in a small sound repository and looks for the message that names it."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import trace_hazards  # noqa: E402
import trace_hazards_page  # noqa: E402
import trace_items  # noqa: E402

FIXTURES = pathlib.Path(__file__).resolve().parent.parent / 'ut/gates/trace'


class HazardsTest(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.top)
        for name in ('sound', 'hazards'):
            shutil.copytree(FIXTURES / name, self.top, dirs_exist_ok=True)

    def edit(self, name, old, new):
        path = self.top / name
        self.assertIn(old, path.read_text())
        path.write_text(path.read_text().replace(old, new))

    def problems(self):
        items, wrong = trace_items.read_items(self.top)
        safety, unread = trace_hazards.read_safety(self.top)
        return '\n'.join([*wrong, *unread, *trace_hazards.check_safety(safety, items, self.top), *trace_hazards_page.check_page(safety, self.top)])

    def says(self, text):
        self.assertIn(text, self.problems())

    def test_sound(self):
        self.assertEqual(self.problems(), '')

    def test_a_control_that_does_not_exist(self):
        self.edit('reqs/hazards.yaml', 'LASSO-ABC-001', 'LASSO-ABC-009')
        self.says('reqs/hazards.yaml:6: LASSO-HAZ-001: its control LASSO-ABC-009 does not exist')
        self.says('LASSO-HAZ-001 has no control that a test or a gate exercises')

    def test_a_control_that_is_only_planned(self):
        self.edit('reqs/fmea.yaml', '[LASSO-ABC-001]', '[LASSO-ABC-001, LASSO-ABC-002]')
        self.says('reqs/fmea.yaml:10: LASSO-FME-001: its control LASSO-ABC-002 is only planned')

    def test_reading_alone_exercises_nothing(self):
        self.edit('reqs/fmea.yaml', 'controls: [LASSO-ABC-001]', 'controls: [LASSO-NEED-001]')
        self.says('LASSO-FME-001 has no control that a test or a gate exercises')

    def test_a_catastrophe_has_two_controls(self):
        self.edit('reqs/hazards.yaml', 'critical', 'catastrophic')
        self.says('LASSO-HAZ-001 is catastrophic, and has fewer than 2 controls')
        self.edit('reqs/hazards.yaml', '  remains', '    - control: The same again.\n      by: [LASSO-ABC-001]\n  remains')
        self.says('fewer than 2 controls that are exercised and independent')
        self.edit('reqs/abc.yaml', 'status: planned', 'status: active')
        self.edit('reqs/abc.yaml', 'method: demonstration', 'method: test')
        self.edit('reqs/hazards.yaml', 'again.\n      by: [LASSO-ABC-001]', 'again.\n      by: [LASSO-ABC-001, LASSO-ABC-002]')
        self.assertNotIn('catastrophic', self.problems())

    def test_a_hazard_without_a_cause(self):
        self.edit('reqs/fmea.yaml', 'LASSO-HAZ-001', 'LASSO-HAZ-002')
        self.says('LASSO-FME-001: there is no hazard LASSO-HAZ-002')
        self.says('LASSO-HAZ-001 follows from no row of reqs/fmea.yaml')

    def test_safety_items_control_something(self):
        for name in ('hazards', 'fmea'):
            self.edit(f'reqs/{name}.yaml', 'LASSO-ABC-001', 'LASSO-NEED-001')
        self.says('reqs/abc.yaml:7: LASSO-ABC-001 is relevant to safety, and controls no hazard')

    def test_faults_of_the_table(self):
        self.edit('docs/faults.md', '| ruler_short', '| ruler_long | | |\n| saw_blunt')
        for text in ('LASSO-FME-001: the table of faults (docs/faults.md) has no ruler_short', 'the fault ruler_long is named by no row', 'the fault saw_blunt is named'):
            self.says(text)

    def test_an_id_twice(self):
        self.edit('reqs/hazards.yaml', '- id', (self.top / 'reqs/hazards.yaml').read_text() + '- id')
        self.says('LASSO-HAZ-001 was used before')

    def test_malformed(self):
        for name, old, new, said in (('hazards', 'severity: critical', 'severity: bad', "severity is 'bad': write one of catastrophic"),
                                     ('hazards', '      by: [LASSO-ABC-001]\n', '', 'controls is of another type: write a list of "control'),
                                     ('hazards', '  spacecraft: A floor.\n', '', "key 'spacecraft' is missing"),
                                     ('fmea', 'part: sensor', 'part: soul', 'write one of sensor, link'),
                                     ('fmea', 'controls: [LASSO-ABC-001]', 'controls: []', 'controls is of another type: write a list of LASSO-AREA-nnn'),
                                     ('fmea', '- id', 'x: [', 'not valid YAML')):
            with self.subTest(said):
                self.setUp()
                self.edit(f'reqs/{name}.yaml', old, new)
                self.says(said)

    def test_the_page_is_that_of_the_files(self):
        self.edit('reqs/fmea.yaml', 'by eye', 'by hand')
        self.says('docs/hazards.md:1: not what reqs/hazards.yaml and reqs/fmea.yaml say: make write WHAT=hazards writes it')
        (self.top / 'docs/hazards.md').unlink()
        self.says('make write WHAT=hazards writes it')

    def test_controls_that_are_not_shown(self):
        items, _ = trace_items.read_items(self.top)
        safety, _ = trace_hazards.read_safety(self.top)
        for verdict in ('missing', 'failed'):
            found = '\n'.join(trace_hazards.check_shown(safety, items, lambda item, word=verdict: word))
            self.assertIn(f'LASSO-HAZ-001: controls that are not shown: LASSO-ABC-001 ({verdict})', found)
            self.assertIn('LASSO-FME-001', found)
        for verdict in ('verified', 'evidence', 'not run', 'unchanged'):
            self.assertEqual(list(trace_hazards.check_shown(safety, items, lambda item, word=verdict: word)), [])
        self.assertEqual(trace_hazards.figures(safety, items, lambda item: 'verified')['hazards with all controls shown'], '1 of 1')
        self.assertEqual(trace_hazards.figures(safety, items, lambda item: 'not run')['failure modes with all controls shown'], '0 of 1')


if __name__ == '__main__':
    unittest.main()
