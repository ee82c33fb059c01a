"""Builds one mutant of a flight source in a copy of the repository, and runs the unit tests against it until one fails.

The copy is built once without a mutant; what its test programs are and how long they take is what a mutant is compared with. Tests that come
first are those of the file's own name (x_test.cpp for x.cpp and x.hpp). After them come, for a .cpp, all others of its room and of all other
rooms; a program that is byte for byte what it was is not run. A header would have to be compiled into most tests again: its mutants are
judged by the tests that include it, and by those of the sources that include it. An index behind the end of an array ends a program:
without that it would pass wherever nothing of use lies there.
"""
import collections
import filecmp
import hashlib
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess
import xml.etree.ElementTree

NOT_COPIED = {'.git', 'out', '__pycache__'}
OPTIONS = ('-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Level', '-DCMAKE_CXX_FLAGS_LEVEL=-O1', '-DCMAKE_CXX_COMPILER=clang++-19',
           '-DCMAKE_CXX_FLAGS=-w -fsanitize=bounds -fsanitize-trap=bounds', '-DLASSO_GROUND=OFF', '-DLASSO_UNITY=OFF', '-DLASSO_WERROR=OFF')
ALL_TESTS = 'flight_tests'
SUITE = re.compile(r'^TEST(?:_F|_P)?\(\s*(\w+),', re.MULTILINE)
FAILED = re.compile(r'^\[  FAILED  \] ([\w./]+)', re.MULTILINE)
RUNNING = re.compile(r'^\[ RUN      \] ([\w./]+)', re.MULTILINE)
ALONE = 'alone'  # the program of some test files
MEMORY_BYTES = 8 << 30  # a mutant may count on without end
COMPILE_S = 600

Verdict = collections.namedtuple('Verdict', 'outcome detail')
Run = collections.namedtuple('Run', 'passed output why')


def files_below(top):
    for folder, folders, names in os.walk(top):
        folders[:] = [name for name in folders if name not in NOT_COPIED]
        yield from (os.path.relpath(os.path.join(folder, name), top) for name in names)


def copy_tree(top, tree):
    """The copy is what `top` is; a file that is as it was keeps its time, so that it is not compiled again."""
    wanted = set(files_below(top))
    for name in set(files_below(tree)) - wanted:
        (tree / name).unlink()
    for name in wanted:
        source, target = top / name, tree / name
        if not target.is_file() or not filecmp.cmp(source, target, shallow=False):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)


def limit_to(seconds):
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return limit


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ''


