"""The store's story over three starts of a board, by its ground's line (ft/pil/store_story.hpp): what has to be true of what it tells."""
import re

import flight
import run

COMMANDED, SAVED, RESET = 1, 33, 35  # cause of a restart; events of docs/icd/link.md


def read_store(said):
    """What telemetry says of the store, of each start."""
    return [dict(re.findall(r'(\S+)=(\S*)', line)) for line in said.splitlines() if line.startswith('store:')]


def judge_store(said, starts, told, console):
    """Each thing that has to be, with what it is."""
    first, second, third = read_store(said)
    log = second['log'].split(',')
    yield 'a reset by the ground is told as commanded', [start['cause'] for start in starts] == [0, COMMANDED, COMMANDED] and [words[1] for words in told] == ['0', str(COMMANDED), str(COMMANDED)]
    yield 'no frame in mode safe, none refused', {start['safe'] for start in (first, second, third)} == {'0'} and said.count(', 0 refused') == 3
    yield 'the loaded image goes to the store', first['image.active_stored'] == '1'
    yield 'a restart in the middle of a load leaves the old image', first['image.loaded'] == '12' and second['first'] == first['image.active_crc']
    yield 'a saved parameter is restored', (second['parameter.value'], second['parameter.changed']) == ('17', '1')
    yield 'the log has the events of the start before', second['log_start'] == '1' and {str(SAVED), str(RESET)} <= set(log)
    yield 'a damaged word is found and repaired', (second['image.findings'], second['image.repairs']) == ('1', '1') and 'damaged word: repaired' in said
    yield 'an image that was loaded becomes active', second['image.active_crc'] not in ('0', first['image.active_crc'])
    yield 'and is the one of the next start', third['first'] == second['image.active_crc']
    yield 'the image before comes back by command', (third['image.active_crc'], third['image.roll_backs']) == (first['image.active_crc'], '1')
    yield 'the console says where the image comes from', re.findall(r'the image (as loaded|of the store)', console) == ['as loaded', 'of the store', 'of the store']


def check_store(gate, host, elf, board, *more, **options):
    """Over the ground's line: two commanded restarts, not into safe mode, and what outlives them."""
    print(f'the store, over two restarts, {board.name}')
    buffer, folder = board.symbols(elf)['board_image_buffer0'], f'store-{board.name}'
    code, said, machine = flight.fly(gate, host, elf, folder, f'store={buffer}', f'memory={board.ram}', *more, frames=0, shared=True, board=board, **options)
    told, starts = flight.TELEMETRY.findall(said), run.read_reports(gate.out / folder / 'starts.csv') if code == 0 else []
    (gate.out / folder / 'ram.bin').unlink(missing_ok=True)
    if len(starts) != 3 or len(told) != 3 or len(read_store(said)) != 3:
        gate.stop(f'the store, {board.name}: {len(starts)} starts of the board, 3 expected: {said} ({machine.said()})')
    for what, right in judge_store(said, starts, told, machine.console()):
        print(f'  {what:56s} {"yes" if right else "no"}')
        if not right:
            gate.find(f'the store, {board.name}: {what}: not so: {said}')
    return told
