#!/usr/bin/env python3
"""seu.py HOST BOARD [FLIPS [SEED [NAME]]]: single bits flipped in the running board: code, image, parameters, mode, data, stack, registers (docs/pil.md).

HOST and BOARD are build folders. FLIPS (2000) flips, an eighth in each region, each in a flight of its own from a state of one flight; where and when depends
on SEED (1) and the flip's number. JOBS in the environment says how many boards fly beside each other (one a core). Leaves out/NAME (flips-target): flips.csv,
results.json, report.html, summary.json. Interrupted, it goes on where it was, if image and seed are the same.
Exit codes: 0 no wrong pose stayed untold for 10 s, of a flip in what is protected; 1 one was, or the board fails without a flip.
"""
import collections
import concurrent.futures
import csv
import hashlib
import html as text
import json
import os
import pathlib
import queue
import subprocess
import sys
import threading
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'cfg/quality'))
import gate as gates  # noqa: E402
import emulator  # noqa: E402
from progress import Progress  # noqa: E402
from boards import PPC603E  # noqa: E402

MISSION = 'cfg/missions/hubble_tenth.toml'
REGIONS = ('code', 'image', 'views', 'mode', 'vectors', 'data', 'stack', 'registers')
PROTECTED = REGIONS[:4]
OUTCOMES = {
    'masked': 'telemetry as without the flip, to the bit, and memory again, too',
    'latent': 'the same telemetry for 10 s; memory still differs',
    'harmless': 'other bytes; all poses valid and right; nothing told',
    'invalid': 'poses invalid or missing; no other word of it',
    'recovered': 'told, and poses valid at the end',
    'stopped': 'told, and no more poses: safe, or lost',
    'reset': 'the board restarted',
    'hang': 'no more word of the board for as long as 100 frames without a flip take, 20 s of the host at least: it hangs, or damaged code has made it restart nine times in a row',
    'told_wrong': 'a wrong pose as valid, and the flip reported within 10 s, or a reset',
    'silent_wrong': 'a wrong pose as valid, and not a word within 10 s of the flip: silent as in make flips WHERE=scrub',
}
# Of all outcomes, after their sum: flights with a wrong pose as valid, which are silent as in make flips WHERE=host, and those where it came before or with the word of the flip.
WRONG = {'wrong': 'a wrong pose as valid, whatever followed: silent as in make flips WHERE=host', 'wrong_first': 'of these, with a wrong pose no later than the frame in which the flip was told, if it was'}
COLUMNS = ('number', 'region', 'frame', 'slot', 'where', 'bit', 'instruction', 'outcome', 'told_after', 'wrong', 'invalid', 'frames', 'first_wrong')
SHORTEST_RUN = 50  # of numbers, each of which begins with the flight without a flip
WHOLE_FLIPS, MOST_FLIPS = 2000, 1_000_000  # LASSO-PLT-018
MOST_SEED = (1 << 63) - 1
# Of the host: without a word of the rig, which ends each flight within 20 minutes; for it to end by itself.
SILENT_S, END_S = 1800, 10


def without(begin, end, holes):
    """The ranges of [begin, end) that are in none of the holes."""
    for at, size in sorted(holes):
        yield begin, at - begin
        begin = at + size
    yield begin, end - begin


