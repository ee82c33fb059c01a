#!/usr/bin/env python3
"""run.py HOST BOARD FIXED_HOST FIXED_BOARD CORTEXA9 [FRAMES [FLIGHT]]: the component on the emulated boards, with the simulated camera and the ground at its lines (docs/pil.md).

All are build folders: of the PowerPC 603e and its host, of both in fixed point, and of the Cortex-A9. FLIGHT in_sensor flies the image with its head beside it
instead, on the 603e alone (docs/in-sensor.md), for which the first two folders are enough. Flies FRAMES frames (360) on each host and board, at a time, compares
the telemetry bit by bit, and leaves instructions, margins and stacks in out/pil (of in_sensor in out/pil-in_sensor): results.json, report.html, summary.json, which says that fewer frames
are a sample. Exit codes: 0 the
same bits, within the limits; 1 not; 2 usage.
"""
import concurrent.futures
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'cfg/quality'))
import gate as gates  # noqa: E402
import emulator  # noqa: E402
import page  # noqa: E402
from boards import CORTEXA9, MIPS, PPC603E  # noqa: E402
from platform_limits import limit  # noqa: E402
from progress import Progress  # noqa: E402

WHOLE_FRAMES, MOST_FRAMES = 360, 100_000  # LASSO-PLT-014
MISSION, SCENARIO, SLOTS, PERIOD_MS = 'cfg/missions/hubble_tenth.toml', 'spin', 20, 200
# Of each flight: its number type and board; where make prove leaves the bounds of its stacks, where it does.
FOLDERS = {'': 'pil', 'in_sensor': 'pil-in_sensor'}  # of FLIGHT: whose results do not take the others' place
FLIGHTS = 'float', 'fixed', 'cortexa9'  # of a run; in_sensor is one by itself, on the second board in samples alone
IN_SENSOR = 'in_sensor', 'in_sensor_cortexa9'
NUMBERS = {'float': 'float', 'fixed': 'fixed', 'cortexa9': 'float', 'in_sensor': 'float', 'in_sensor_cortexa9': 'float'}
BOARDS = {'float': PPC603E, 'fixed': PPC603E, 'cortexa9': CORTEXA9, 'in_sensor': PPC603E, 'in_sensor_cortexa9': CORTEXA9}
PROOFS = {'float': 'prove', 'fixed': 'fixed-point/prove', 'in_sensor': 'prove'}  # of both images: drivers are held to what their interface counts
PIPELINE_FRAMES = 2  # of the rig's
IDLE_HELD = 'float', 'in_sensor'  # LASSO-PLT-016: fixed point is for a processor without a floating-point unit (docs/pil.md)
VALID = re.compile(r'\d+ poses, (\d+) valid')
FRAME_INSTRUCTIONS = PERIOD_MS * 1000 * MIPS
# Of an estimate's instructions, in fixed point half a frame.
ESTIMATE = {'float': limit('PLT-002', 'silhouettes'), 'fixed': 10_000_000}


def read_reports(path):
    with open(path, encoding='utf-8') as file:
        return [{name: int(word) for name, word in row.items()} for row in csv.DictReader(file)]


def frames_of(slots, board):
    """Instructions of each whole frame, by stage. The estimate of a frame is the one that ended in it."""
    def instructions(ticks):
        return round(ticks / board.ticks_per_instruction)
    frames = []
    for first in range(0, len(slots) - SLOTS + 1, SLOTS):
        rows = slots[first:first + SLOTS]
        polls = [instructions(row['slot_ticks']) for row in rows[1:]]
        frames.append({'boundary': instructions(rows[0]['slot_ticks']), 'polls': sum(polls), 'largest_poll': max(polls),
                       'estimate': sum(instructions(row['estimate_ticks']) for row in rows),
                       'idle': sum(instructions(row['idle_ticks']) for row in rows),
                       'lines': sum(instructions(row['line_ticks']) for row in rows),
                       'late': max(instructions(row['late_ticks']) for row in rows),
                       'late_busy': max(instructions(row['busy_late_ticks']) for row in rows)})
    return frames


