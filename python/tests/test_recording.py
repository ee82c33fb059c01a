"""Recordings as NumPy arrays, against telemetry and tables of the same run."""
import struct
import unittest

import numpy as np

import flown
import lasso_mdat
from lasso_mdat import cdr, recording


def turned(orientation):
    """Matrices of quaternions x, y, z, w, term by term."""
    x, y, z, w = orientation.T
    return np.moveaxis(np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), 2, 0)


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.path = flown.run() / 'spin.mcap'
        cls.run_ = lasso_mdat.open_recording(cls.path)
        cls.told = lasso_mdat.open_packets(flown.run() / 'run/telemetry.ccsds')['pose']

    @classmethod
    def tearDownClass(cls):
        cls.run_.close()

    def test_poses_are_those_of_telemetry(self):
        valid = self.told[self.told['valid'] == 1]
        pose = self.run_['/pose']
        self.assertGreater(len(pose), 5)
        np.testing.assert_array_equal(pose['pose.position'], valid['p_sensor_target_m'])
        np.testing.assert_array_equal(pose['pose.orientation'], valid['q_sensor_target'])
        np.testing.assert_array_equal(pose['header.stamp'], valid['t_measurement_us'] * 1000)
        np.testing.assert_allclose(pose['t_s'], valid['t_measurement_us'] * 1e-6, rtol=0, atol=1e-12)
        self.assertEqual(set(pose['header.frame_id']), {'sensor'})

    def test_covariances_have_the_translation_first(self):
        upper = np.triu_indices(6)
        for row, told in zip(self.run_['/pose_with_covariance'], self.told[self.told['valid'] == 1]):
            covariance = np.zeros((6, 6))
            covariance[upper] = told['covariance']
            covariance = covariance + np.triu(covariance, 1).T
            order = [3, 4, 5, 0, 1, 2]
            np.testing.assert_array_equal(row['pose.covariance'].reshape(6, 6), covariance[np.ix_(order, order)])

    def test_rates_are_in_the_targets_axes(self):
        odometry = self.run_['/odom']
        rotation = turned(odometry['pose.pose.orientation'])
        back = np.einsum('nij,nj->ni', rotation, odometry['twist.twist.angular'])
        np.testing.assert_allclose(back, self.told['filter_omega_radps'], rtol=0, atol=1e-12)

    def test_truth_less_estimate_is_the_error_that_mdat_tells(self):
        frames = lasso_mdat.open_results(flown.run() / 'run').frames
        off_mm = 1e3 * np.linalg.norm(self.run_['/pose']['pose.position'] - self.run_['/truth']['pose.position'][self.told['valid'] == 1], axis=1)
        np.testing.assert_allclose(off_mm, frames['error_mm'][frames['valid'] == 1], rtol=0, atol=1e-3)

    def test_frames_hang_together(self):
        for row, truth in zip(self.run_['/tf'], self.run_['/truth']):
            links = {link['child_frame_id']: (link['header']['frame_id'], link['transform']) for link in row['transforms']}
            self.assertEqual({child: parent for child, (parent, _) in links.items()},
                             {'sensor': 'world', 'target': 'sensor', 'target_true': 'sensor', 'target_filtered': 'sensor'})
            np.testing.assert_array_equal(links['target_true'][1]['translation'], truth['pose.position'])
            np.testing.assert_array_equal(links['target_true'][1]['rotation'], truth['pose.orientation'])

    def test_clouds_have_their_own_fields(self):
        clouds = list(self.run_.clouds('/scan'))
        self.assertEqual(len(clouds), len(self.told))
        for (_, cloud), told in zip(clouds, self.told):
            returned = cloud['state'] == 0
            self.assertEqual(returned.sum(), told['returns'])
            self.assertEqual(len(cloud), told['plan_points'])
            xyz = np.stack([cloud[name] for name in 'xyz'], 1)
            unit = np.stack([cloud['u' + name] for name in 'xyz'], 1)
            np.testing.assert_allclose(xyz[returned], unit[returned] * cloud['range'][returned, None], rtol=1e-6)
            self.assertTrue(np.isnan(xyz[~returned]).all())
            self.assertEqual(cloud['offset_us'].max() - cloud['offset_us'].min(), told['plan_duration_us'])

    def test_packets_are_those_of_the_run(self):
        packets = self.run_.packets()
        np.testing.assert_array_equal(packets['pose'], self.told)
        self.assertEqual((packets.unknown, packets.skipped), (0, 0))

    def test_a_span_of_time(self):
        stamps = self.run_['/pose']['t_s']
        within = [t_s for t_s, _ in self.run_.values('/pose', stamps[2], stamps[4])]
        self.assertEqual(within, list(stamps[2:5]))

    def test_all_that_flies_it_again_is_attached(self):
        self.assertEqual(self.run_.about['scenario'], 'spin')
        self.assertEqual(self.run_.attachment('image.3dli')[:4], b'3DLI')
        self.assertIn(b'[scenario.spin]', self.run_.attachment(next(name for name in self.run_.files if name.endswith('missions/hubble_tenth.toml'))))

    def test_every_topic_has_its_definition(self):
        for topic in self.run_.topics:
            for _, value in self.run_.values(topic):
                self.assertTrue(value, topic)
                break

    def test_a_cut_file_gives_what_is_whole(self):
        data = self.path.read_bytes()
        whole = self.run_['/pose']
        for end in len(data) // 3, 2 * len(data) // 3, len(data) - 9:
            cut = flown.folder() / 'cut.mcap'
            cut.write_bytes(data[:end])
            with lasso_mdat.open_recording(cut) as part:
                self.assertRegex(part.damage[0], 'the file ends at byte')
                if '/pose' in part.topics:
                    found = part['/pose']
                    np.testing.assert_array_equal(found['pose.position'], whole['pose.position'][:len(found)])

    def test_a_damaged_chunk_is_left_out_and_told(self):
        data = bytearray(self.path.read_bytes())
        place = next(place for place in self.run_.places if place[3] > 1e9 * self.run_['/pose']['t_s'][1])
        data[place[0] + place[1] // 2] ^= 0x10
        damaged = flown.folder() / 'damaged.mcap'
        damaged.write_bytes(data)
        with lasso_mdat.open_recording(damaged) as part:
            found = part['/pose']
            self.assertEqual(part.damage, [f'the chunk at byte {place[0]} is damaged: its messages are left out'])
            self.assertLess(len(found), len(self.run_['/pose']))

    def test_damage_of_any_byte_is_told_or_changes_nothing(self):
        """Of the records beside chunks, too: topics, attachments, lengths. 80 bytes at places that a seed draws, and those of the summary."""
        data = self.path.read_bytes()
        places = np.random.default_rng(17).integers(8, len(data), 80)
        summary = struct.unpack_from('<Q', data, len(data) - 28)[0]
        for place in [*places, *range(summary, len(data) - 8, 197)]:
            damaged = bytearray(data)
            damaged[place] ^= 0x15
            file = flown.folder() / 'byte.mcap'
            file.write_bytes(damaged)
            try:
                with lasso_mdat.open_recording(file) as part:
                    same = part.topics == self.run_.topics and all(part.attachment(name) == self.run_.attachment(name) for name in self.run_.files)
                    same = same and list(part.messages('/odom')) == list(self.run_.messages('/odom'))
                    self.assertTrue(same or part.damage, f'byte {place}')
            except lasso_mdat.LassoError as error:
                self.assertRegex(str(error), 'byte.mcap: ')

    def test_what_is_not_there_is_told_with_what_is(self):
        with self.assertRaisesRegex(lasso_mdat.LassoError, r'spin.mcap: has no topic /poses; it has .*/pose, '):
            self.run_['/poses']
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'has no attachment image; it has .*image.3dli'):
            self.run_.attachment('image')
        other = flown.folder() / 'other.mcap'
        other.write_bytes(b'something else')
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'other.mcap: is no MCAP file'):
            lasso_mdat.open_recording(other)

    def test_another_profile_is_refused_with_what_is_read(self):
        data = self.path.read_bytes()
        other = flown.folder() / 'profile.mcap'
        other.write_bytes(data.replace(b'ros2', b'ros1', 1))
        with self.assertRaisesRegex(lasso_mdat.LassoError, "profile.mcap: is an MCAP file of profile 'ros1': expected 'ros2', or none"):
            lasso_mdat.open_recording(other)


