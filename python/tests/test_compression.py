"""Chunks that libzstd and liblz4 themselves compressed: whole, cut and damaged; and a recording whose chunks are LZ4's."""
import ctypes
import struct
import unittest
import zlib

import numpy as np

import flown
import lasso_mdat
from lasso_mdat import compression, recording

DATA = b''.join(struct.pack('<Id', i, i / 7) for i in range(5000)) + bytes(300000)  # more than a block of LZ4


def compressed(library, function, data, *more):
    call = getattr(library, function)
    call.restype = ctypes.c_size_t
    room = ctypes.create_string_buffer(2 * len(data) + 1000)
    size = call(room, ctypes.c_size_t(len(room)), data, ctypes.c_size_t(len(data)), *more)
    return room.raw[:size]


def by_lz4(data):
    return compressed(compression.lz4_library(), 'LZ4F_compressFrame', data, None)


def by_zstd(data):
    return compressed(compression.zstd_library(), 'ZSTD_compress', data, 3)


class CompressionTest(unittest.TestCase):
    def test_bytes_come_back(self):
        for name, compress in (('lz4', by_lz4), ('zstd', by_zstd)):
            for data in DATA, b'', b'x':
                self.assertEqual(compression.DECOMPRESS[name](compress(data), len(data)), data, name)

    def test_two_frames_are_one_content(self):
        self.assertEqual(compression.lz4(by_lz4(DATA) + by_lz4(b'and more'), len(DATA) + 8), DATA + b'and more')

    def test_what_is_damaged_is_none(self):
        for name, compress in (('lz4', by_lz4), ('zstd', by_zstd)):
            whole = compress(DATA)
            for data, size in ((whole[:-9], len(DATA)), (whole, len(DATA) - 1), (whole, len(DATA) + 1), (b'garbage' * 9, 63), (b'', 5)):
                self.assertIsNone(compression.DECOMPRESS[name](data, size), f'{name} {len(data)} {size}')

    def test_a_recording_of_lz4_is_read(self):
        """The first of the run's chunks with poses, compressed otherwise, behind a header, without an index."""
        with lasso_mdat.open_recording(flown.run() / 'spin.mcap') as run:
            whole = run['/pose']
            place = next(place for place in run.places if place[3] > 1e9 * whole['t_s'][0])
            records = run.chunk(place)
        head = struct.pack('<QQQI', place[2], place[3], len(records), zlib.crc32(records)) + struct.pack('<I', 3) + b'lz4'
        body = by_lz4(records)
        chunk = head + struct.pack('<Q', len(body)) + body
        header = struct.pack('<I', 4) + b'ros2' + struct.pack('<I', 0)
        file = flown.folder() / 'lz4.mcap'
        file.write_bytes(recording.MAGIC + struct.pack('<BQ', 1, len(header)) + header + struct.pack('<BQ', 6, len(chunk)) + chunk)
        with lasso_mdat.open_recording(file) as part:
            found = part['/pose']
            self.assertGreater(len(found), 0)
            np.testing.assert_array_equal(found['pose.position'], whole['pose.position'][:len(found)])


if __name__ == '__main__':
    unittest.main()