def places(elf, layout):
    """Regions of the board: name, address, bytes. The bytes of image and store are known when the image is compiled."""
    at, of = PPC603E.symbols(elf), PPC603E.symbols(layout)
    component, driver = at['component_memory'], at['driver_memory']
    mode = [(component + of['mode_at'], of['mode_bytes']), (component + of['parameters_at'], of['parameters_bytes']), (driver + of['laser_at'], of['laser_bytes'])]
    views = [(component + of['views_at'], of['views_bytes'])]
    stack = at['board_estimation_stack_end'] - at['board_estimation_stack_begin']
    ranges = {
        'code': [(at['board_code_begin'], at['board_code_end'] - at['board_code_begin'])], 'vectors': [(0, 0x1800)], 'image': [(at['board_image_buffer0'], 0)], 'store': [(at['board_store'], 0)],
        'views': views, 'mode': mode, 'data': list(without(at['board_estimation_stack_end'], at['board_bss_end'], views + mode)),
        'estimation_stack': [(at['board_estimation_stack_begin'], stack)],
        'acquisition_stack': [(at['board_acquisition_stack_begin'], at['board_acquisition_stack_end'] - at['board_acquisition_stack_begin'])],
        'lines': [(at['board_memory'], at['board_bss_end'] - at['board_memory'])],
        'clock': [(at['clock_memory'], at['driver_memory'] - at['clock_memory'])],  # and the flight's
        'all_data': [(at['board_estimation_stack_begin'], at['board_bss_end'] - at['board_estimation_stack_begin'])],
    }
    return ''.join(f'{name} {begin} {size}\n' for name, pieces in ranges.items() for begin, size in pieces)


def rows_of(path):
    with open(path, encoding='utf-8') as file:
        return list(csv.DictReader(file))


def campaign_of(seed, *files):
    """What a flip's outcome depends on: where one of these differs, the campaign is another."""
    return json.dumps({'seed': seed, 'columns': COLUMNS} | {pathlib.Path(path).name: hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() for path in files})


def resume(gate, campaign):
    """Numbers of the flips of the same campaign that are there. The table of another one is kept aside."""
    known, table = gate.out / 'campaign.json', gate.out / 'flips.csv'
    if known.exists() and table.exists():
        before = known.read_text(encoding='utf-8')
        if before == campaign:
            return {int(row['number']) for row in rows_of(table)}
        aside = gate.out / f'flips-{hashlib.sha256(before.encode()).hexdigest()[:8]}.csv'
        table.replace(aside)
        print(f'{table} was of another campaign (seed, board, rig or mission): kept as {aside.name}')
    known.write_text(campaign, encoding='utf-8')
    table.write_text(','.join(COLUMNS) + '\n', encoding='utf-8')
    return set()


