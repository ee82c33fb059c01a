"""Recordings (docs/recordings.md), and other MCAP files whose messages are ROS 2's (CDR, ros2msg)."""
import collections
import struct
import zlib

import numpy as np

from .cdr import Definition
from .compression import DECOMPRESS
from .errors import LassoError
from .packets import Packets

MAGIC = b'\x89MCAP0\r\n'
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, ATTACHMENT, STATISTICS, METADATA = 1, 2, 3, 4, 5, 6, 9, 11, 12
LARGEST_CHUNK = 1 << 31  # bytes: what says more is damaged
POINT_TYPES = ('', 'i1', 'u1', 'i2', 'u2', 'i4', 'u4', 'f4', 'f8')

Channel = collections.namedtuple('Channel', 'topic encoding schema')
Schema = collections.namedtuple('Schema', 'name encoding text')


class Recording:
    """A file, of which no more than the places of its chunks is kept. `damage` tells what of it cannot be read."""

    def __init__(self, path):
        self.path, self.damage = str(path), []
        self.schemas, self.channels, self.metadata, self.places, self.attached = {}, {}, {}, [], {}
        self.decoded, self.counted, self.file = {}, None, open(path, 'rb')
        if self.file.read(len(MAGIC)) != MAGIC:
            self.file.close()
            raise LassoError(f'{path}: is no MCAP file of version 0, as its first bytes say')
        try:
            self.survey()
        except LassoError:
            self.file.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    def close(self):
        self.file.close()

    @property
    def topics(self):
        """The name of the type of each topic's messages."""
        return {channel.topic: self.schemas[channel.schema].name if channel.schema in self.schemas else '' for channel in self.channels.values()}

    @property
    def about(self):
        """What the recorder says of the run: mission, scenario, seed, settings, commit. Empty of others' files."""
        return self.metadata.get('3dlasso', {})

    @property
    def files(self):
        """Names of the attached files."""
        return list(self.attached)

    def attachment(self, name):
        place = self.attached.get(name)
        if place is None:
            raise LassoError(f'{self.path}: has no attachment {name}; it has {", ".join(self.attached) or "none"}')
        self.file.seek(place[0])
        content = self.file.read(place[1])
        check = struct.unpack_from('<I', content, len(content) - 4)[0]
        if check and zlib.crc32(content[:-4]) != check:
            raise LassoError(f'{self.path}: the attachment {name} is damaged: it has another checksum than it says')
        return content[place[2]:place[2] + place[3]]

    def messages(self, topic, start_s=-np.inf, end_s=np.inf):
        """Nanoseconds of the log and bytes of each message of the topic in this span of time."""
        wanted = {number for number, channel in self.channels.items() if channel.topic == topic}
        if not wanted:
            raise LassoError(f'{self.path}: has no topic {topic}; it has {", ".join(sorted(self.topics)) or "none"}')
        for place in self.places:
            if place[2] * 1e-9 > end_s or place[3] * 1e-9 < start_s:
                continue
            for code, content in records(self.chunk(place)):
                if code == MESSAGE and struct.unpack_from('<H', content)[0] in wanted:
                    log_ns = struct.unpack_from('<Q', content, 6)[0]
                    if start_s <= log_ns * 1e-9 <= end_s:
                        yield log_ns, content[22:]

    def values(self, topic, start_s=-np.inf, end_s=np.inf):
        """Seconds and decoded value (cdr.py) of each message."""
        definition = self.definition(topic)
        for log_ns, data in self.messages(topic, start_s, end_s):
            yield log_ns * 1e-9, definition.read(data)

    def __getitem__(self, topic):
        """A row for each message: t_s, and its fields; those of a structure within have its name and a dot before theirs."""
        return array_of(self.values(topic))

    def clouds(self, topic='/scan', start_s=-np.inf, end_s=np.inf):
        """Seconds and points of each sensor_msgs/PointCloud2: an array with the cloud's own fields."""
        self.expect(topic, 'sensor_msgs/PointCloud2')
        for t_s, cloud in self.values(topic, start_s, end_s):
            try:
                points = points_of(cloud)
            except ValueError as error:
                raise LassoError(f'{self.path}: {topic}: a cloud at {t_s} s is not as its fields say: {error}') from error
            yield t_s, points

    def packets(self, topic='/packets'):
        """What the component sent, decoded."""
        self.expect(topic, 'lasso_msgs/Packet')
        return Packets(b''.join(value['data'].tobytes() for _, value in self.values(topic)), self.path)

    def expect(self, topic, name):
        if self.definition(topic).name != name:
            raise LassoError(f'{self.path}: {topic}: its messages are {self.definition(topic).name}, expected {name}')

    def definition(self, topic):
        if topic not in self.decoded:
            for channel in self.channels.values():
                if channel.topic == topic:
                    self.decoded[topic] = self.definition_of(channel)
        if topic not in self.decoded:
            raise LassoError(f'{self.path}: has no topic {topic}; it has {", ".join(sorted(self.topics)) or "none"}')
        return self.decoded[topic]

    def definition_of(self, channel):
        schema = self.schemas.get(channel.schema)
        if schema is None or schema.encoding != 'ros2msg' or channel.encoding != 'cdr':
            raise LassoError(f'{self.path}: {channel.topic}: messages are {channel.encoding} by {schema.encoding if schema else "no schema"}, '
                             'expected cdr by ros2msg; messages() gives their bytes')
        return Definition(schema.name, schema.text)

    def survey(self):
        """Where all is: a record's head each, not what chunks hold, unless the file ends before it says what its topics are."""
        self.file.seek(0, 2)
        end, at, whole = self.file.tell(), len(MAGIC), False
        while at + 9 <= end:
            self.file.seek(at)
            code, size = struct.unpack('<BQ', self.file.read(9))
            if size > end - at - 9:
                break
            try:
                self.take(code, at + 9, size)
            except struct.error:
                self.damage.append(f'the record at byte {at} is shorter than it says: it is left out')
            whole |= code == FOOTER
            at += 9 + size
        if not whole:
            self.damage.append(f'the file ends at byte {at} without its end: a run that was killed, or a file that was cut')
        if self.counted not in (None, len(self.places)):
            self.damage.append(f'{len(self.places)} of {self.counted} chunks are there: the others are damaged, and left out')
        for place in () if whole and self.channels else self.places:
            for code, content in records(self.chunk(place)):
                try:
                    self.declare(code, content)
                except struct.error:
                    self.damage.append(f'a record in the chunk at byte {place[0]} is shorter than it says: it is left out')

    def check_profile(self, head):
        profile = text_at(head, 0)[0]
        if profile not in ('', 'ros2'):
            raise LassoError(f'{self.path}: is an MCAP file of profile {profile[:20]!r}: expected \'ros2\', or none')

    def check_summary(self, at, start, _, check):
        """Of a footer whose content is at `at`. What a damaged summary says of topics is forgotten: chunks say it, too."""
        if not start or not check:
            return
        self.file.seek(start)
        if start > at or zlib.crc32(self.file.read(at + 16 - start)) != check:
            self.damage.append(f'the summary at byte {start} is damaged: topics are taken from the chunks')
            self.schemas, self.channels, self.counted = {}, {}, None

    def take(self, code, at, size):
        if code == CHUNK:
            start, end = struct.unpack('<QQ', self.file.read(16))
            self.places.append((at, size, start, end))
        elif code == HEADER:
            self.check_profile(self.file.read(min(size, 4096)))
        elif code in (SCHEMA, CHANNEL, METADATA):
            self.declare(code, self.file.read(size))
        elif code == ATTACHMENT:
            head = self.file.read(min(size, 4096))
            name, rest = text_at(head, 16)
            rest = text_at(head, rest)[1]
            self.attached[name] = at, size, rest + 8, struct.unpack_from('<Q', head, rest)[0]
        elif code == STATISTICS:
            self.counted = struct.unpack_from('<I', self.file.read(size), 22)[0]
        elif code == FOOTER:
            self.check_summary(at, *struct.unpack('<QQI', self.file.read(size)))

    def declare(self, code, content):
        if code == SCHEMA:
            name, at = text_at(content, 2)
            encoding, at = text_at(content, at)
            self.schemas[struct.unpack_from('<H', content)[0]] = Schema(name, encoding, text_at(content, at)[0])
        elif code == CHANNEL:
            number, schema = struct.unpack_from('<HH', content)
            topic, at = text_at(content, 4)
            self.channels[number] = Channel(topic, text_at(content, at)[0], schema)
        elif code == METADATA:
            name, at = text_at(content, 0)
            self.metadata[name] = map_at(content, at)

    def chunk(self, place):
        """Its records; none of a damaged one, which is told."""
        self.file.seek(place[0])
        content = self.file.read(place[1])
        size, check = struct.unpack_from('<QI', content, 16)
        compression, at = text_at(content, 28)
        if compression not in DECOMPRESS:
            raise LassoError(f'{self.path}: a chunk at byte {place[0]} is compressed by {compression}, expected zstd, lz4 or none')
        data = content[at + 8:]
        if compression:
            data = DECOMPRESS[compression](data, size) if size <= LARGEST_CHUNK else None
        if data is None or (check and zlib.crc32(data) != check):
            what = f'the chunk at byte {place[0]} is damaged: its messages are left out'
            if what not in self.damage:
                self.damage.append(what)
            return b''
        return data


