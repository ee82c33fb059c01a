#!/usr/bin/env python3
"""Unit tests of what evidence has to say: each plants one wrong figure, text or command, and looks for the message that names it."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import trace_evidence  # noqa: E402
import trace_items  # noqa: E402

PAGE = 'By `make look TIMES=9`:\n\n| std | -0.02\n mm |\n| flips | 100,000 | silent | 0 |\n'


class Figures(unittest.TestCase):
    def missing(self, text):
        return trace_evidence.missing_of(text, ' '.join(PAGE.split()))

    def test_texts_over_line_ends(self):
        self.assertIsNone(self.missing('TIMES=9`: | std'))
        self.assertIn('does not say "std | 0.3', self.missing('std | 0.3 mm'))

    def test_limits(self):
        for text in ('| std | {<= 0.1} mm', '| std | {< 0} mm', 'flips | {>= 100000} | silent | {= 0} |', 'flips | {> 99,999} |'):
            self.assertIsNone(self.missing(text), text)
        self.assertIn('says "flips | 100,000 | silent | 0", where < 100000 is asked', self.missing('flips | {< 100000} | silent | {= 0}'))

    def test_each_place_counts(self):
        self.assertIn('where <= 1 is asked', trace_evidence.missing_of('at {<= 1} m', 'at 0.5 m, at 2 m'))

    def test_a_word_where_a_figure_belongs(self):
        self.assertIn('does not say', trace_evidence.missing_of('lost {= 0} of 10', 'lost none of 10'))


class Evidence(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        (self.root / 'page.md').write_text(PAGE)
        (self.root / 'Makefile').write_text('look:\n\tls\ngolden: ## x\n\t$(begin)\ndefine pil-sample\n$(call begin,pil-sample)\nendef\n')
        for cached in (trace_evidence.make_gates, trace_evidence.make_targets):
            cached.cache_clear()

    def problems(self, **keys):
        item = trace_items.Item(id='LASSO-ABC-001', rev=1, method='analysis', status='active', evidence='page.md', place='abc.yaml:1')
        for key, value in keys.items():
            setattr(item, key, value)
        return ' '.join(trace_evidence.check_evidence(item, self.root))

    def test_sound(self):
        self.assertEqual(self.problems(shows=('silent | {= 0}',), command='make look TIMES=9'), '')

    def test_nothing_is_asked_of_the_file(self):
        self.assertIn('nothing says what page.md has to show: add "shows"', self.problems())
        self.assertIn('nor does the file name make golden', self.problems(gate='golden'))
        (self.root / 'page.md').write_text('make golden-sample')
        self.assertIn('nor does the file name make golden', self.problems(gate='golden'))
        (self.root / 'page.md').write_text('what make golden compares')
        self.assertEqual(self.problems(gate='golden'), '')

    def test_a_gate_of_a_family(self):
        self.assertEqual(trace_evidence.make_gates(self.root), ['golden', 'pil-sample'])
        self.assertIn('nor does the file name make pil FLIGHT=sample', self.problems(gate='pil-sample'))
        (self.root / 'page.md').write_text('what make pil FLIGHT=sample flies')
        self.assertEqual(self.problems(gate='pil-sample'), '')

    def test_a_figure_beyond_its_limit(self):
        self.assertIn('its evidence page.md says "silent | 0", where > 0 is asked: correct one of the two', self.problems(shows=('silent | {> 0}',)))

    def test_commands(self):
        for command in ('make none', 'look', 'make', 'make look; ls', './look 3'):
            self.assertIn('is no command of this repository', self.problems(shows=('100,000',), command=command), command)
        self.assertIn("does not name its command 'make look TIMES=8'", self.problems(shows=('100,000',), command='make look TIMES=8'))
        self.assertIn('no "shows" with a figure', self.problems(shows=('| flips |',), command='make look TIMES=9'))

    def test_what_nothing_repeats(self):
        item = trace_items.Item(id='LASSO-ABC-001', rev=1, method='analysis', status='active', place='abc.yaml:1')
        self.assertIn('is repeated by nothing', ' '.join(trace_evidence.check_repeatable([item], lambda item: [])))
        self.assertEqual(list(trace_evidence.check_repeatable([item], lambda item: ['a test'])), [])
        for key in ('gate', 'command'):
            setattr(item, key, 'something')
            self.assertEqual(list(trace_evidence.check_repeatable([item], lambda item: [])), [])
            setattr(item, key, '')


if __name__ == '__main__':
    unittest.main()
