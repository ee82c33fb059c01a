"""docs/hazards.md, made from reqs/hazards.yaml and reqs/fmea.yaml."""
import trace_hazards

PAGE = 'docs/hazards.md'
HEAD = '''# Hazards and failure modes

Written by `make write WHAT=hazards` from [reqs/hazards.yaml](../reqs/hazards.yaml) and [reqs/fmea.yaml](../reqs/fmea.yaml). **Self-assessed**: the project looked
itself, no outside body did. The component alone is looked at. Each hazard says what is left to the spacecraft.

`make requirements` checks that each control is an active requirement, and that each hazard and failure has one that a test or a gate exercises. `make trace`
checks that they pass. A catastrophic hazard has two such controls at least, each with a requirement of its own. Each requirement that is relevant to safety
([what that means](../reqs/README.md)) controls something here. Each [fault](faults.md) that the component answers is the detection of a failure here.

'''


def cell(text):
    return text.replace('|', '\\|')


def words(ids):
    return ', '.join(one.removeprefix('LASSO-') for one in ids)


def link(hazard_id):
    return f'[{hazard_id.removeprefix("LASSO-")}](#{hazard_id.lower()})'


def sentences(texts):
    return texts[0] if len(texts) == 1 else '\n'.join(f'- {text}' for text in texts)


def severities():
    yield '| severity | the worst that can follow, where the spacecraft does nothing against it |'
    yield '| --- | --- |'
    yield from (f'| {name} | {meaning} |' for name, meaning in trace_hazards.SEVERITIES.items())


def overview(hazards):
    yield '| hazard | severity | |'
    yield '| --- | --- | --- |'
    yield from (f'| {link(hazard.id)} | {hazard.severity} | {cell(hazard.title)} |' for hazard in hazards)


def section(hazard):
    yield f'### {hazard.id}\n\n**{hazard.title}** ({hazard.severity})\n'
    yield f'*Cause.* {hazard.cause}\n\n*Effect.* {hazard.effect}\n'
    yield '| control | shown by |\n| --- | --- |'
    yield from (f'| {cell(control.text)} | {words(control.by)} |' for control in hazard.controls)
    yield f'\n*What remains.*\n\n{sentences(hazard.remains)}\n\n*Left to the spacecraft.*\n\n{sentences(hazard.spacecraft)}\n'


def failures(safety):
    for part in trace_hazards.PARTS:
        rows = [row for row in safety.failures if row.part == part]
        if not rows:
            continue
        yield f'### {part.capitalize()}\n'
        yield '| | what fails, and how | effect | detection | severity | leads to | controls | what remains |\n| --- | --- | --- | --- | --- | --- | --- | --- |'
        for row in rows:
            faults = f' Faults: {", ".join(f"`{name}`" for name in row.faults)}.' if row.faults else ''
            cells = (row.id.removeprefix('LASSO-'), f'{row.item}: {row.failure}', row.effect, row.detection + faults, row.severity,
                     ', '.join(map(link, row.hazards)), words(row.controls), row.remains)
            yield '| ' + ' | '.join(map(cell, cells)) + ' |'
        yield ''


def text_of(safety):
    parts = [HEAD + '\n'.join(severities()), '\n## Hazards\n', '\n'.join(overview(safety.hazards)), '']
    parts += ['\n'.join(section(hazard)) for hazard in safety.hazards]
    parts += ['## Failure modes and effects\n\nRequirements are named without `LASSO-`; `out/trace/matrix.html` (`make trace`) has their texts and tests.\n', '\n'.join(failures(safety))]
    return '\n'.join(parts).rstrip() + '\n'


def check_page(safety, root):
    page = root / PAGE
    if safety.rows and (not page.is_file() or page.read_text(encoding='utf-8') != text_of(safety)):
        yield f'{PAGE}:1: not what reqs/hazards.yaml and reqs/fmea.yaml say: make write WHAT=hazards writes it'
