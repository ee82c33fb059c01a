"""Runs gates in two lanes: two at a time, never two that build in one folder, each after those that it waits for. Says how far they are."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import gate as gates
from progress import clock

LANES = 2
CHEAP_S = 10  # of a processor: a gate that takes no longer needs no second core
EVERY_S = 20  # between two lines of progress where there is no terminal
PATIENCE_S = 5  # of a gate that is asked to end
TAIL = 60  # lines of the output of a gate that failed
STEP = re.compile(r'^(?:\[(\d+)/(\d+)[ \]]|\s*(\d+)/(\d+) Test +#).*$', re.MULTILINE)  # of ninja and of ctest
# What make tells the makes below it, and no gate may see.
OF_MAKE = ('MAKEFLAGS', 'MFLAGS', 'MAKELEVEL', 'MAKE_TERMOUT', 'MAKE_TERMERR', 'GNUMAKEFLAGS', 'TIER', 'COMPLETE')


class Job:
    """A gate that runs: its own group of processes, whose output goes to a log."""

    def __init__(self, row, jobs, command, log):
        self.row, self.jobs, self.log, self.begun = row, jobs, log, time.monotonic()
        environment = {name: text for name, text in os.environ.items() if name not in OF_MAKE}
        log.parent.mkdir(parents=True, exist_ok=True)
        with open(log, 'wb') as file:
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, env=environment, start_new_session=True,
                                            close_fds=False)  # the lock of the run is theirs, too

    def wall(self):
        return time.monotonic() - self.begun

    def ended(self):
        """None while it runs; then its exit code and the seconds of processor time of all its processes that were waited for."""
        pid, status, used = os.wait4(self.process.pid, os.WNOHANG)
        if pid == 0:
            return None
        self.process.returncode = os.waitstatus_to_exitcode(status)
        return self.process.returncode, used.ru_utime + used.ru_stime

    def signal(self, number):
        try:
            os.killpg(self.process.pid, number)
        except ProcessLookupError:
            pass

    def end(self):
        """Ends it with all its processes."""
        self.signal(signal.SIGTERM)
        limit = time.monotonic() + PATIENCE_S
        while self.process.returncode is None and self.ended() is None and time.monotonic() < limit:
            time.sleep(0.05)
        self.signal(signal.SIGKILL)
        while self.process.returncode is None and self.ended() is None:
            time.sleep(0.05)

    def text(self):
        return self.log.read_text(encoding='utf-8', errors='replace')

    def step(self):
        """How far its build or its tests are, as ninja and ctest say."""
        with open(self.log, 'rb') as file:
            file.seek(max(0, self.log.stat().st_size - 4000))
            found = STEP.findall(file.read().decode('utf-8', 'replace'))
        return '/'.join(filter(None, found[-1])) if found else ''


class Costs:
    """Seconds of a processor that each gate took last time, kept from run to run, else those of the table."""

    def __init__(self, path, tier):
        self.path, self.tier = path, tier
        try:
            self.all = json.loads(path.read_text(encoding='utf-8'))
            self.known = {name: float(cost) for name, cost in self.all.get(tier, {}).items()}
        except (OSError, ValueError, AttributeError, TypeError):
            self.all, self.known = {}, {}

    def of(self, row):
        return self.known.get(row.name, row.cost[self.tier == 'verify'])

    def keep(self, row, used):
        self.known[row.name] = round(used, 1)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.path.write_text(json.dumps(self.all | {self.tier: self.known}, indent=1), encoding='utf-8')


class Lanes:
    """`command` gives what to call for a gate and the number of jobs, `judge` says of a gate that ended well what is wrong nevertheless."""

    def __init__(self, out, costs, command, judge):
        self.out, self.costs, self.command, self.judge = pathlib.Path(out), costs, command, judge
        self.cores = int(os.environ.get('JOBS') or os.cpu_count())
        self.waiting, self.running, self.results, self.failed = [], [], [], False
        self.begun, self.told, self.terminal = time.monotonic(), 0.0, sys.stdout.isatty()

    def run(self, rows):
        """Rows of (gate, verdict, wall and processor seconds), as they end. Stops at the first that fails; an interruption ends what runs."""
        self.waiting, self.total = list(rows), len(rows)
        try:
            while (self.waiting or self.running) and not self.failed:
                self.begin()
                time.sleep(0.1)
                self.collect()
                self.progress()
        finally:
            self.end_running()
        return self.results

    def end_running(self):
        """All at once; whoever is impatient waits until they have ended."""
        if self.running:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_IGN)
        for job in self.running:
            job.signal(signal.SIGTERM)
        for job in self.running:
            job.end()
            self.results.append((job.row, 'ended', job.wall(), 0.0))

    def elapsed(self):
        return time.monotonic() - self.begun

    def ready(self):
        """The first that waits for nothing and shares no folder with what runs."""
        unfinished = {row.name for row in self.waiting} | {job.row.name for job in self.running}
        free = (row for row in self.waiting if not unfinished & set(row.after) and not any(row.shares(job.row) for job in self.running))
        return next(free, None)

    def begin(self):
        while len(self.running) < LANES and (row := self.ready()):
            self.waiting.remove(row)
            jobs = self.jobs_of(row)
            self.running.append(Job(row, jobs, self.command(row, jobs), self.out / f'{row.name}.log'))

    def jobs_of(self, row):
        """One of the two has a job for each core, so that those that wait for its folders begin early; the other has one, and fills what is left."""
        return 1 if self.costs.of(row) <= CHEAP_S or any(job.jobs > 1 for job in self.running) else self.cores

    def collect(self):
        for job in list(self.running):
            done = job.ended()
            if done is None:
                continue
            self.running.remove(job)
            job.signal(signal.SIGKILL)  # what it left behind
            wrong = self.judge(job.row) if done[0] == 0 else f'make {gates.command_of(job.row.name)} ended with {done[0]}'
            self.results.append((job.row, 'FAILED' if wrong else 'passed', job.wall(), done[1]))
            self.conclude(job, wrong, done[1])

    def conclude(self, job, wrong, used):
        self.say(f'{job.row.name:17s}{"FAILED" if wrong else "passed"}{job.wall():8.0f} s{used:8.0f} s of a processor')
        if not wrong:
            self.costs.keep(job.row, used)
            return
        self.failed = True
        lines = [line for line in job.text().splitlines() if not STEP.match(line)]
        self.say('\n'.join(['', *lines[-TAIL:], '', f'{job.row.name}: {wrong}; all that it said: {os.path.relpath(job.log)}']))

    def say(self, text):
        print(f'\r\033[K{text}' if self.terminal else text, flush=True)

    def left(self):
        """Seconds of time, by the costs, if all cores work."""
        running = sum(max(self.costs.of(job.row) - job.wall() * self.cores / len(self.running), 0) for job in self.running)
        return (running + sum(self.costs.of(row) for row in self.waiting)) / self.cores

    def progress(self):
        now = self.elapsed()
        if not self.running or now - self.told < (1 if self.terminal else EVERY_S):
            return
        self.told = now
        jobs = ', '.join(f'{job.row.name} {job.step()}'.strip() for job in self.running)
        text = f'[{clock(now)}] {jobs}; {self.total - len(self.waiting) - len(self.running)} of {self.total} gates done, some {clock(self.left())} left'
        print(f'\r{text}\033[K' if self.terminal else text, end='' if self.terminal else '\n', flush=True)