def open_recording(path):
    return Recording(path)


def records(data):
    at = 0
    while at + 9 <= len(data):
        code, size = struct.unpack_from('<BQ', data, at)
        yield code, data[at + 9:at + 9 + size]
        at += 9 + size


def text_at(data, at):
    size = struct.unpack_from('<I', data, at)[0]
    return data[at + 4:at + 4 + size].decode('utf-8', 'replace'), at + 4 + size


def map_at(data, at):
    end, texts = at + 4 + struct.unpack_from('<I', data, at)[0], []
    at += 4
    while at < end:
        text, at = text_at(data, at)
        texts.append(text)
    return dict(zip(texts[::2], texts[1::2]))


def flat(value, prefix=''):
    for name, item in value.items():
        if isinstance(item, dict):
            yield from flat(item, f'{prefix}{name}.')
        else:
            yield prefix + name, item


def array_of(values):
    """Of (seconds, dict) pairs. A column is numeric where each row's value is a number, or an array of numbers of one shape; otherwise of Python objects."""
    rows = [{'t_s': t_s, **dict(flat(value))} for t_s, value in values]
    if not rows:
        return np.zeros(0, [('t_s', 'f8')])
    columns = {name: column([row[name] for row in rows]) for name in rows[0]}
    table = np.empty(len(rows), [(name, values.dtype, values.shape[1:]) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table


def column(values):
    numeric = all(isinstance(value, (bool, int, float, np.ndarray)) for value in values)
    if numeric and len({np.shape(value) for value in values}) == 1:
        return np.array(values)
    objects = np.empty(len(values), object)
    objects[:] = values
    return objects


def points_of(cloud):
    """Rows may have bytes behind their points. ValueError where its bytes are not those of its points."""
    fields, rows, columns, step, data = (cloud[name] for name in ('fields', 'height', 'width', 'point_step', 'data'))
    order = '>' if cloud['is_bigendian'] else '<'
    if any(not 0 < field['datatype'] < len(POINT_TYPES) for field in fields):
        raise ValueError('a field is of no kind from 1 to 8')
    types = [order + POINT_TYPES[field['datatype']] for field in fields]
    kind = np.dtype({'names': [field['name'] for field in fields], 'formats': [(code, field['count']) if field['count'] > 1 else code for code, field in zip(types, fields)],
                     'offsets': [field['offset'] for field in fields], 'itemsize': step})
    if rows * columns == 0:
        return np.zeros(0, kind)
    row = columns * step
    pitch = cloud['row_step'] if rows > 1 else row
    if row == 0 or pitch < row or len(data) < (rows - 1) * pitch + row:
        raise ValueError(f'it has {len(data)} bytes, expected those of {rows} x {columns} points of {step}')
    places = np.lib.stride_tricks.as_strided(data, (rows, row), (pitch * data.itemsize, data.itemsize))
    return np.frombuffer(places.tobytes(), kind)