class CloudTest(unittest.TestCase):
    """Clouds of others: rows with bytes behind their points, either order of bytes, and such as are none."""
    def cloud(self, order='<', **other):
        points = np.array([[1.5, 258], [-2, 3], [4, 5], [6, 7]])
        data = b''.join(struct.pack(order + 'fH2x', x, int(y)) + (b'pad' if i == 1 else b'') for i, (x, y) in enumerate(points))
        fields = [{'name': 'x', 'offset': 0, 'datatype': 7, 'count': 1}, {'name': 'y', 'offset': 4, 'datatype': 4, 'count': 1}]
        return points, {'height': 2, 'width': 2, 'fields': fields, 'is_bigendian': order == '>', 'point_step': 8, 'row_step': 19,
                        'data': np.frombuffer(data, 'u1'), **other}

    def test_rows_and_orders_of_bytes(self):
        for order in '<>':
            points, cloud = self.cloud(order)
            found = recording.points_of(cloud)
            np.testing.assert_array_equal(np.stack([found['x'], found['y']], 1), points)

    def test_what_does_not_fit_is_refused(self):
        for other in {'row_step': 15}, {'height': 3}, {'width': 3}, {'point_step': 0}, {'data': np.zeros(34, 'u1')}, \
                {'fields': [{'name': 'x', 'offset': 0, 'datatype': 9, 'count': 1}]}:
            with self.assertRaises(ValueError, msg=str(other)):
                recording.points_of(self.cloud(**other)[1])
        self.assertEqual(len(recording.points_of(self.cloud(height=0)[1])), 0)

    def test_a_topic_of_another_type_is_refused(self):
        with lasso_mdat.open_recording(flown.run() / 'spin.mcap') as run:
            with self.assertRaisesRegex(lasso_mdat.LassoError, '/pose: its messages are geometry_msgs/PoseStamped, expected sensor_msgs/PointCloud2'):
                next(run.clouds('/pose'))
            with self.assertRaisesRegex(lasso_mdat.LassoError, '/scan: .* expected lasso_msgs/Packet'):
                run.packets('/scan')


