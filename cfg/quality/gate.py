"""What the gates have in common: findings, figures, tools, and the summary that each leaves in out/GATE/summary.json."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib

TOP = pathlib.Path(__file__).resolve().parents[2]
OUT = pathlib.Path(os.environ.get('LASSO_OUT', TOP / 'out')).resolve()

# Programs that gates call, the Debian package of each, and the list that installs it (cfg/packages).
TOOLS = {
    'powerpc-linux-gnu-g++': ('g++-powerpc-linux-gnu', 'target'),
    'powerpc-linux-gnu-nm': ('g++-powerpc-linux-gnu', 'target'),
    'powerpc-linux-gnu-objdump': ('g++-powerpc-linux-gnu', 'target'),
    'powerpc-linux-gnu-size': ('g++-powerpc-linux-gnu', 'target'),
    'qemu-ppc': ('qemu-user', 'target'),
    'qemu-system-ppc': ('qemu-system-ppc', 'target'),
    'arm-linux-gnueabihf-nm': ('g++-arm-linux-gnueabihf', 'target-arm'),
    'arm-linux-gnueabihf-size': ('g++-arm-linux-gnueabihf', 'target-arm'),
    'qemu-system-arm': ('qemu-system-arm', 'target-arm'),
    'clang-format': ('clang-format', 'lint'),
    'clang-tidy-22': ('clang-tidy-22', 'lint'),
    'cppcheck': ('cppcheck', 'lint'),
    'chromium': ('chromium', 'page'),
    'ctest': ('cmake', 'build'),
    'git': ('git', 'lint'),
    'gcovr': ('gcovr', 'coverage'),
    'llvm-cov-19': ('llvm-19', 'coverage'),
    'llvm-profdata-19': ('llvm-19', 'coverage'),
    'node': ('nodejs', 'web'),
    'npm': ('npm', 'web'),
}
# Targets of make that stand for several commands, and the variable that says which.
FAMILIES = {'campaign': 'WHAT', 'count': 'WHAT', 'flips': 'WHERE', 'pil': 'FLIGHT'}


def command_of(name):
    """What make is told for the gate or campaign that leaves its results in out/NAME: NAME itself, of a family TARGET VARIABLE=VALUE for TARGET-VALUE."""
    target, _, value = name.partition('-')
    return f'{target} {FAMILIES[target]}={value}' if value and target in FAMILIES else name


def commit(top=TOP):
    """The commit that the sources are of, -dirty if files differ from it or are new; empty outside of a repository."""
    def ask(*words):
        return subprocess.run(['git', '-C', str(top), *words], capture_output=True, text=True, check=True).stdout.strip()
    try:
        return ask('rev-parse', '--short=10', 'HEAD') + ('-dirty' if ask('status', '--porcelain') else '')
    except (OSError, subprocess.CalledProcessError):
        return ''


class Gate:
    """Collects what a gate finds and measures. `with Gate(name) as gate:` ends the program, at once if something cannot go on (stop())."""

    def __init__(self, name):
        self.name, self.findings, self.figures, self.sample = name, [], {}, ''
        self.out = OUT / name

    def __enter__(self):
        self.out.mkdir(parents=True, exist_ok=True)
        return self

    def find(self, text):
        """A finding: place, value, remedy."""
        self.findings.append(text)

    def stop(self, text):
        """A finding after which nothing more can be checked."""
        self.find(text)
        raise Stopped

    def figure(self, label, text):
        self.figures[label] = str(text)

    def table(self, path):
        """The gate's table, a TOML file."""
        try:
            return tomllib.loads(pathlib.Path(path).read_text(encoding='utf-8'))
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            return self.stop(f'{path}: {error}: correct the file')

    def number(self, name, text, most, whole=None):
        """A count that somebody asks for, 1 to `most`. Fewer than the whole are a sample, on which nothing may rest."""
        if not text.isascii() or not text.isdecimal() or not 1 <= int(text[:20]) <= most:
            self.stop(f'{name}={text}: a whole number from 1 to {most} is needed')
        if whole and int(text) < whole:
            self.sample = f'{text} of {whole}'
        return int(text)

    def tool(self, name):
        if shutil.which(name) is None:
            package, where = TOOLS[name]
            self.stop(f'{name} is missing: install the Debian package {package} (cfg/packages/ensure {where})')
        return name

    def call(self, *command, **options):
        """The exit code of a command that says what it does itself."""
        self.tool(command[0]) if command[0] in TOOLS else None
        sys.stdout.flush()
        return subprocess.run([str(word) for word in command], check=False, **options).returncode

    def run(self, *command, **options):
        """What the command wrote; a finding if it fails."""
        self.tool(command[0]) if command[0] in TOOLS else None
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
        if done.returncode != 0:
            self.stop(f'{" ".join(map(str, command))} failed:\n{done.stderr.strip() or done.stdout.strip()}')
        return done.stdout

    def __exit__(self, kind, error, trace):
        if isinstance(error, OSError) and error.filename:
            self.find(f'{error.filename}: {error.strerror}: give the right folder, and build first what it holds (make {command_of(self.name)})')
        elif isinstance(error, subprocess.CalledProcessError):
            self.find(f'{error.cmd[0]} ended with {error.returncode}: {(error.stderr or "what it says above").strip()}')
        elif kind is not None and kind is not Stopped:
            self.find(f'{kind.__name__}: {error}')
            self.conclude()
            return False
        sys.exit(self.conclude())

    def conclude(self):
        passed = not self.findings
        summary = {'gate': self.name, 'passed': passed, 'commit': commit(), 'figures': self.figures} | ({'sample': self.sample} if self.sample else {})
        summary |= {'form': 'landing'} if os.environ.get('TIER') == 'landing' else {}  # shorter than in make verify
        with open(self.out / 'summary.json', 'w', encoding='utf-8') as file:
            json.dump(summary, file, indent=1, ensure_ascii=False)
        for finding in self.findings:
            print(f'{self.name}: {finding}', file=sys.stderr)
        said = ', '.join(f'{text} {label}' for label, text in self.figures.items())
        good = f'passed as a sample, {self.sample}' if self.sample else 'passed'
        print(f'{self.name}: {good if passed else f"FAILED, {len(self.findings)} findings"}{f" ({said})" if said else ""}')
        return 0 if passed else 1


class Stopped(Exception):
    pass
