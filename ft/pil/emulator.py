"""An emulated board (boards.py): 256 MB and four serial ports; counts instructions, and never waits for the host's clock."""
import ctypes
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

from boards import IN_SENSOR_PORTS, PORTS, PPC603E, SHIFT, Failure

STRAPS_MAGIC = 0x53545250
VERSION_S = 10  # of the host, in which the emulator has to say its version
LAST_WORDS_S = 2  # of the host, in which a rig says why it ends, once its emulator has
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1


def require(board=PPC603E):
    """The emulator's version."""
    if shutil.which(board.qemu) is None:
        raise Failure(f'{board.qemu} is missing: install the Debian package {board.qemu} (cfg/packages/ensure {board.packages})')
    anew = f'install the Debian package {board.qemu} anew'
    try:
        done = subprocess.run([board.qemu, '--version'], capture_output=True, encoding='utf-8', errors='replace', check=False, timeout=VERSION_S)
    except subprocess.TimeoutExpired as error:
        raise Failure(f'{board.qemu} --version says nothing for {VERSION_S} s: {anew}') from error
    except OSError as error:
        raise Failure(f'{board.qemu} does not start: {error.strerror}: {anew}') from error
    if done.returncode != 0:
        raise Failure(f'{board.qemu} does not start: {done.stderr.strip() or done.returncode}: {anew}')
    version = re.search(r'version (\S+)', done.stdout)
    if version is None:
        raise Failure(f'{board.qemu} --version says no version but "{done.stdout.strip()[:80]}": {anew}')
    return version[1]


ENDING = signal.SIGTERM, signal.SIGHUP  # end_with_children answers them


def leave_endings_to_main():
    """In each other thread. Only the main thread answers a signal, and where another one gets it nothing wakes a main thread that waits."""
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)


def dying_with(parent):
    """What a child does before its program starts: the kernel ends it when the parent is gone, however that went. One whose parent went before that asks in vain, and ends itself."""
    def prepare():
        LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)
        if os.getppid() != parent:
            os._exit(1)
    return prepare


class Children:
    """Programs that run for this one. Once they have been ended there are no more."""

    def __init__(self):
        self.running, self.lock, self.over = set(), threading.Lock(), False

    def start(self, command, **options):
        with self.lock:
            if self.over:
                raise Failure('ended by a signal')
            child = subprocess.Popen(command, stdin=subprocess.DEVNULL, preexec_fn=dying_with(os.getpid()), **options)
            self.running.add(child)
        if self.over:  # by now
            child.kill()
        return child

    def end(self, child):
        if child.poll() is None:
            child.kill()
        child.wait()
        self.running.discard(child)

    def end_all(self):
        """For threads of this program that wait for one of them."""
        self.over = True
        for child in list(self.running):
            child.kill()


CHILDREN = Children()


def end_with_children():
    """A signal that ends this program ends its with blocks, and all that runs for it."""
    def end(number, _):
        for one in ENDING:
            signal.signal(one, signal.SIG_IGN)
        CHILDREN.end_all()
        sys.exit(128 + number)
    for one in ENDING:
        signal.signal(one, end)


class Emulator:
    """Running until the end of the with block. What the board's console says is kept, and said when something fails. card: the serial ports are there. in_sensor: an image with its head beside it."""

    def __init__(self, elf, image, folder, board=PPC603E, rig=True, processor=None, ticks_per_s=None, shared=False, card=True, in_sensor=False):
        require(board)
        board.check_image(elf)
        self.board = board
        self.folder = pathlib.Path(folder)
        self.console_file = self.folder / 'console.txt'
        words = [STRAPS_MAGIC, ticks_per_s or board.ticks_per_s, 1 if rig else 0, 0]
        self.command = [*board.machine(self.folder, processor, ',memory-backend=ram' if shared or in_sensor else ''),
                        '-monitor', f'unix:{self.folder}/monitor.sock,server=on,wait=off', '-icount', f'shift={SHIFT},align=off,sleep=on']
        for name in ('camera', 'ground', 'rig'):
            self.command += ['-chardev', f'socket,id={name},path={self.folder}/{name}.sock' if rig else f'null,id={name}']
        self.command += ['-chardev', f'file,id=console,mux=on,path={self.console_file}', *board.ports(IN_SENSOR_PORTS if in_sensor else PORTS, card), '-device', f'loader,file={elf},cpu-num=0']
        if shared or in_sensor:  # memory as a file, whose content is that of fresh memory
            (self.folder / 'ram.bin').unlink(missing_ok=True)
            self.command += ['-object', f'memory-backend-file,id=ram,size=256M,mem-path={self.folder}/ram.bin,share=on']
        if shared:  # and a debug port (ft/pil/seu_board.hpp)
            self.command += ['-gdb', f'unix:{self.folder}/gdb.sock,server=on,wait=off']
        if image:
            self.command += ['-device', f'loader,file={image},addr={board.mission:#x},force-raw=on']
        (self.folder / 'straps.bin').write_bytes(b''.join(word.to_bytes(4, board.order) for word in words))
        self.command += ['-device', f'loader,file={self.folder}/straps.bin,addr={board.straps:#x},force-raw=on']

    def __enter__(self):
        self.console_file.write_text('')
        with open(self.folder / 'emulator.txt', 'w', encoding='utf-8') as log:
            self.process = CHILDREN.start(self.command, stdout=log, stderr=log)
        threading.Thread(target=self.poke, daemon=True).start()
        return self

    def poke(self):
        """A halted processor's clock can miss its start (QEMU 7.2 with -icount); whatever its main loop does starts it. No result depends on it."""
        while self.process.poll() is None:
            try:
                with socket.socket(socket.AF_UNIX) as monitor:
                    monitor.connect(f'{self.folder}/monitor.sock')
                    monitor.settimeout(1)
                    while self.process.poll() is None:
                        monitor.sendall(b'\n')
                        monitor.recv(4096)
                        time.sleep(0.02)
            except OSError:  # not there yet, or no more
                time.sleep(0.02)

    def __exit__(self, *_):
        CHILDREN.end(self.process)

    def console(self):
        return self.console_file.read_text(encoding='utf-8', errors='replace')

    def said(self):
        """What the emulator and the console said, in a sentence."""
        text = (self.folder / 'emulator.txt').read_text(encoding='utf-8').strip()
        lines = self.console().strip().splitlines()
        return '; '.join(filter(None, [text, f'the console: {lines[-1]}' if lines else 'the console is silent']))

    def end_said(self):
        """That it has ended by itself, and what it said."""
        return (f'{self.board.qemu} has ended with exit code {self.process.returncode} ({self.said()}): if it always does, install the Debian package '
                f'{self.board.qemu} anew')

    def await_console(self, text, seconds=60, longest=240):
        """Until the console says it, the emulator ends, nothing more has been said for `seconds`, or the longest time is over."""
        last = heard = self.console()
        end = time.monotonic() + longest
        quiet = time.monotonic() + seconds
        while time.monotonic() < min(end, quiet) and self.process.poll() is None and text not in heard:
            time.sleep(0.05)
            heard = self.console()
            if heard != last:
                last, quiet = heard, time.monotonic() + seconds
        return text in self.console()


