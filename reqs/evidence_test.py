#!/usr/bin/env python3
"""Unit tests of the evidence: small repositories in which gates passed, failed, or have not run."""
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


class EvidenceTest(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.top)
        shutil.copytree(SOUND, self.top, dirs_exist_ok=True)
        self.write('docs/verification.md', '# Page\n<!-- evidence: begin (reqs/evidence) -->\nstale text\n<!-- evidence: end -->\nafter\n')
        self.write('cfg/quality/prove.toml', 'a = 1\n')
        self.summary('prove', True, {'stack': '10 of 20 bytes'})
        self.summary('test', True, {})

    def write(self, name, text):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def summary(self, gate, passed, figures):
        self.write(f'out/{gate}/summary.json', json.dumps({'gate': gate, 'passed': passed, 'figures': figures}))

    def collect(self, exit_code=0):
        done = subprocess.run([HERE / 'evidence', self.top], cwd=self.top, capture_output=True, text=True, check=False,
                              env=os.environ | {'LASSO_OUT': str(self.top / 'out')})
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        return done

    def page(self):
        return (self.top / 'docs/verification.md').read_text()

    def test_says_what_passed_and_what_has_not_run(self):
        self.assertRegex(self.collect().stdout, r'\d+ gates not run, 3 gates passed')
        self.assertRegex(self.page(), r'\| `make prove` \| [^|]* \| passed \| stack: 10 of 20 bytes \| \d{4}-\d\d-\d\d \|')
        self.assertRegex(self.page(), r'\| `make mcdc` \| [^|]* \| not run \|  \|  \|')

    def test_replaces_what_was_between_the_markers_alone(self):
        self.collect()
        first = self.page()
        self.collect()
        self.assertEqual(self.page(), first)
        self.assertTrue(first.startswith('# Page\n') and first.endswith('\nafter\n'))
        self.assertNotIn('stale text', first)

    def test_leaves_one_folder(self):
        self.write('out/trace/matrix.html', '<a href="../../docs/page.md">')
        self.write('out/trace/matrix.o', 'object')
        self.summary('trace', True, {})
        self.write('out/evidence/stale.txt', 'from before')
        self.collect()
        folder = self.top / 'out/evidence'
        for name in ('index.html', 'versions.txt', 'docs/page.md', 'reqs/abc.yaml', 'out/prove/summary.json', 'out/test/ut_box.xml', 'cfg/quality/prove.toml'):
            self.assertTrue((folder / name).is_file(), name)
        self.assertFalse((folder / 'stale.txt').exists() or (folder / 'out/trace/matrix.o').exists())
        index = (folder / 'index.html').read_text()
        for link in [part.split('"')[0] for part in index.split('href="')[1:]]:
            self.assertTrue((folder / link).is_file() or link == 'docs/compliance.md', link)
        self.assertIn('python3: Python 3', (folder / 'versions.txt').read_text())

    def test_a_gate_that_failed(self):
        self.summary('golden', False, {'flights': '3'})
        self.assertIn('golden FAILED: flights: 3', self.collect(1).stderr)
        self.assertRegex(self.page(), r'`make golden` \| [^|]* \| FAILED \|')

    def test_a_gate_that_has_run_as_a_sample(self):
        self.write('out/golden/summary.json', '{"gate": "golden", "passed": true, "figures": {}, "sample": "3 of 360"}')
        self.collect()
        self.assertRegex(self.page(), r'`make golden` \| [^|]* \| passed as a sample \| sample: 3 of 360 \|')

    def test_a_gate_that_was_skipped_or_shortened(self):
        self.write('out/golden/summary.json', '{"gate": "golden", "passed": true, "commit": "1", "as_of": "0123456789", "figures": {}}')
        self.write('out/mcdc/summary.json', '{"gate": "mcdc", "passed": true, "form": "landing", "figures": {}}')
        self.collect()
        self.assertRegex(self.page(), r'`make golden` \| [^|]* \| passed \|  \| not run: unchanged since 0123456789 \|')
        self.assertRegex(self.page(), r'`make mcdc` \| [^|]* \| passed in short form \|')

    def test_a_summary_that_cannot_be_read(self):
        self.write('out/lint/summary.json', '{"gate": "lint"}')
        self.assertIn('out/lint/summary.json:1: not the summary', self.collect(1).stderr)

    def test_a_result_of_an_earlier_commit(self):
        for command in (['init', '-q'], ['add', 'docs'], ['-c', 'user.name=a', '-c', 'user.email=a@b', 'commit', '-qm', 'a']):
            subprocess.run(['git', *command], cwd=self.top, check=True, capture_output=True)
        os.utime(self.top / 'out/prove/summary.json', (10**9, 10**9))
        self.collect()
        self.assertIn('2001-09-09 (before this commit)', self.page())
        self.collect()
        self.assertIn('with uncommitted changes', self.page())

    def test_a_result_of_another_commit_or_of_changes_to_it(self):
        for command in (['init', '-q'], ['add', 'docs'], ['-c', 'user.name=a', '-c', 'user.email=a@b', 'commit', '-qm', 'a']):
            subprocess.run(['git', *command], cwd=self.top, check=True, capture_output=True)
        head = subprocess.run(['git', 'rev-parse', '--short=10', 'HEAD'], cwd=self.top, check=True, capture_output=True, text=True).stdout.strip()
        for commit, said in ((head, ''), (f'{head}-dirty', f' (at {head}-dirty, not this commit)'), ('0123456789', ' (at 0123456789, not this commit)')):
            with self.subTest(commit):
                self.write('out/prove/summary.json', json.dumps({'gate': 'prove', 'passed': True, 'commit': commit, 'figures': {}}))
                self.collect()
                self.assertRegex(self.page(), r'`make prove` \| [^|]* \| passed \|  \| \d{4}-\d\d-\d\d' + re.escape(said) + r' \|')

    def test_a_page_without_markers(self):
        self.write('docs/verification.md', '# Page\n')
        self.assertIn('docs/verification.md has no place for the table', self.collect(1).stderr)


if __name__ == '__main__':
    unittest.main()