def missing(done, flips, jobs):
    """Runs of numbers that are not done, enough of them for all jobs where they are long."""
    runs = []
    for number in sorted(set(range(flips)) - done):
        if runs and runs[-1].stop == number:
            runs[-1] = range(runs[-1].start, number + 1)
        else:
            runs.append(range(number, number + 1))
    while len(runs) < jobs and max(map(len, runs), default=0) >= 2 * SHORTEST_RUN:
        longest = max(runs, key=len)
        runs.remove(longest)
        runs += [longest[:len(longest) // 2], longest[len(longest) // 2:]]
    return runs


class Machines:
    """One emulator at a time, started anew whenever the rig wants one."""

    def __init__(self, elf, folder):
        self.elf, self.folder, self.now, self.started = elf, folder, None, 0

    def start(self):
        self.end()
        self.now = emulator.Emulator(self.elf, self.folder / 'image.3dli', self.folder, shared=True).__enter__()
        self.started += 1

    def end(self):
        if self.now is not None:
            self.now.__exit__()
        self.now = None


def lines_of(rig, seconds=SILENT_S):
    """What it says, line by line."""
    heard = queue.Queue()
    def listen():
        for line in rig.stdout:
            heard.put(line.strip())
        heard.put(None)
    threading.Thread(target=listen, daemon=True).start()
    while True:
        try:
            line = heard.get(timeout=seconds)
        except queue.Empty as error:
            raise emulator.Failure(f'pil_seu has said nothing for {seconds} s: ended; start again, it goes on where it was') from error
        if line is None:
            return
        yield line


def follow(rig, machines, table, progress):
    """Up to the rig's end: its wishes, its rows. What the last emulator has said."""
    for line in lines_of(rig):
        kind, _, rest = line.partition(' ')
        if kind == 'start':
            machines.start()
        elif kind == 'row':
            table.write(rest + '\n')  # one write, whole: others write rows as well
            progress.add()
        else:
            print(line, flush=True)
    try:
        rig.wait(END_S)
    except subprocess.TimeoutExpired as error:
        raise emulator.Failure(f'pil_seu has closed its output and does not end: ended after {END_S} s') from error
    return machines.now.said() if machines.now else 'no emulator'


def fly(gate, host, elf, seed, run, progress):
    """One rig, and an emulator in a folder of its own, for a run of numbers. How many emulators it took."""
    folder = gate.out / f'from{run.start}'
    folder.mkdir(parents=True, exist_ok=True)
    machines = Machines(elf, folder)
    command = [f'{host}/ft/pil/pil_seu', MISSION, folder, gate.out / 'places.txt', len(run), seed, run.start]
    rig = emulator.CHILDREN.start([str(word) for word in command], stdout=subprocess.PIPE, text=True)
    try:
        with open(gate.out / 'flips.csv', 'a', encoding='utf-8', buffering=1) as table:
            said = follow(rig, machines, table, progress)
    finally:
        emulator.CHILDREN.end(rig)
        machines.end()
        (folder / 'ram.bin').unlink(missing_ok=True)
    if rig.returncode != 0:
        raise emulator.Failure(f'the board has failed without a flip, or cannot be put back: {said}: see above')
    return machines.started


def fly_all(gate, host, elf, flips, seed):
    """Beside each other, as many as JOBS says. How many emulators it took; the first failure ends all."""
    done, jobs = resume(gate, campaign_of(seed, elf, f'{host}/ft/pil/pil_seu', gates.TOP / MISSION)), int(os.environ.get('JOBS') or os.cpu_count())
    runs = missing(done, flips, jobs)
    progress = Progress('flips', flips, 'flips', flips - sum(map(len, runs)))
    with concurrent.futures.ThreadPoolExecutor(jobs, initializer=emulator.leave_endings_to_main) as pool:
        flights = [pool.submit(fly, gate, host, elf, seed, run, progress) for run in runs]
        try:
            return sum(flight.result() for flight in concurrent.futures.as_completed(flights))
        except Exception:
            emulator.CHILDREN.end_all()
            raise


def count(rows):
    return {region: collections.Counter(row['outcome'] for row in rows if row['region'] == region) for region in REGIONS}


def wrong(rows, regions):
    """How many flights with a wrong pose as valid, and with one before or with the word of the flip."""
    bad = [row for row in rows if row['region'] in regions and int(row['wrong']) > 0]
    return len(bad), sum(int(row['told_after']) == 0 or int(row['first_wrong']) <= int(row['told_after']) for row in bad)


def told_frames(rows, region):
    """Median and longest, in seconds, of the flips that were told."""
    frames = sorted(int(row['told_after']) for row in rows if row['region'] == region and int(row['told_after']) > 0)
    return f'{frames[len(frames) // 2] * 0.2:.1f} s, {frames[-1] * 0.2:.1f} s' if frames else ''


def table_of(rows):
    counts = count(rows)
    yield ['flipped bits in', *OUTCOMES, 'all', *WRONG, 'told after (median, longest)']
    for region in REGIONS:
        yield [region, *(counts[region][outcome] for outcome in OUTCOMES), sum(counts[region].values()), *wrong(rows, [region]), told_frames(rows, region)]
    yield ['all', *(sum(counts[region][outcome] for region in REGIONS) for outcome in OUTCOMES), len(rows), *wrong(rows, REGIONS), '']


def page(rows, results):
    lines = ''.join('<tr>' + ''.join(f'<td>{text.escape(str(word))}</td>' for word in line) + '</tr>' for line in table_of(rows))
    meanings = ''.join(f'<tr><td>{name}</td><td>{meaning}</td></tr>' for name, meaning in (OUTCOMES | WRONG).items())
    return ('<!doctype html><meta charset="utf-8"><title>Flips on the PowerPC 603e</title><style>body{font-family:sans-serif;max-width:1100px;margin:2em auto}'
            'td{padding:.2em 1em .2em 0;vertical-align:top}tr:first-child{font-weight:bold}</style><h1>Flips on the PowerPC 603e</h1>'
            f'<p>{results["flips"]} bits flipped in the running board, seed {results["seed"]}, {results["emulator"]}, {results["commit"]}. Protected: {", ".join(PROTECTED)}.</p>'
            f'<table>{lines}</table><h2>Outcomes</h2><table><tr><td>outcome</td><td>meaning</td></tr>{meanings}</table>\n')


def judge(gate, rows):
    numbers = [int(row['number']) for row in rows]
    if numbers != list(range(len(rows))):
        gate.find(f'the flips are not numbered from 0 to {len(rows) - 1}: remove {gate.out}/flips.csv and start anew')
    if not any(row['region'] in PROTECTED and int(row['told_after']) > 0 for row in rows):
        gate.find('no flip in protected memory was told: is anything flipped, or is the scrub off?')
    for row in rows:
        if row['outcome'] not in OUTCOMES or row['region'] not in REGIONS:
            gate.find(f'flip {row["number"]}: outcome {row["outcome"]} in {row["region"]} is none of those known: mend ft/pil/seu.py')
        if row['outcome'] == 'silent_wrong' and row['region'] in PROTECTED:
            gate.find(f'flip {row["number"]}: bit {row["bit"]} of {row["where"]} ({row["region"]}) in frame {row["frame"]}, slot {row["slot"]}: a wrong pose was published and nothing told')


def missed(rows):
    """In what is protected, and not a word of it."""
    quiet = ('masked', 'latent', 'harmless', 'invalid', 'silent_wrong')
    return sum(row['region'] in PROTECTED and row['outcome'] in quiet for row in rows)


def conclude(gate, rows, seed, version, seconds, started):
    results = {'flips': len(rows), 'seed': seed, 'emulator': f'QEMU {version}', 'commit': gates.commit(), 'seconds': round(seconds), 'emulators': started,
               'protected': PROTECTED, 'wrong': dict(zip(WRONG, wrong(rows, REGIONS))), 'regions': {region: dict(counts) for region, counts in count(rows).items()}}
    (gate.out / 'results.json').write_text(json.dumps(results, indent=1) + '\n', encoding='utf-8')
    (gate.out / 'report.html').write_text(page(rows, results), encoding='utf-8')
    for line in table_of(rows):
        print(' '.join(f'{word!s:>12}' for word in line))
    judge(gate, rows)
    counts = count(rows)
    gate.figure('flips', len(rows))
    gate.figure('silent wrong in protected memory', sum(counts[region]['silent_wrong'] for region in PROTECTED))
    gate.figure('not told in protected memory', missed(rows))
    gate.figure('with a wrong pose in protected memory, whatever followed', wrong(rows, PROTECTED)[0])
    gate.figure('silent wrong elsewhere', sum(counts[region]['silent_wrong'] for region in REGIONS if region not in PROTECTED))


def main(host, board, flips=str(WHOLE_FLIPS), seed='1', name='flips-target'):
    emulator.end_with_children()
    with gates.Gate(name) as gate:
        flips = gate.number('FLIPS', flips, MOST_FLIPS, WHOLE_FLIPS if name == 'flips-target' else None)
        seed = gate.number('SEED', seed, MOST_SEED)
        elf, begun = f'{board}/flight_603e.elf', time.monotonic()
        try:
            version = emulator.require()
            PPC603E.check_image(elf)
            (gate.out / 'places.txt').write_text(places(elf, f'{board}/bsp/ppc603e/CMakeFiles/layout_603e.dir/__/__/ft/pil/layout.cpp.obj'), encoding='utf-8')
            started = fly_all(gate, host, elf, flips, seed)
        except emulator.Failure as failure:
            gate.stop(str(failure))
        rows = sorted(rows_of(gate.out / 'flips.csv'), key=lambda row: int(row['number']))[:flips]
        if len(rows) != flips:
            gate.find(f'{len(rows)} flips of {flips} have an outcome: start again, it goes on where it was')
        conclude(gate, rows, seed, version, time.monotonic() - begun, started)


if __name__ == '__main__':
    if {'-h', '--help'} & set(sys.argv) or not 3 <= len(sys.argv) <= 6:
        print(__doc__)
        sys.exit(0 if {'-h', '--help'} & set(sys.argv) else 2)
    main(*sys.argv[1:])
