"""CCSDS packets of the component (docs/icd/link.md), by the dictionary that lies beside this file (make write WHAT=icd writes it)."""
import binascii
import collections
import functools
import json
import pathlib

import numpy as np

from .errors import LassoError

HEAD, LEAST, NUMBER_AT = 6, 22, 20  # bytes: the primary header; the shortest telemetry; where a packet's number stands
TYPES = {'u8': '>u1', 'u16': '>u2', 'u32': '>u4', 'i64': '>i8', 'f32': '>f4', 'f64': '>f8'}


@functools.lru_cache(None)
def dictionary():
    return json.loads((pathlib.Path(__file__).parent / 'dictionary.json').read_text(encoding='utf-8'))


def layout(row):
    """A packet's items where they are, and the time of its header, in units of 2^-24 s."""
    formats = [(TYPES[kind], (count,)) if count > 1 else TYPES[kind] for _, _, kind, count, *_ in row['items']]
    return np.dtype({'names': ['seconds', 'fraction', *(item[0] for item in row['items'])], 'formats': ['>u4', ('u1', (3,)), *formats],
                     'offsets': [13, 17, *(item[1] for item in row['items'])], 'itemsize': row['size']})


class Packets(collections.abc.Mapping):
    """By the names of the dictionary, an array with a row a packet: t_s of its header, and its items. Packets that are not in the dictionary, and bytes that
    belong to none, are counted (`unknown`, `skipped`). `apid` is the component's, where its host has given it another one."""

    def __init__(self, data, name='packets', apid=None):
        self.apid = dictionary()['apid'] if apid is None else apid
        self.name, self.unknown, self.skipped, self.found = name, 0, 0, collections.defaultdict(list)
        self.rows = {(row['service'], row['subservice'], row['number'], row['size']): row for row in dictionary()['packets']}
        self.arrays, at = {}, 0
        while at < len(data):
            size = self.size_at(data, at)
            self.take(data[at:at + size]) if size else None
            self.skipped += 0 if size else 1
            at += size or 1

    def size_at(self, data, at):
        """Of the whole packet there, with its right checksum; 0: there is none."""
        if len(data) - at < LEAST or data[at] >> 5 != 0 or (data[at] & 0x7) << 8 | data[at + 1] != self.apid:
            return 0
        size = HEAD + 1 + (data[at + 4] << 8 | data[at + 5])
        return size if at + size <= len(data) and binascii.crc_hqx(data[at:at + size], 0xFFFF) == 0 else 0

    def take(self, packet):
        number = packet[NUMBER_AT] << 8 | packet[NUMBER_AT + 1]
        row = self.rows.get((packet[7], packet[8], number, len(packet))) or self.rows.get((packet[7], packet[8], None, len(packet)))
        if row is None or packet[0] & 0x10:
            self.unknown += 1
        else:
            self.found[row['name']].append(packet)

    def __getitem__(self, name):
        if name not in self.found:
            raise LassoError(f'{self.name}: has no packet {name}; it has {", ".join(sorted(self.found)) or "none"}')
        if name not in self.arrays:
            row = next(row for row in dictionary()['packets'] if row['name'] == name)
            self.arrays[name] = native(np.frombuffer(b''.join(self.found[name]), layout(row)))
        return self.arrays[name]

    def __iter__(self):
        return iter(self.found)

    def __len__(self):
        return len(self.found)

    def words(self, name, item):
        """What the numbers of an item mean, as the dictionary names them."""
        row = next(row for row in dictionary()['packets'] if row['name'] == name)
        choices = next(found[4] for found in row['items'] if found[0] == item and len(found) > 4)
        names = {int(value): word for value, word in dictionary()['enumerations'][choices].items()}
        return np.array([names.get(int(value), str(value)) for value in self[name][item].ravel()]).reshape(self[name][item].shape)


def native(raw):
    """In this machine's order of bytes, with the header's time in seconds."""
    fraction = raw['fraction'].astype('f8') @ (256.0 ** -np.arange(1, 4))
    kinds = [(name, raw.dtype[name].base.newbyteorder('='), raw.dtype[name].shape) for name in raw.dtype.names[2:]]
    table = np.empty(len(raw), [('t_s', 'f8'), *kinds])
    table['t_s'] = raw['seconds'] + fraction
    for name in raw.dtype.names[2:]:
        table[name] = raw[name]
    return table


def open_packets(path, apid=None):
    data = pathlib.Path(path).read_bytes()
    packets = Packets(data, str(path), apid)
    if data and not packets.found:
        raise LassoError(f'{path}: holds no packet of APID {packets.apid} ({len(data)} bytes); is it telemetry?')
    return packets