def spread(values):
    values = sorted(values)
    return {'median': statistics.median(values), 'p99': values[int(0.99 * (len(values) - 1))], 'worst': values[-1]}


def sizes(gate, elf, board):
    """Bytes of code and constants, and of memory for the component, its stacks included, without mission images."""
    total = {}
    for line in gate.run(f'{board.cross}size', '-A', elf).splitlines():
        words = line.split()
        if len(words) == 3 and words[0].startswith('.'):
            total[words[0]] = int(words[1])
    image = sum(total.get(name, 0) for name in ('.vectors', '.text', '.rodata', '.init_array', '.board_id', '.data'))
    memory = sum(total.get(name, 0) for name in ('.estimation_stack', '.kept', '.head', '.data', '.bss', '.acquisition_stack'))
    return image, memory


def stacks(slots):
    """Most bytes of each stack that were used."""
    return {'estimation': max(row['estimate_stack'] for row in slots), 'acquisition': max(row['acquire_stack'] for row in slots)}


def stack_bounds(gate, number, elf):
    """The proven bounds of the same stacks, for the same code by the same compiler; where there is no proof, half of what the stacks have."""
    if number not in PROOFS:
        places = BOARDS[number].symbols(elf)
        return {name: (places[f'board_{name}_stack_end'] - places[f'board_{name}_stack_begin']) // 2 for name in ('estimation', 'acquisition')}
    path = gates.OUT / PROOFS[number] / 'results.json'
    try:
        return json.loads(path.read_text(encoding='utf-8'))['board_stack_bytes']
    except (OSError, ValueError, KeyError) as error:
        return gate.stop(f'{path}: {error}: the stacks have no proven bounds: make prove')


def bound_name(number):
    return 'proven' if number in PROOFS else 'allowed'


def judge_stacks(gate, number, used, bounds):
    for name, bytes_used in used.items():
        if not 0 < bytes_used <= bounds[name]:
            remedy = 'the proof is wrong, or of other code' if number in PROOFS else 'twice that has to be there: a call is deeper than it was'
            gate.find(f'{number}: stack of the {name}: {bytes_used} bytes used, at most {bounds[name]} {bound_name(number)}: {remedy}')
        gate.figure(f'{number}: bytes of stack used, {name} ({bound_name(number)})', f'{bytes_used} ({bounds[name]})')


def check_number(gate, number, elf):
    """The image is of this number type: two flights of one would say nothing of the other."""
    board, number = BOARDS[number], NUMBERS[number]
    board.check_image(elf)
    if ('FixedNumber' in gate.run(f'{board.cross}nm', '-C', elf)) != (number == 'fixed'):
        gate.stop(f'{elf}: not an image of the number type {number}: configure with -DLASSO_NUMBER={number}')


def judge_sizes(gate, number, image, memory):
    for what, value, most in (('code and constants', image, limit('PLT-015', 'code_and_constants')), ('memory without mission images', memory, limit('PLT-015', 'memory'))):
        if value > most:
            gate.find(f'{number}: {what}: {value} bytes, at most {most} allowed')


def measure(gate, number, elf, slots):
    frames = frames_of(slots, BOARDS[number])
    flown = [frame for frame in frames if frame['estimate'] > 0]
    if not flown:
        gate.stop(f'{number}: no estimate has ended on the board')
    # Once the first estimate has ended each frame has one.
    gaps = sum(frame['estimate'] == 0 for frame in frames[frames.index(flown[0]):])
    image, memory = sizes(gate, elf, BOARDS[number])
    # The processor rests where its clock skips to the next slot: all else, entries of interrupts and the background's loop among it, is work.
    # The clock stands still while the bytes of the lines move: their interrupts are in no slot, and are counted apart.
    for frame in flown:
        frame['whole'] = FRAME_INSTRUCTIONS - frame['idle'] + frame['lines']
    idle = [frame['idle'] / FRAME_INSTRUCTIONS for frame in flown]
    with_lines = [1 - frame['whole'] / FRAME_INSTRUCTIONS for frame in flown]
    return {
        'frames': len(frames), 'frames_without_estimate': gaps, 'mips': MIPS, 'period_ms': PERIOD_MS,
        'instructions': {stage: spread([frame[stage] for frame in flown]) for stage in (*(stage for stage, _ in page.STAGES), 'whole')},
        'interrupt_latency_instructions_without_line_traffic': spread([frame['late'] for frame in flown]),
        'interrupt_latency_instructions_with_line_traffic': spread([frame['late_busy'] for frame in flown]),
        'idle_share_without_line_interrupts': {'median': statistics.median(idle), 'worst': min(idle)},
        'idle_share': {'median': statistics.median(with_lines), 'worst': min(with_lines), 'asked': page.IDLE_ASKED},
        'slot_margin_share': 1 - max(max(frame['boundary'], frame['largest_poll']) for frame in flown) / (FRAME_INSTRUCTIONS / SLOTS),
        'frame_margin_share': min(with_lines),
        'stack_bytes': stacks(slots), 'stack_bound': bound_name(number), 'stack_bound_bytes': stack_bounds(gate, number, elf),
        'image_bytes': image, 'memory_bytes': memory, 'component_bytes': slots[0]['memory'], 'lost_bytes': slots[-1]['lost_bytes'],
        'services_cut': slots[-1]['services_cut'], 'lines_masked': slots[-1]['lines_masked'], 'packets_dropped': slots[-1]['packets_dropped'],
    }, flown


def judge(gate, number, r):
    checks = [('median of an estimate, instructions', r['instructions']['estimate']['median'], ESTIMATE[NUMBERS[number]]),
              ('bytes lost on the lines', r['lost_bytes'], 0),
              ('times that the lines were masked', r['lines_masked'], 0),
              ('packets of telemetry dropped', r['packets_dropped'], 0),
              ('frames without an estimate, once the first has ended', r['frames_without_estimate'], 0),
              ('frames without a valid pose', r['frames_asked'] - r['valid_poses'], 0),
              ('frames whose latency with line traffic was not measured', r['frames'] if r['interrupt_latency_instructions_with_line_traffic']['median'] == 0 else 0, 0)]
    if number in IDLE_HELD:
        checks.append(('share of time that the processor works (median)', 1 - r['idle_share']['median'], 1 - page.IDLE_ASKED))
    for what, value, most in checks:
        if value > most:
            gate.find(f'{number}: {what}: {value}, at most {most} allowed')
    judge_sizes(gate, number, r['image_bytes'], r['memory_bytes'])
    judge_stacks(gate, number, r['stack_bytes'], r['stack_bound_bytes'])


def million(value):
    return f'{value / 1e6:.2f}'


def tell(gate, number, r):
    i = r['instructions']
    print(f'{page.NUMBERS[number]}: {r["telemetry"]}')
    print(f'instructions in a frame of {PERIOD_MS} ms at {MIPS} MIPS ({FRAME_INSTRUCTIONS / 1e6:.0f} million), millions: median, 99 %, worst')
    for stage, title in (*page.STAGES, page.WHOLE):
        print(f'  {title:36s} {million(i[stage]["median"])} {million(i[stage]["p99"])} {million(i[stage]["worst"])}')
    print(f'processor idle: {page.idle(r)}')
    figures = {
        'frames': r['frames'],
        'million instructions an estimate (median, worst)': f'{million(i["estimate"]["median"])} {million(i["estimate"]["worst"])}',
        f'% idle (median, worst, asked by LASSO-PLT-016): {page.verdict(r)}':
            f'{100 * r["idle_share"]["median"]:.1f} {100 * r["idle_share"]["worst"]:.1f} {100 * page.IDLE_ASKED:.0f}',
        '% idle without line interrupts (median)': f'{100 * r["idle_share_without_line_interrupts"]["median"]:.1f}',
        '% of the fullest slot free': f'{100 * r["slot_margin_share"]:.0f}',
        'instructions of interrupt latency at worst, without line traffic and with it':
            ' '.join(str(r[f'interrupt_latency_instructions_{how}_line_traffic']['worst']) for how in ('without', 'with')),
        'kB of code and constants': round(r['image_bytes'] / 1024),
        'MB of memory': f'{r["memory_bytes"] / (1 << 20):.2f}',
    }
    for label, text in figures.items():
        gate.figure(f'{number}: {label}', text)


def results_of(gate, number, elf, out, said, frames):
    """What was measured in a flight, and its frames."""
    results, flown = measure(gate, number, elf, read_reports(out / 'slots.csv'))
    return results | {'scenario': SCENARIO, 'telemetry': said, 'frames_asked': frames, 'valid_poses': int(VALID.search(said)[1])}, flown


def kind_of(number):
    return 'in_sensor' if number in IN_SENSOR else 'flight'


def fly(gate, number, host, board, frames, progress):
    """One flight on the host and on the board."""
    elf, out = BOARDS[number].image(board, kind_of(number)), gate.out / number
    check_number(gate, number, elf)
    code, said, machine = emulator.fly(f'{host}/ft/pil/pil_rig', elf, [MISSION, SCENARIO, frames, out], out, emulator.seconds_for(frames), BOARDS[number], progress=progress, in_sensor=number in IN_SENSOR)
    if code != 0:
        gate.stop(f'{number}: {said or "the board failed"} ({machine.said()})')
    return results_of(gate, number, elf, out, said, frames)


def fly_all(gate, flights, frames):
    """One beside the other, with one progress: a line of each would overwrite the others'. The first that fails ends all."""
    flown = sum(3 if number in IN_SENSOR else 2 for number in flights)  # that one's host flies with a camera at its line, too
    progress = Progress('fly', flown * (frames + PIPELINE_FRAMES), 'frames on hosts and boards')
    with concurrent.futures.ThreadPoolExecutor(initializer=emulator.leave_endings_to_main) as pool:
        jobs = {number: pool.submit(fly, gate, number, *folders, frames, progress) for number, folders in flights.items()}
        try:
            for job in concurrent.futures.as_completed(jobs.values()):
                job.result()
        except Exception:
            emulator.CHILDREN.end_all()
            raise
        return {number: job.result() for number, job in jobs.items()}


def flights_of(flight, host, board, fixed_host, fixed_board, cortexa9):
    """Folders of host and board."""
    if flight == 'in_sensor':
        return {'in_sensor': (host, board)}
    return dict(zip(FLIGHTS, ((host, board), (fixed_host, fixed_board), (host, cortexa9))))


def usage(why):
    print(f'pil: {why}', file=sys.stderr)
    return 2


def main(host, board, fixed_host, fixed_board, cortexa9, frames=str(WHOLE_FRAMES), flight=''):
    if flight not in FOLDERS:
        sys.exit(usage(f'FLIGHT={flight}: no such flight: in_sensor, or none'))
    emulator.end_with_children()
    with gates.Gate(FOLDERS[flight]) as gate:
        frames = gate.number('FRAMES', frames, MOST_FRAMES, WHOLE_FRAMES)
        try:
            asked = flights_of(flight, host, board, fixed_host, fixed_board, cortexa9)
            version = ' and '.join(dict.fromkeys(emulator.require(BOARDS[number]) for number in asked))
            flights = fly_all(gate, asked, frames)
        except emulator.Failure as failure:
            gate.stop(str(failure))
        results = {'emulator': f'QEMU {version}', 'commit': gates.commit()} | {number: r for number, (r, _) in flights.items()}
        (gate.out / 'results.json').write_text(json.dumps(results, indent=1) + '\n', encoding='utf-8')
        (gate.out / 'report.html').write_text(page.html(flights, FRAME_INSTRUCTIONS, f'QEMU {version}, {gates.commit()}'), encoding='utf-8')
        for number, (r, _) in flights.items():
            tell(gate, number, r)
            judge(gate, number, r)


if __name__ == '__main__':
    if {'-h', '--help'} & set(sys.argv) or not 6 <= len(sys.argv) <= 8:
        print(__doc__)
        sys.exit(0 if {'-h', '--help'} & set(sys.argv) else 2)
    main(*sys.argv[1:])
