"""The record of the last commit at which every gate passed in its whole form (verified.toml), and what changed since."""
import datetime
import pathlib
import platform
import re
import subprocess
import tomllib

import gate_table

PLACE = 'cfg/quality/verified.toml'
OLDEST = datetime.timedelta(days=7)
PROGRAMS = ('g++', 'clang++-19', 'powerpc-linux-gnu-g++', 'arm-linux-gnueabihf-g++', 'qemu-ppc', 'qemu-system-ppc', 'qemu-system-arm', 'cmake', 'ninja', 'gcovr',
            'llvm-cov-19', 'clang-format', 'clang-tidy-22', 'cppcheck')
# The lists in cfg/packages that the gates need.
PACKAGES = ('build', 'target', 'target-arm', 'lint', 'clang', 'test', 'trace', 'coverage', 'bench', 'soft-float', 'package', 'web', 'page', 'python')


def ask(*command, cwd=None):
    """What a program writes; None where it is missing or fails."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True, cwd=cwd).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def tools(top):
    """The versions of programs, and of the packages in cfg/packages, libraries among them."""
    versions = {'python3': '.'.join(platform.python_version_tuple()[:2]), 'system': f'{platform.system()} {platform.machine()}'}
    for program in PROGRAMS:
        versions[program] = next(iter((ask(program, '--version') or 'not installed').splitlines()), '')
    paths = [pathlib.Path(top) / f'cfg/packages/{name}.txt' for name in PACKAGES]
    lists = ''.join(path.read_text(encoding='utf-8') for path in paths if path.is_file())
    names = sorted(set(re.findall(r'^([a-z0-9][\w.+-]*)', lists, re.MULTILINE)))
    for line in packages(names):
        name, _, version = line.partition(' ')
        versions[f'package {name}'] = version
    return versions


def packages(names):
    """Those that are installed, each with its version. dpkg-query fails for one that it does not know, and names the others nevertheless."""
    try:
        done = subprocess.run(['dpkg-query', '-W', '-f', '${Package} ${Version}\n', *names], capture_output=True, text=True, check=False)
    except OSError:
        return []
    return [line for line in done.stdout.splitlines() if not line.endswith(' ')] if names else []


class Since:
    """What changed since a commit: in commits, in the working tree, and in files that git does not know yet. ValueError: git cannot tell."""

    def __init__(self, top, commit):
        if not re.fullmatch('[0-9a-f]{40}', commit) or ask('git', 'merge-base', '--is-ancestor', commit, 'HEAD', cwd=top) is None:
            raise ValueError(f'{commit[:10]} is no ancestor of this commit')
        differing = ask('git', '-c', 'core.quotepath=off', 'diff', '--name-only', '--no-renames', commit, '--', cwd=top)
        new = ask('git', '-c', 'core.quotepath=off', 'ls-files', '--others', '--exclude-standard', cwd=top)
        text = ask('git', 'show', f'{commit}:{gate_table.PLACE}', cwd=top)
        if differing is None or new is None or text is None:
            raise ValueError(f'git cannot compare with {commit[:10]}')
        self.rows, self.changed = gate_table.parse(text), {*differing.splitlines(), *new.splitlines()} - {PLACE}

    def stands(self, row):
        """Whether a result of the gate from then still holds: nothing that it depends on changed, its row of the table included."""
        then = self.rows.get(row.name)
        same = then and (then.inputs, then.landing, then.verify) == (row.inputs, row.landing, row.verify)
        return bool(row.inputs and same and not any(map(row.depends_on, self.changed)))


class Record:
    """`commit` is empty where nothing may rest on the record, and `reason` says why."""

    def __init__(self, top):
        self.top, self.commit, self.when, self.gates, self.since = pathlib.Path(top), '', '', [], None
        self.reason = self.read()

    def read(self):
        try:
            table = tomllib.loads((self.top / PLACE).read_text(encoding='utf-8'))
            commit, date, versions, proven = str(table['commit']), table['date'], table['tools'], table['gates']
            age = datetime.datetime.now(datetime.timezone.utc) - date
        except FileNotFoundError:
            return f'there is no {PLACE}; make verify writes it'
        except (OSError, KeyError, TypeError, ValueError) as error:
            return f'{PLACE} is not readable ({type(error).__name__}: {error})'
        if not -datetime.timedelta(hours=1) < age <= OLDEST:
            return f'{PLACE} is of {date:%Y-%m-%d}: older than {OLDEST.days} days, or of the future'
        try:
            self.since = Since(self.top, commit)
        except ValueError as error:
            return f'{PLACE}: {error}'
        present = tools(self.top)
        other = sorted(name for name in present.keys() | versions.keys() if present.get(name) != versions.get(name))
        if other:
            return f'other tools than in {PLACE}: {", ".join(other)}'
        self.commit, self.when, self.gates = commit, f'{date:%Y-%m-%d}', proven
        return ''

    def stands(self, row):
        """Whether the gate passed then, and its result still holds."""
        return bool(self.commit) and row.name in self.gates and self.since.stands(row)


def clean_commit(top):
    """The whole name of HEAD; empty where the working tree differs from it, untracked files included."""
    status = ask('git', 'status', '--porcelain', cwd=top)
    return (ask('git', 'rev-parse', 'HEAD', cwd=top) or '') if status == '' else ''


def write(top, commit, date, names):
    """`date` is that of the oldest proof."""
    lines = ['# Written by make verify: at this commit every gate passed in its whole form. .ci/run skips gates whose inputs are as they were then.',
             f'commit = "{commit}"', f'date = {date.isoformat()}', 'gates = [' + ', '.join(f'"{name}"' for name in names) + ']', '', '[tools]']
    lines += [f'"{name}" = {quoted(version)}' for name, version in tools(top).items()]
    (pathlib.Path(top) / PLACE).write_text('\n'.join(lines) + '\n', encoding='utf-8')


def quoted(text):
    return '"' + text.replace('\\', '\\\\').replace('"', '\\"') + '"'