class Trial:
    """The copy `tree`, its build in `build`, and what its test programs are without a mutant."""

    def __init__(self, gate, tree, build, jobs):
        self.gate, self.tree, self.build, self.jobs = gate, tree, build, jobs
        self.environment = os.environ | {'CCACHE_DIR': str(gate.out / 'ccache'), 'CCACHE_MAXSIZE': '5G', 'CCACHE_BASEDIR': str(tree),
                                         'CCACHE_SLOPPINESS': 'pch_defines,time_macros'}
        self.programs, self.seconds, self.suites = {}, {}, {}

    def prepare(self):
        """Builds without a mutant, and runs all tests once: they have to pass."""
        launcher = ('-DCMAKE_CXX_COMPILER_LAUNCHER=ccache',) if shutil.which('ccache') else ()
        linker = ('-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld',) if shutil.which('ld.lld') else ()
        self.gate.run('cmake', '-S', self.tree, '-B', self.build, *OPTIONS, *launcher, *linker, env=self.environment)
        built = self.ninja(ALL_TESTS)
        if built.returncode != 0:
            self.gate.stop(f'the tests do not compile without a mutant:\n{built.stdout[-2000:]}')
        for path in sorted(self.build.glob('ut_*')):
            if path.is_file() and os.access(path, os.X_OK):
                self.measure(path.name)
        if not self.programs:
            self.gate.stop(f'{self.build} holds no test program ut_*')

    def measure(self, program):
        report = self.gate.out / f'{program}.xml'
        run = self.run(program, (f'--gtest_output=xml:{report}',), COMPILE_S)
        if not run.passed:
            self.gate.stop(f'{program} fails without a mutant:\n{run.output[-2000:]}')
        suites = xml.etree.ElementTree.parse(report).getroot().findall('testsuite')
        self.suites[program] = {suite.get('name'): float(suite.get('time')) for suite in suites}
        self.seconds[program] = sum(self.suites[program].values())
        self.programs[program] = digest(self.build / program)

    def ninja(self, *targets):
        return subprocess.run(['ninja', '-C', str(self.build), '-j', str(self.jobs), *targets], env=self.environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run(self, program, options, seconds):
        """Ends the program and what it started after so many seconds of processor time, or of ten times as many of waiting."""
        command = [f'./{program}', *options]
        process = subprocess.Popen(command, cwd=self.build, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                   preexec_fn=limit_to(int(seconds) + 1))
        try:
            output = process.communicate(timeout=10 * seconds)[0].decode(errors='replace')
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output = process.communicate()[0].decode(errors='replace')
            return Run(False, output, 'time-out')
        why = {0: '', 1: 'failed', -signal.SIGXCPU: 'time-out', -signal.SIGKILL: 'time-out'}.get(process.returncode, 'crash')
        return Run(process.returncode == 0, output, why)

    def kills(self, program, name, suites):
        """The test among the suites of a program that fails, or nothing. `name` is the file that is run."""
        if not suites:
            return ''
        seconds = sum(self.suites[program][suite] for suite in suites)
        pattern = ':'.join(f'{suite}.*' for suite in sorted(suites))
        run = self.run(name, ('--gtest_fail_fast', f'--gtest_filter={pattern}'), 10 * seconds + 10)
        if run.passed:
            return ''
        tests = FAILED.findall(run.output) or RUNNING.findall(run.output)[-1:] or ['no test']
        return f'{tests[0]} ({run.why})'

    def tests_near(self, program, file):
        """The test files of a program that include a header or test a source that does: its own test first."""
        include, room = f'#include "{file}"', program.removeprefix('ut_')
        sources = [path for folder in ('fsw', '.') for path in (self.tree / folder / room).rglob('*.cpp')]
        names = {f'{path.stem}_test.cpp' for path in sources if include in path.read_text(encoding='utf-8')}
        own = f'{pathlib.PurePath(file).stem}_test.cpp'
        tests = [path for path in (self.tree / 'ut' / room).rglob('*_test.cpp') if path.name in names or include in path.read_text(encoding='utf-8')]
        return sorted(tests, key=lambda path: (path.name != own, path.name))

    def suites_in(self, program, paths):
        return {suite for path in paths for suite in SUITE.findall(path.read_text(encoding='utf-8'))} & set(self.suites[program])

    def link_with(self, program, tests):
        """A program of some test files alone. False if it does not build."""
        commands = self.ninja('-t', 'commands', program).stdout
        line = shlex.split(next(line for line in reversed(commands.splitlines()) if f'-o {program} ' in line))
        wanted = {f'CMakeFiles/{program}.dir/{test.relative_to(self.tree).as_posix()}.o' for test in tests}
        words = [word for word in line if word not in (':', '&&') and (not word.endswith('_test.cpp.o') or word in wanted)]
        words[words.index('-o') + 1] = ALONE
        parts = {word for word in words if word.endswith(('.o', '.a')) and not word.startswith('/')}
        if self.ninja(*sorted(parts)).returncode != 0:
            return False
        return subprocess.run(words, cwd=self.build, capture_output=True, check=False).returncode == 0

    def in_order(self, file):
        """The program of the file's room, then the others, the quick ones first."""
        return sorted(self.programs, key=lambda program: (program != f'ut_{pathlib.PurePath(file).parent.name}', self.seconds[program]))

    def judge(self, file):
        """Of the tree as it is now."""
        return self.judge_header(file) if file.endswith('.hpp') else self.judge_source(file)

    def judge_header(self, file):
        """By the tests near it, its own test before the others of its room."""
        for program in self.in_order(file):
            tests = self.tests_near(program, file)
            own = [test for test in tests if test.name == f'{pathlib.PurePath(file).stem}_test.cpp']
            for some in (own, [test for test in tests if test not in own]):
                if some and not self.link_with(program, some):
                    return Verdict('not compiled', '')
                if some and (found := self.kills(program, ALONE, self.suites_in(program, some))):
                    return Verdict('killed', f'{program}: {found}')
        return Verdict('survived', '')

    def judge_source(self, file):
        """By its own test, the others of its room, and all other programs."""
        path = pathlib.PurePath(file)
        own = self.tree / 'ut' / path.parent.name / f'{path.stem}_test.cpp'
        same = True
        for program in self.in_order(file):
            if self.ninja(program).returncode != 0:
                return Verdict('not compiled', '')
            if digest(self.build / program) == self.programs[program]:
                continue
            same = False
            suites = self.suites_in(program, [own] if own.is_file() else [])
            found = self.kills(program, program, suites) or self.kills(program, program, set(self.suites[program]) - suites)
            if found:
                return Verdict('killed', f'{program}: {found}')
        return Verdict('same program' if same else 'survived', '')

    def judge_mutant(self, mutant):
        """Plants the mutant for as long as it is judged."""
        path = self.tree / mutant.file
        original = path.read_text(encoding='utf-8')
        try:
            path.write_text(original[:mutant.start] + mutant.replacement + original[mutant.end:], encoding='utf-8')
            return self.judge(mutant.file)
        finally:
            path.write_text(original, encoding='utf-8')
