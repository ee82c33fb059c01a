"""The emulated board: QEMU's g3beige with a 603e, 256 MB and a card of four serial ports; counts instructions, and never waits for the host's clock."""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import threading
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
QEMU, PACKAGE = 'qemu-system-ppc', 'qemu-system-ppc'
SHIFT = 7  # an instruction is 2^7 ns of the emulator's time
MIPS = 100  # and 10 ns of the board's
TIME_BASE_HZ = 16600000  # of the emulator's time
TICKS_PER_S = int(TIME_BASE_HZ * (2 ** SHIFT) * MIPS / 1000)  # of the board's
TICKS_PER_INSTRUCTION = TIME_BASE_HZ * 2 ** SHIFT / 1e9
STRAPS, STRAPS_MAGIC, MISSION = 0x04010000, 0x53545250, 0x04100000
BOARD_ID = b'3dlasso board ppc603e-grackle'


class Failure(Exception):
    """A reason for a person."""


def require():
    if shutil.which(QEMU) is None:
        raise Failure(f'{QEMU} is missing: install the Debian package {PACKAGE} (cfg/packages/ensure target)')
    done = subprocess.run([QEMU, '--version'], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f'{QEMU} does not start: {done.stderr.strip() or done.returncode}: install the Debian package {PACKAGE} anew')
    return re.search(r'version (\S+)', done.stdout).group(1)


def check_image(elf):
    """The image is for this board."""
    try:
        content = pathlib.Path(elf).read_bytes()
    except OSError as error:
        raise Failure(f'{elf}: {error.strerror}: build it first (make pil)') from error
    if content[:4] != b'\x7fELF' or content[4:6] != b'\x01\x02' or content[18:20] != b'\x00\x14':
        raise Failure(f'{elf}: not an image for a 32-bit PowerPC: build the board ppc603e (cfg/toolchains/ppc603e-bare.cmake)')
    if BOARD_ID not in content:
        raise Failure(f'{elf}: an image for another board, not {BOARD_ID.decode()}: build the board ppc603e')


def symbols(path):
    """The addresses of an image's or object's symbols by their last names."""
    try:
        said = subprocess.run(['powerpc-linux-gnu-nm', '-C', str(path)], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise Failure(f'{path}: its symbols cannot be read ({error}): build it first, and install the Debian package g++-powerpc-linux-gnu') from error
    words = (line.split(maxsplit=2) for line in said.splitlines())
    return {word[2].rsplit('::', 1)[-1]: int(word[0], 16) for word in words if len(word) == 3}


def code_bytes(elf):
    """That the board's scrub watches."""
    places = symbols(elf)
    return places['board_code_end'] - places['board_code_begin']


def machine(folder, processor='603e', options=''):
    """The command that starts it, but for what is on its card and in its memory."""
    reset = pathlib.Path(folder) / 'reset.bin'  # it wants some content for its read-only memory
    reset.write_bytes(bytes(64))
    return [QEMU, '-M', f'g3beige{options}', '-cpu', processor, '-m', '256', '-bios', str(reset), '-vga', 'none', '-net', 'none', '-display', 'none',
            '-serial', 'null', '-parallel', 'none', '-no-reboot']


class Emulator:
    """Running until the end of the with block. What the board's console says is kept, and said when something fails."""

    def __init__(self, elf, image, folder, rig=True, processor='603e', ticks_per_s=TICKS_PER_S, shared=False):
        require()
        check_image(elf)
        self.folder = pathlib.Path(folder)
        self.console_file = self.folder / 'console.txt'
        words = [STRAPS_MAGIC, ticks_per_s, 1 if rig else 0, 0]
        self.command = [*machine(self.folder, processor, ',memory-backend=ram' if shared else ''),
                        '-monitor', f'unix:{self.folder}/monitor.sock,server=on,wait=off', '-icount', f'shift={SHIFT},align=off,sleep=on']
        for name in ('camera', 'ground', 'rig'):
            self.command += ['-chardev', f'socket,id={name},path={self.folder}/{name}.sock' if rig else f'null,id={name}']
        self.command += ['-chardev', f'file,id=console,path={self.console_file}',
                         '-device', 'pci-serial-4x,chardev1=camera,chardev2=ground,chardev3=rig,chardev4=console',
                         '-device', f'loader,file={elf},cpu-num=0']
        if shared:  # memory as a file, whose content is that of fresh memory, and a debug port (ft/pil/seu_board.hpp)
            (self.folder / 'ram.bin').unlink(missing_ok=True)
            self.command += ['-object', f'memory-backend-file,id=ram,size=256M,mem-path={self.folder}/ram.bin,share=on', '-gdb', f'unix:{self.folder}/gdb.sock,server=on,wait=off']
        if image:
            self.command += ['-device', f'loader,file={image},addr={MISSION:#x},force-raw=on']
        for i in range(0, len(words), 2):  # eight bytes: of four the emulator would write the upper half
            self.command += ['-device', f'loader,addr={STRAPS + 4 * i:#x},data={words[i] << 32 | words[i + 1]:#x},data-len=8,data-be=on']

    def __enter__(self):
        self.console_file.write_text('')
        with open(self.folder / 'emulator.txt', 'w', encoding='utf-8') as log:
            self.process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
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
        self.process.kill()
        self.process.wait()

    def console(self):
        return self.console_file.read_text(encoding='utf-8', errors='replace')

    def said(self):
        """What the emulator and the console said, in a sentence."""
        text = (self.folder / 'emulator.txt').read_text(encoding='utf-8').strip()
        lines = self.console().strip().splitlines()
        return '; '.join(filter(None, [text, f'the console: {lines[-1]}' if lines else 'the console is silent']))

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


class Rig:
    """pil_rig with a board at its lines; nothing outlives the block, and nothing takes longer than `seconds`."""

    def __init__(self, program, arguments, seconds):
        self.process = subprocess.Popen([str(program), *map(str, arguments)], stdout=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL)
        self.late = False
        self.timer = threading.Timer(seconds, self.end)
        self.seconds = seconds

    def end(self):
        self.late = True
        self.process.send_signal(signal.SIGKILL)

    def __enter__(self):
        self.timer.start()
        return self

    def __exit__(self, *_):
        self.timer.cancel()
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()

    def await_ready(self):
        for line in self.process.stdout:
            if line.strip() == 'ready':
                return
        self.check(self.process.wait())

    def finish(self):
        """Exit code, and what it said."""
        said = self.process.stdout.read().strip()
        code = self.process.wait()
        self.check(0 if code == 1 else code)
        return code, said

    def check(self, code):
        if self.late:
            raise Failure(f'not done after {self.seconds} s: ended')
        if code != 0:
            raise Failure(f'the rig has ended with exit code {code}')


def fly(program, elf, arguments, folder, seconds, **board):
    """One run of the rig with an emulated board; exit code, words, console."""
    os.makedirs(folder, exist_ok=True)
    emulator = Emulator(elf, f'{folder}/image.3dli', folder, **board)
    with Rig(program, [*arguments, f'code={code_bytes(elf)}'], seconds) as rig:
        rig.await_ready()
        with emulator:
            code, said = rig.finish()
            return code, said, emulator
