"""Messages of ROS 2: their definitions (ros2msg), and their bytes (CDR, XCDR1) as Python values.

A time is an integer of nanoseconds. A structure of float64 alone (point, vector, quaternion) is an array of its numbers, in their order; an array of numbers
is an array; any other structure is a dict.
"""
import re
import struct

import numpy as np

from .errors import LassoError

NUMBERS = {'bool': '?', 'byte': 'u1', 'char': 'u1', 'uint8': 'u1', 'int8': 'i1', 'uint16': 'u2', 'int16': 'i2', 'uint32': 'u4', 'int32': 'i4',
           'uint64': 'u8', 'int64': 'i8', 'float32': 'f4', 'float64': 'f8'}
TIMES = 'builtin_interfaces/Time', 'builtin_interfaces/Duration'
FIELD = re.compile(r'^([\w/]+)(?:<=\d+)?(?:\[(<=)?(\d*)\])?\s+(\w+)(.*)$')


class Definition:
    """A message's type: `fields` are (name, type, how many), None if it is one value, 0 if any number."""

    def __init__(self, name, text):
        self.types, self.name = {}, short(name)
        for part in re.split(r'^=+\nMSG: ', text, flags=re.MULTILINE):
            head, _, body = (self.name, '', part) if not self.types else part.partition('\n')
            self.types[short(head.strip())] = list(fields_of(body, short(head.strip())))

    def read(self, data):
        """The value of a message's bytes. LassoError where they end too soon."""
        if len(data) < 4 or data[0] != 0 or data[1] > 1:
            raise LassoError(f'{self.name}: a message is no CDR, as its first bytes say')
        reader = Reader(data, '<' if data[1] == 1 else '>')
        try:
            return self.structure(self.name, reader)
        except (struct.error, ValueError, RecursionError) as error:
            raise LassoError(f'{self.name}: a message does not fit its definition: {error}') from error

    def structure(self, name, reader):
        if name in TIMES:
            seconds, nanoseconds = reader.number('i4'), reader.number('u4')
            return seconds * 1_000_000_000 + nanoseconds
        fields = self.types.get(name)
        if fields is None:
            raise LassoError(f'{self.name}: its definition does not say what {name} is')
        if self.is_vector(name):
            return reader.array('f8', len(fields))
        return {field: self.value(kind, count, reader) for field, kind, count in fields}

    def value(self, kind, count, reader):
        if count is None:
            return self.one(kind, reader)
        if count == 0:
            count = reader.number('u4')
        if kind in NUMBERS:
            return reader.array(NUMBERS[kind], count)
        if self.is_vector(kind):
            return reader.array('f8', count * len(self.types[kind])).reshape(count, len(self.types[kind]))
        return [self.one(kind, reader) for _ in range(count)]

    def one(self, kind, reader):
        if kind in NUMBERS:
            return reader.number(NUMBERS[kind])
        return reader.text() if kind == 'string' else self.structure(kind, reader)

    def is_vector(self, name):
        fields = self.types.get(name, ())
        return len(fields) > 0 and all(kind == 'float64' and count is None for _, kind, count in fields)


class Reader:
    """Aligned values from the fourth byte on."""

    def __init__(self, data, order):
        self.data, self.at, self.order = data, 4, order

    def align(self, size):
        self.at += -(self.at - 4) % size

    def number(self, code):
        value = self.array(code, 1)[0]
        return value.item()

    def array(self, code, count):
        kind = np.dtype(self.order + code)
        if count:
            self.align(kind.itemsize)
        values = np.frombuffer(self.data, kind, count, self.at)
        self.at += count * kind.itemsize
        return values.astype(kind.newbyteorder('='))

    def text(self):
        size = self.number('u4')
        value = bytes(self.data[self.at:self.at + size])
        self.at += size
        if len(value) < size:
            raise ValueError('it ends within a text')
        return value[:-1].decode('utf-8', 'replace')


def short(name):
    """geometry_msgs/msg/Pose is geometry_msgs/Pose."""
    return name.replace('/msg/', '/')


def fields_of(text, owner):
    for line in text.splitlines():
        found = FIELD.match(line.split('#')[0].strip())
        if not found or found[5].lstrip().startswith('='):
            continue  # empty, or a constant
        kind = short(found[1])
        if kind == 'Header':
            kind = 'std_msgs/Header'
        elif kind not in NUMBERS and kind != 'string' and '/' not in kind:
            kind = f'{owner.split("/")[0]}/{kind}'
        is_array = '[' in line.split()[0]
        yield found[4], kind, (0 if found[2] or not found[3] else int(found[3])) if is_array else None
