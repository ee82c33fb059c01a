"""The report of a processor-in-the-loop run: one page, its flights side by side: the time of each stage against the frame, and figures."""
import html as text

from platform_limits import limit

NUMBERS = {'float': 'floating point', 'fixed': 'fixed point', 'cortexa9': 'floating point, Cortex-A9', 'in_sensor': 'floating point, the head beside it', 'in_sensor_cortexa9': 'floating point, Cortex-A9, the head beside it'}
STAGES = [('estimate', 'estimate'), ('boundary', 'boundary: publish, hand over, plan'), ('polls', 'polls of the camera, 19 slots'),
          ('largest_poll', 'the largest of them'), ('lines', 'interrupts of the lines, in no slot')]
WHOLE = ('whole', 'the whole frame, entries of interrupts and loops of the background, too')
IDLE_ASKED = limit('PLT-016', 'idle_share')  # in the median
COLOURS = {'estimate': '#3465a4', 'polls': '#73b66b', 'boundary': '#c17d11', 'lines': '#75507b'}
WIDTH, HEIGHT, LEFT, BOTTOM = 960, 320, 60, 30


def scale_y(instructions, most):
    return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - 20) * instructions / most


def bars(frames, most):
    """A bar for each frame, its stages one on the other."""
    step = (WIDTH - LEFT - 10) / len(frames)
    for n, frame in enumerate(frames):
        below = 0
        for stage, colour in COLOURS.items():
            top, base = scale_y(below + frame[stage], most), scale_y(below, most)
            yield f'<rect x="{LEFT + n * step:.2f}" y="{top:.2f}" width="{step:.2f}" height="{base - top:.2f}" fill="{colour}"/>'
            below += frame[stage]


def picture(frames, budget, mips, period_ms):
    lines = []
    for share in range(0, 6):
        y, ms = scale_y(budget * share / 5, budget), period_ms * share / 5
        lines.append(f'<line x1="{LEFT}" x2="{WIDTH - 10}" y1="{y:.1f}" y2="{y:.1f}" stroke="{"#c00" if share == 5 else "#ddd"}"/>'
                     f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{ms:.0f} ms</text>')
    legend = ''.join(f'<rect x="{LEFT + 225 * n}" y="{HEIGHT - 16}" width="12" height="12" fill="{colour}"/>'
                     f'<text x="{LEFT + 225 * n + 18}" y="{HEIGHT - 6}">{dict(STAGES)[stage]}</text>' for n, (stage, colour) in enumerate(COLOURS.items()))
    return (f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" xmlns="http://www.w3.org/2000/svg" font-family="sans-serif" font-size="11">{"".join(lines)}'
            f'{"".join(bars(frames, budget))}{legend}<text x="{WIDTH - 12}" y="14" text-anchor="end" fill="#c00">the frame: {period_ms} ms, {budget / 1e6:.0f} '
            f'million instructions at {mips} MIPS</text></svg>')


def verdict(r):
    return 'reached' if r['idle_share']['median'] >= IDLE_ASKED else 'missed'


def idle(r):
    share, without = r['idle_share'], r['idle_share_without_line_interrupts']
    return (f'{100 * share["median"]:.1f} % (median), {100 * share["worst"]:.1f} % at worst; without the line interrupts {100 * without["median"]:.1f} % and '
            f'{100 * without["worst"]:.1f} %; asked {100 * IDLE_ASKED:.0f} %: {verdict(r)}')


def rows(r):
    for stage, title in (*STAGES, WHOLE):
        i = r['instructions'][stage]
        yield f'{title}: instructions (median, 99 %, worst)', f'{i["median"]:,.0f}; {i["p99"]:,}; {i["worst"]:,}'
    for how in ('without', 'with'):
        latency = r[f'interrupt_latency_instructions_{how}_line_traffic']
        yield f'from a wake-up call’s time to its first instruction, {how} line traffic, worst of a frame', f'{latency["median"]:.0f} instructions (median), {latency["worst"]} at worst'
    yield 'processor idle', idle(r)
    yield 'margin of the fullest slot', f'{100 * r["slot_margin_share"]:.1f} %'
    yield 'margin of the fullest frame', f'{100 * r["frame_margin_share"]:.1f} %'
    for name, used in r['stack_bytes'].items():
        yield f'stack of the {name}: most that was used', f'{used:,} bytes; {r["stack_bound"]} {r["stack_bound_bytes"][name]:,} bytes, of 32,768'
    yield 'code and constants', f'{r["image_bytes"]:,} bytes'
    yield 'memory without mission images', f'{r["memory_bytes"]:,} bytes, of which the component {r["component_bytes"]:,}'
    yield 'lines', f'{r["lost_bytes"]} bytes lost, {r["packets_dropped"]} packets dropped, {r["services_cut"]} services cut short, {r["lines_masked"]} times masked'
    yield 'telemetry, target and host', text.escape(r['telemetry'].splitlines()[-1])
    yield 'run', text.escape(f'{r["frames"]} frames of {r["scenario"]}')


def table(results):
    heads = ''.join(f'<th>{NUMBERS[number]}</th>' for number in results)
    lines = zip(*(rows(r) for r in results.values()))
    return f'<table><tr><th></th>{heads}</tr>' + ''.join(
        f'<tr><td>{line[0][0]}</td>{"".join(f"<td>{value}</td>" for _, value in line)}</tr>' for line in lines) + '</table>'


def flown(numbers):
    said = '; '.join(NUMBERS[number] for number in numbers)
    return f'{said[0].upper()}{said[1:]}: on the PowerPC 603e where no other board is named, {"each beside its own host" if len(numbers) > 1 else "beside its host"}.'


def html(flights, budget, made):
    """`flights`: results and frames of each number type. `made`: by what, of what."""
    pictures = ''.join(f'<h2>{NUMBERS[number][0].upper()}{NUMBERS[number][1:]}</h2>{picture(frames, budget, r["mips"], r["period_ms"])}' for number, (r, frames) in flights.items())
    return (f'<!doctype html><meta charset="utf-8"><title>3DLASSO on bare boards</title><style>body{{font-family:sans-serif;max-width:{WIDTH}px;margin:2em auto}}'
            f'td,th{{padding:.2em 1em .2em 0;vertical-align:top;text-align:left}}td:first-child{{width:36%}}</style><h1>3DLASSO on bare boards</h1><p>{flown(flights)} Time of each stage in each frame, against the frame.</p>{pictures}<h2>Side by side</h2>'
            f'{table({number: r for number, (r, _) in flights.items()})}<p>Counts of instructions: the emulator knows neither caches nor a pipeline. {text.escape(made)}.</p>\n')
