"""What the gates left: out/GATE/summary.json (cfg/quality/gate.py), and what it says of the items that rest on it."""
import json
import os

from gate import command_of

NOT_RUN, SAMPLE, SHORT, UNCHANGED = 'not run', 'a sample', 'short form', 'unchanged'


def read_summary(out, gate):
    """The summary of a gate; None where the gate has not run. ValueError, with place and remedy: the file is not one."""
    path = out / gate / 'summary.json'
    if not path.exists():
        return None
    place = os.path.relpath(path)
    try:
        summary = json.loads(path.read_text(encoding='utf-8'))
    except (ValueError, OSError) as error:
        raise ValueError(f'{place}:{getattr(error, "lineno", 1)}: not readable ({error}): run make {command_of(gate)} again') from error
    good = isinstance(summary, dict) and isinstance(summary.get('passed'), bool) and isinstance(summary.get('figures'), dict)
    if not good or summary.get('gate') != gate:
        raise ValueError(f'{place}:1: not the summary of gate {gate} ("gate", "passed", "figures"): run make {command_of(gate)} again')
    return summary


def result_of(out, gate):
    """passed, failed, not run, or passed less than whole: a sample, with fewer cases than are asked for; in the short form of a landing; or not run
    at a landing, as its inputs are unchanged since a commit at which it passed (cfg/quality/verified.toml)."""
    summary = read_summary(out, gate)
    if summary is None:
        return NOT_RUN
    if not summary['passed']:
        return 'failed'
    return SAMPLE if summary.get('sample') else UNCHANGED if summary.get('as_of') else SHORT if summary.get('form') == 'landing' else 'passed'


def check_gates(items, out, complete=False):
    """Results of the gates that items name, and the problems: a gate that failed speaks against the items that rest on it; one that has not
    run, or not whole, speaks against a complete check."""
    results, problems = {}, []
    for item in items:
        if not item.gate:
            continue
        if item.gate == 'trace':
            problems.append(f'{item.at("gate")}: {item.id} cannot rest on this check itself: name other evidence')
            continue
        try:
            results.setdefault(item.gate, result_of(out, item.gate))
        except ValueError as error:
            problems.append(str(error))
            results[item.gate] = 'failed'
        if item.active and results[item.gate] == 'failed':
            problems.append(f'{item.at("gate")}: {item.id} rests on make {command_of(item.gate)}, which failed: correct the cause and run it again')
        if item.active and results[item.gate] == SAMPLE and complete:
            problems.append(f'{item.at("gate")}: {item.id} rests on make {command_of(item.gate)}, which has run as a sample: run it whole')
        if item.active and results[item.gate] == NOT_RUN and complete:
            problems.append(f'{item.at("gate")}: {item.id} rests on make {command_of(item.gate)}, which has not run: run it before')
        if item.active and results[item.gate] in (SHORT, UNCHANGED) and complete:
            problems.append(f'{item.at("gate")}: {item.id} rests on make {command_of(item.gate)}, of which only this is known: {results[item.gate]}; run it whole')
    return results, list(dict.fromkeys(problems))