def seconds_for(frames):
    """Of the host, that a flight on host and board may take: a minute, and several times what a frame takes where nothing else is done."""
    return round(60 + 0.6 * frames)


class Rig:
    """pil_rig with a board at its lines; nothing outlives the block. It ends by itself within `seconds`; if it does not, it is ended soon after."""

    GRACE_S = 10

    def __init__(self, program, arguments, seconds, progress=None):
        words = [str(program), *map(str, arguments), f'limit={seconds}', 'progress']
        self.process = CHILDREN.start(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.late, self.alone, self.complaint = False, '', ''
        self.seconds = seconds + self.GRACE_S
        self.timer = threading.Timer(self.seconds, self.end)
        self.listener = threading.Thread(target=self.listen, args=(progress,), daemon=True)

    def listen(self, progress):
        """Frames that are done; whatever else it says is for people, the last of it why it ends."""
        for line in self.process.stderr:
            if line != 'frame\n':
                self.complaint = line.strip()
                print(self.complaint, file=sys.stderr, flush=True)
            elif progress:
                progress.add()

    def end(self):
        self.late = True
        self.process.send_signal(signal.SIGKILL)

    def watch(self, machine):
        """The rig waits long for a board to come; for that of an emulator that has ended not at all."""
        while machine.process.poll() is None and self.process.poll() is None:
            time.sleep(0.05)
        end = time.monotonic() + LAST_WORDS_S
        while self.process.poll() is None and time.monotonic() < end:
            time.sleep(0.05)
        if self.process.poll() is None:
            self.alone = machine.end_said()
            self.process.kill()

    def __enter__(self):
        self.timer.start()
        self.listener.start()
        return self

    def __exit__(self, *_):
        self.timer.cancel()
        CHILDREN.end(self.process)
        self.listener.join()

    def await_ready(self):
        for line in self.process.stdout:
            if line.strip() == 'ready':
                return
        self.check(self.process.wait())

    def finish(self, machine):
        """Exit code, and what it said, or why it has ended, the emulator's board being at its lines."""
        threading.Thread(target=self.watch, args=(machine,), daemon=True).start()
        said = self.process.stdout.read().strip()
        code = self.process.wait()
        self.listener.join()
        self.check(0 if code == 1 else code)
        return code, said or self.complaint

    def check(self, code):
        if self.late:
            raise Failure(f'not done after {self.seconds} s: ended')
        if self.alone:
            raise Failure(self.alone)
        if code != 0:
            raise Failure(f'the rig has ended with exit code {code}: {self.complaint or "it says nothing"}')


def fly(program, elf, arguments, folder, seconds, board=PPC603E, linked=False, progress=None, **options):
    """One run of the rig with an emulated board; exit code, words, console. linked: the mission's image is in the board's. progress: is told of each frame."""
    os.makedirs(folder, exist_ok=True)
    if options.get('in_sensor'):
        arguments = [*arguments, f'head={board.head(elf)}', f'memory={board.ram}']
    emulator = Emulator(elf, None if linked else f'{folder}/image.3dli', folder, board, **options)
    with Rig(program, [*arguments, f'code={board.code_bytes(elf)}'], seconds, progress) as rig:
        rig.await_ready()
        with emulator:
            code, said = rig.finish(emulator)
            return code, said, emulator
