"""Packets as NumPy arrays, against what mdat decode prints of the same bytes."""
import binascii
import io
import json
import subprocess
import sys
import unittest

import numpy as np

import flown
import lasso_mdat
from lasso_mdat import packets as reader


class PacketsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.path = flown.run() / 'run/telemetry.ccsds'
        cls.packets = lasso_mdat.open_packets(cls.path)

    def test_every_number_is_that_of_mdat(self):
        for name in self.packets:
            printed = [packet['items'] for packet in flown.decoded() if packet['packet'] == name]
            table = self.packets[name]
            self.assertEqual(len(table), len(printed), name)
            for row, items in zip(table, printed):
                self.compare(name, row, items)
        self.assertEqual(sum(map(len, self.packets.values())), len(flown.decoded()))
        self.assertEqual((self.packets.unknown, self.packets.skipped), (0, 0))

    def compare(self, name, row, items):
        self.assertEqual(set(row.dtype.names) - {'t_s'}, set(items), name)
        for item, value in items.items():
            values = value if isinstance(value, list) else [value]
            if isinstance(values[0], str):
                continue  # words: below
            np.testing.assert_array_equal(np.ravel(row[item]), np.array(values, row[item].dtype), f'{name}.{item}')

    def test_words_are_those_of_mdat(self):
        for item in 'reason', 'stop', 'mode':
            printed = [packet['items'][item] for packet in flown.decoded() if packet['packet'] == 'pose']
            self.assertEqual(list(self.packets.words('pose', item)), printed)

    def test_time_is_that_of_the_header(self):
        printed = [packet['header'] for packet in flown.decoded() if packet['packet'] == 'pose']
        expected = [header['time_seconds'] + header['time_fraction'] / 2 ** 24 for header in printed]
        np.testing.assert_array_equal(self.packets['pose']['t_s'], expected)

    def test_bytes_between_packets_are_counted_and_a_damaged_packet_is_none(self):
        data = bytearray(self.path.read_bytes())
        found = lasso_mdat.Packets(b'noise' + bytes(data) + b'\x08')
        self.assertEqual(found.skipped, 6)
        np.testing.assert_array_equal(found['pose'], self.packets['pose'])
        first = next(packet for packet in flown.decoded() if packet['packet'] == 'pose')
        data[first['offset'] + 60] ^= 1
        damaged = lasso_mdat.Packets(bytes(data))
        np.testing.assert_array_equal(damaged['pose'], self.packets['pose'][1:])
        self.assertEqual(damaged.skipped, first['size'])

    def test_another_component_is_read_by_its_apid(self):
        first = next(packet for packet in flown.decoded() if packet['packet'] == 'pose')
        packet = bytearray(self.path.read_bytes()[first['offset']:first['offset'] + first['size']])
        packet[0:2] = bytes([packet[0] & 0xF8 | 0x2A5 >> 8, 0x2A5 & 0xFF])
        packet[-2:] = binascii.crc_hqx(packet[:-2], 0xFFFF).to_bytes(2, 'big')
        self.assertEqual(len(lasso_mdat.Packets(bytes(packet))), 0)
        np.testing.assert_array_equal(lasso_mdat.Packets(bytes(packet), apid=0x2A5)['pose'], self.packets['pose'][:1])

    def test_what_is_not_there_is_told_with_what_is(self):
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'telemetry.ccsds: has no packet pos; it has .*pose'):
            self.packets['pos']
        text = flown.folder() / 'text'
        text.write_text('no packets')
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'text: holds no packet of APID 977'):
            lasso_mdat.open_packets(text)

    def test_the_dictionary_is_that_of_mdat(self):
        packed = subprocess.run([sys.executable, flown.TOP / 'python/pack_dictionary'], input=flown.mdat('dictionary', '--format', 'json'), capture_output=True,
                                text=True, check=True).stdout
        self.assertEqual(json.load(io.StringIO(packed)), reader.dictionary(), 'make write WHAT=icd writes it')


if __name__ == '__main__':
    unittest.main()
