"""The emulated boards: what differs between them. All count instructions, one of which is 10 ns of the board's time."""
import dataclasses
import pathlib
import re
import subprocess

PORTS = ('camera', 'ground', 'rig', 'console')  # what is at the serial ports of an image
IN_SENSOR_PORTS = ('ground', 'camera', 'rig', 'console')  # of one with its head beside it: the camera's line leads to the ground, the other nowhere
SHIFT = 7  # an instruction is 2^7 ns of the emulator's time
MIPS = 100  # and 10 ns of the board's
ANY_ID = re.compile(rb'3dlasso board ([\w-]+)\0')


class Failure(Exception):
    """A reason for a person."""


@dataclasses.dataclass(frozen=True)
class Board:
    name: str  # folder of bsp, and of the tool chain's file
    model: str  # as the image says it
    suffix: str  # of its images: flight_SUFFIX.elf
    qemu: str
    packages: str  # list of cfg/packages
    cross: str  # prefix of the compiler's tools
    compiler: str  # Debian package
    processor: str  # of the emulator
    what: str  # it is, for people
    elf: bytes  # class and byte order, machine
    order: str  # of a word's bytes
    time_base_hz: int  # in the emulator's time
    ram: int  # where memory begins
    loaded: int  # where the memory for straps and mission begins

    @property
    def board_id(self):
        return b'3dlasso board ' + self.model.encode()

    @property
    def ticks_per_s(self):
        """Of the board's time."""
        return int(self.time_base_hz * (2 ** SHIFT) * MIPS / 1000)

    @property
    def ticks_per_instruction(self):
        return self.time_base_hz * 2 ** SHIFT / 1e9

    @property
    def straps(self):
        return self.loaded + 0x10000

    @property
    def mission(self):
        return self.loaded + 0x100000

    def image(self, folder, kind='flight'):
        return f'{folder}/{kind}_{self.suffix}.elf'

    def head(self, elf):
        """Where an image shares memory with its head (bsp/bare/own_head.cpp)."""
        return self.symbols(elf)['head_memory']

    def check_image(self, elf):
        """The image is for this board."""
        try:
            content = pathlib.Path(elf).read_bytes()
        except OSError as error:
            raise Failure(f'{elf}: {error.strerror}: build it first (make pil)') from error
        own = ANY_ID.search(content + b'\0')
        if own and own[1].decode() != self.model:
            raise Failure(f'{elf}: an image for another board, {own[1].decode()}, not {self.model}: build the board {self.name}')
        if content[:4] != b'\x7fELF' or content[4:6] + content[18:20] != self.elf:
            raise Failure(f'{elf}: not an image for a {self.what}: build the board {self.name} (cfg/toolchains/{self.name}-bare.cmake)')
        if self.board_id not in content:
            raise Failure(f'{elf}: an image for another board, not {self.board_id.decode()}: build the board {self.name}')

    def symbols(self, path):
        """The addresses of an image's or object's symbols by their last names."""
        try:
            said = subprocess.run([f'{self.cross}nm', '-C', str(path)], capture_output=True, text=True, check=True).stdout
        except (OSError, subprocess.CalledProcessError) as error:
            raise Failure(f'{path}: its symbols cannot be read ({error}): build it first, and install the Debian package {self.compiler}') from error
        words = (line.split(maxsplit=2) for line in said.splitlines())
        return {word[2].rsplit('::', 1)[-1]: int(word[0], 16) for word in words if len(word) == 3}

    def code_bytes(self, elf):
        """That the board's scrub watches."""
        places = self.symbols(elf)
        return places['board_code_end'] - places['board_code_begin']


class Ppc603e(Board):
    def machine(self, folder, processor=None, options=''):
        """The command that starts it, but for what is on its card and in its memory."""
        reset = pathlib.Path(folder) / 'reset.bin'  # it wants some content for its read-only memory
        reset.write_bytes(bytes(64))
        return [self.qemu, '-M', f'g3beige{options}', '-cpu', processor or self.processor, '-m', '256', '-bios', str(reset), '-vga', 'none', '-net', 'none',
                '-display', 'none', '-parallel', 'none', '-no-reboot']

    def ports(self, names, card=True):
        """What is at its serial ports, the last of which is the console; the console at the chip's own, too, for a board without its card."""
        at = ','.join(f'chardev{number}={name}' for number, name in enumerate(names, 1))
        return ['-serial', 'chardev:console', *(['-device', f'pci-serial-4x,{at}'] if card else [])]


class CortexA9(Board):
    def machine(self, folder, processor=None, options=''):
        return [self.qemu, '-M', f'vexpress-a9{options}', '-cpu', processor or self.processor, '-m', '256', '-net', 'none', '-display', 'none', '-parallel', 'none',
                '-audiodev', 'none,id=mute', '-global', 'pl041.audiodev=mute', '-no-reboot']

    def ports(self, names, _=True):
        return [word for name in names for word in ('-serial', f'chardev:{name}')]


PPC603E = Ppc603e('ppc603e', 'ppc603e-grackle', '603e', 'qemu-system-ppc', 'target', 'powerpc-linux-gnu-', 'g++-powerpc-linux-gnu', '603e', '32-bit PowerPC',
                  b'\x01\x02\x00\x14', 'big', 16600000, 0, 0x04000000)
CORTEXA9 = CortexA9('cortexa9', 'cortexa9-vexpress', 'cortexa9', 'qemu-system-arm', 'target-arm', 'arm-linux-gnueabihf-', 'g++-arm-linux-gnueabihf', 'cortex-a9',
                    '32-bit ARM', b'\x01\x01\x28\x00', 'little', 25000000, 0x60000000, 0x64000000)
