"""How far a long command is, on standard error: one changing line on a terminal, else a line now and then."""
import sys
import threading
import time


def clock(seconds):
    seconds = round(seconds)
    return f'{seconds // 3600}:{seconds // 60 % 60:02d}:{seconds % 60:02d}'


class Progress:
    """`total` steps of `unit` are to come, of which `first` are done from before. Any thread may add some."""

    def __init__(self, what, total, unit, first=0):
        self.what, self.total, self.unit, self.first, self.done = what, total, unit, first, first
        self.terminal = sys.stderr.isatty()
        self.begun, self.told, self.lock = time.monotonic(), 0.0, threading.Lock()

    def add(self, steps=1):
        with self.lock:
            self.done += steps
            now = time.monotonic()
            if now - self.told >= (0.2 if self.terminal else 30) or self.done >= self.total:
                self.told = now
                self.tell(now - self.begun)

    def tell(self, seconds):
        each = seconds / max(self.done - self.first, 1)
        text = f'{self.what}: {self.done}/{self.total} {self.unit}, {each:.2f} s each, {clock(each * (self.total - self.done))} left'
        end = '\n' if not self.terminal or self.done >= self.total else ''
        print(f'\r{text}\033[K' if self.terminal else text, end=end, file=sys.stderr, flush=True)
