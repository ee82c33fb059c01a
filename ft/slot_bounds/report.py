"""The tables of docs/slot-times.md, and what is said of a loop without a bound."""
import bounds
import gate as gates
import loops
import stages

BEGIN, END = '<!-- tables of ft/slot_bounds -->', '<!-- end of the tables -->'
SHOWN = 10  # functions on a dearest way
HEAD = '| | any mission | this mission | measured worst |\n| --- | --- | --- | --- |'


def figure(number):
    if number is None:
        return ''
    if number < 100_000:
        return f'{number:,}'
    return f'{number / 1e6:.2f} million' if number < 1e8 else f'{number / 1e6:,.0f} million' if number < 1e12 else f'{number:.1e}'.replace('e+', 'e')


def brief(title):
    """A function's name without its arguments."""
    name = bounds.without_arguments(bounds.plain(title).split('(')[0])
    return name.split(' ')[-1].replace('lasso::', '').replace('{anonymous}::', '')


def stage_table(found, rows, results):
    by_title = {form: {stage.title: most for stage, _, _, most in found[form]} for form in found}
    lines = [HEAD]
    for stage in rows:
        if all(stage.title in by_title[form] for form in by_title):
            worst = stages.worst_measured(results, stage)
            lines.append(f'| {stage.title} | {figure(by_title["any"][stage.title])} | {figure(by_title["mission"][stage.title])} | {figure(worst)} |')
    return '\n'.join(lines)


def makeup_table(code, costs, first, bounded):
    rows, total = stages.shares(costs, first), costs.of(first).total
    lines = ['| function | calls | instructions of its own, all calls | share | its loops, most passes |', '| --- | --- | --- | --- | --- |']
    for key, times, own in rows[:SHOWN]:
        function = code.functions[key[0]]
        passes = passes_of(costs, function, key, bounded)
        lines.append(f'| `{brief(function.title)}` | {figure(times)} | {figure(own)} | {100 * own / total:.1f} % | {passes} |')
    return '\n'.join(lines)


def passes_of(costs, function, key, bounded):
    """Its longest loops, with their places in the sources where they are known."""
    found = [(costs.loop_totals[function.address, loop.header, key[1]], loop) for loop in loops.flat(costs.prepare(function)[0])
             if (function.address, loop.header, key[1]) in costs.loop_totals]
    texts = []
    for (runs, _, _), loop in sorted(found, key=lambda item: -item[0][2])[:3]:
        source, _ = bounded.where(function, loop)
        texts.append(f'{runs:,}' + (f' (`{bounded.brief(source.path).split("/")[-1]}:{source.first}`)' if source else ''))
    return ', '.join(texts)


def missing(bounded, function, loop):
    place = bounded.place(function, loop)
    source = place.inside if place.loop is None else place.loop
    where = f'{bounded.brief(source.path)}:{source.first}: {source.text}' if source else ' > '.join(f'{path}:{line}' for path, line in place.calls)
    return f'{brief(function.title)}: the loop at {loop.header:x} ({where or "no lines"}) has no bound: state it in bounds.toml'


def tables(code, found, results, bounded, commit):
    """Of the sources at that commit."""
    measured = ', '.join(f'`make {gates.command_of(name)}` at commit {of.get("measured", of)["commit"]}' for name, of in results.items() if of)
    parts = [f'Derived at commit {commit}, in instructions. Measured by {measured or "nothing"}.']
    parts += ['### Slots', stage_table(found, stages.SLOTS, results), '### Estimation', stage_table(found, stages.ESTIMATION, results)]
    for title in stages.SHOWN:
        _, first, costs, _ = next(row for row in found['mission'] if row[0].title.removeprefix('- ') == title)
        parts += [f'### What makes up {title}, this mission', makeup_table(code, costs, first, bounded)]
    return '\n\n'.join(parts)


def write(page, text):
    before, rest = page.read_text(encoding='utf-8').split(BEGIN)
    page.write_text(f'{before}{BEGIN}\n\n{text}\n\n{END}{rest.split(END)[1]}', encoding='utf-8')