class CdrTest(unittest.TestCase):
    """A message written by hand: alignment from the fourth byte, texts with their end, bounded and fixed arrays, constants and comments left out."""
    TEXT = ('uint8 KIND=3 # a constant\nuint8 kind\nstring<=8 name "none"\nfloat64[2] pair\nPoint[] points\nint16[<=4] few\nbool last\n'
            + '=' * 80 + '\nMSG: a/Point\nfloat64 x\nfloat64 y\n')

    def test_little_endian(self):
        self.check('<', b'\x00\x01\x00\x00')

    def test_big_endian(self):
        self.check('>', b'\x00\x00\x00\x00')

    def check(self, order, head):
        body = struct.pack(order + 'B3xI3s5x2d', 7, 3, b'ab\0', 1.5, -2.5)
        body += struct.pack(order + 'I4x4d', 2, 1, 2, 3, 4) + struct.pack(order + 'I2h?', 2, -5, 6, True)
        value = cdr.Definition('a/msg/Test', self.TEXT).read(head + body)
        self.assertEqual((value['kind'], value['name'], value['last']), (7, 'ab', True))
        np.testing.assert_array_equal(value['pair'], [1.5, -2.5])
        np.testing.assert_array_equal(value['points'], [[1, 2], [3, 4]])
        np.testing.assert_array_equal(value['few'], [-5, 6])

    def test_a_short_message_is_refused(self):
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'a/Test: a message does not fit its definition'):
            cdr.Definition('a/msg/Test', self.TEXT).read(b'\x00\x01\x00\x00\x07')


if __name__ == '__main__':
    unittest.main()
