"""Folders of mdat run and of mdat campaign run."""
import csv
import functools
import json
import pathlib

import numpy as np

from .errors import LassoError
from .packets import open_packets


class Folder:
    def __init__(self, path, needed):
        self.path = pathlib.Path(path)
        if not (self.path / needed).is_file():
            raise LassoError(f'{path}: has no {needed}; is it the folder that mdat wrote?')

    def json(self, name):
        return json.loads((self.path / name).read_text(encoding='utf-8'))


class Results(Folder):
    """A run: `summary` is results.json, `frames` frames.csv, `packets` telemetry.ccsds (docs/user-guide.md)."""

    def __init__(self, path):
        super().__init__(path, 'results.json')

    @functools.cached_property
    def summary(self):
        return self.json('results.json')

    @functools.cached_property
    def frames(self):
        return read_table(self.path / 'frames.csv')

    @functools.cached_property
    def packets(self):
        return open_packets(self.path / 'telemetry.ccsds')


class Campaign(Folder):
    """`summary` is summary.json, `cases` results.csv: a case's figures and what was drawn for it."""

    def __init__(self, path):
        super().__init__(path, 'results.csv')

    @functools.cached_property
    def summary(self):
        return self.json('summary.json')

    @functools.cached_property
    def cases(self):
        return read_table(self.path / 'results.csv')


def open_results(path):
    return Results(path)


def open_campaign(path):
    return Campaign(path)


def read_table(path):
    """A column of numbers is of float64, an empty cell in it NaN; any other column is of texts."""
    with open(path, newline='', encoding='utf-8') as file:
        rows = list(csv.reader(file))
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise LassoError(f'{path}: is no table: its rows differ in length, or there is none')
    columns = [column(cells) for cells in zip(*rows[1:])] if len(rows) > 1 else [np.zeros(0)] * len(rows[0])
    table = np.empty(len(rows) - 1, [(name, values.dtype) for name, values in zip(rows[0], columns)])
    for name, values in zip(rows[0], columns):
        table[name] = values
    return table


def column(cells):
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)
