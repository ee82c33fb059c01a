"""The registration and the search by ctypes, against what mdat replay writes of the same scans: each digit that it writes."""
import csv
import unittest

import numpy as np

import flown
import lasso_mdat
from lasso_mdat import library

ROUGH = np.array([0.02, -0.015, 0.01])  # rad about x, y, z, and a tenth of it in metres: how far a prior is off


def turned(pose, rotation, shift):
    """A pose turned a little in the sensor's axes, and shifted: quaternions x, y, z, w multiplied term by term."""
    angle = np.linalg.norm(rotation)
    x, y, z = np.sin(angle / 2) * rotation / angle
    w, (a, b, c, d) = np.cos(angle / 2), pose[:4]
    q = np.array([w * a + x * d + y * c - z * b, w * b - x * c + y * d + z * a, w * c + x * b - y * a + z * d, w * d - x * a - y * b - z * c])
    return np.concatenate([q / np.linalg.norm(q), pose[4:] + shift])


def write(path, header, rows):
    with open(path, 'w', newline='', encoding='utf-8') as file:
        csv.writer(file).writerows([header, *([value if isinstance(value, (str, int)) else repr(float(value)) for value in row] for row in rows)])


def write_stl(path, boxes):
    """Boxes by two corners each, twelve triangles a box that face outwards, as text."""
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    text = 'solid boxes\n'
    for corners in boxes:
        points = [[corners[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
        for a, b, c, d in faces:
            for triangle in (a, b, c), (a, c, d):
                text += ' facet normal 0 0 0\n  outer loop\n' + ''.join('   vertex %g %g %g\n' % tuple(points[i]) for i in triangle) + '  endloop\n endfacet\n'
    path.write_text(text + 'endsolid boxes\n')


class LibraryTest(unittest.TestCase):
    """Three scans of a recorded run, written as mdat reads scans, and a prior for each that is off."""
    @classmethod
    def setUpClass(cls):
        cls.scans, cls.truth, cls.priors = flown.folder() / 'scans', [], []
        cls.scans.mkdir()
        with lasso_mdat.open_recording(flown.run() / 'spin.mcap') as run:
            truth, clouds = run['/truth'], list(run.clouds('/scan'))
            cls.cloud = clouds[0][1].copy()
        for number in range(3):
            cls.write_scan(number, *clouds[number])
            cls.truth.append(np.concatenate([truth['pose.orientation'][number], truth['pose.position'][number]]))
            cls.priors.append(turned(cls.truth[-1], ROUGH * (number + 1), 0.1 * ROUGH[::-1]))
        columns = ['scan', 'qx', 'qy', 'qz', 'qw', 'x_m', 'y_m', 'z_m']
        write(flown.folder() / 'priors.csv', columns, [[f'scan{i}', *prior] for i, prior in enumerate(cls.priors)])
        flown.mdat('mission', 'compile', flown.MISSION, '--out', 'target.3dli')
        cls.target = lasso_mdat.Target(flown.folder() / 'target.3dli')

    @classmethod
    def write_scan(cls, number, t_s, cloud):
        told = cloud[cloud['state'] <= 1]
        unit = np.stack([told['u' + name] for name in 'xyz'], 1).astype('f8')
        place = unit / np.linalg.norm(unit, axis=1, keepdims=True) * np.where(told['state'] == 0, told['range'].astype('f8'), 1)[:, None]
        seconds = t_s + 1e-6 * told['offset_us']
        write(cls.scans / f'scan{number}.csv', ['t_s', 'x_m', 'y_m', 'z_m', 'valid'],
              [[t, *p, int(state == 0)] for t, p, state in zip(seconds, place, told['state'])])

    def replayed(self, *arguments):
        flown.mdat('replay', flown.MISSION, '--scans', self.scans, '--force', '--out', 'replayed.csv', *arguments)
        with open(flown.folder() / 'replayed.csv', newline='', encoding='utf-8') as file:
            return list(csv.DictReader(file))

    def expect_pose(self, row, pose):
        printed = ['%.12g' % value for value in pose[:4]] + ['%.9g' % value for value in pose[4:]]
        self.assertEqual([row[name] for name in ('qx', 'qy', 'qz', 'qw', 'x_m', 'y_m', 'z_m')], printed)

    def test_registers_as_mdat_does(self):
        for number, row in enumerate(self.replayed('--initial', 'priors.csv')):
            result = self.target.register(self.scans / f'scan{number}.csv', self.priors[number])
            self.expect_pose(row, result['pose'])
            self.assertEqual((row['valid'], row['reason']), (str(result['valid']), library.reason(result)))
            self.assertEqual((row['iterations'], row['inliers']), (str(result['iterations']), str(result['inliers'])))
            self.assertEqual(row['t_s'], '%.6f' % (result['t_us'] * 1e-6))
            self.assertEqual(row['rms_m'], '%.6g' % result['rms_m'])
            sigma = np.sqrt(np.diag(result['covariance']))[[3, 4, 5, 0, 1, 2]]
            self.assertEqual([row[f'sigma_{name}'] for name in ('x_m', 'y_m', 'z_m', 'rx_rad', 'ry_rad', 'rz_rad')], ['%.6g' % value for value in sigma])
            self.assertEqual(result['valid'], 1)
            self.assertLess(np.linalg.norm(result['pose'][4:] - self.truth[number][4:]), 1e-3, 'and it is right')

    def test_a_rough_prior_is_one_in_both(self):
        for number, row in enumerate(self.replayed('--initial', 'priors.csv', '--wide')):
            self.expect_pose(row, self.target.register(self.scans / f'scan{number}.csv', self.priors[number], wide=True)['pose'])

    def test_searches_as_mdat_does(self):
        for number, row in enumerate(self.replayed('--initial', 'search')):
            result = self.target.search(self.scans / f'scan{number}.csv')
            self.expect_pose(row, result['pose'])
            self.assertEqual((row['outcome'], row['reason']), (library.outcome(result), library.reason(result)))
            self.assertEqual((row['candidates'], row['ratio']), (str(result['candidates']), '%.4f' % result['ratio']))

    def test_a_cloud_of_a_recording_is_a_scan(self):
        result = lasso_mdat.register(self.cloud, self.target, self.priors[0])
        self.assertEqual(result['valid'], 1, library.reason(result))
        self.assertEqual(result['returns'], (self.cloud['state'] == 0).sum())
        self.assertLess(np.linalg.norm(result['pose'][4:] - self.truth[0][4:]), 1e-3)

    def test_points_alone_are_a_scan(self):
        points = np.stack([self.cloud[name] for name in 'xyz'], 1)
        result = lasso_mdat.register(points, self.target, self.priors[0])
        self.assertEqual(result['returns'], (self.cloud['state'] == 0).sum())
        self.assertLess(np.linalg.norm(result['pose'][4:] - self.truth[0][4:]), 2e-3)

    def test_a_mesh_is_a_target(self):
        write_stl(flown.folder() / 'boxes.stl', (((-0.3, -0.2, -0.1), (0.3, 0.2, 0.1)), ((0.1, 0.05, 0.1), (0.25, 0.15, 0.3)), ((-0.55, -0.1, 0), (-0.3, 0, 0.08))))
        flown.mdat('mission', 'new', '--model', 'boxes.stl', '--scale', '1', '--out', 'boxes.toml')
        flown.mdat('run', 'boxes.toml', '--scenario', 'spin', '--frames', '2', '--no-report', '--record', 'boxes.mcap', '--out', 'boxes')
        with lasso_mdat.open_recording(flown.folder() / 'boxes.mcap') as run:
            row, cloud = run['/truth'][0], next(run.clouds('/scan'))[1]
        truth = np.concatenate([row['pose.orientation'], row['pose.position']])
        result = lasso_mdat.register(cloud, flown.folder() / 'boxes.stl', turned(truth, ROUGH, 0.1 * ROUGH))
        self.assertEqual(result['valid'], 1, library.reason(result))
        self.assertLess(np.linalg.norm(result['pose'][4:] - truth[4:]), 3e-3)

    def test_bad_input_is_told(self):
        good = self.scans / 'scan0.csv'
        for scan, prior, what in ((good, self.priors[0][:6], '7 numbers'), (good, 2 * self.priors[0], 'quaternion x, y, z, w has length'),
                                  (np.zeros((4, 2)), self.priors[0], r'expected \(n, 3\)'), (np.full((2, 3), 1e9), self.priors[0], 'm away')):
            with self.assertRaisesRegex(lasso_mdat.LassoError, what):
                self.target.register(scan, prior)
        for rays in np.zeros(10), np.zeros((2, 2), library.RAY), [1, 2]:  # the library would read beyond them
            with self.assertRaisesRegex(lasso_mdat.LassoError, r'array \(n,\) of library.RAY'):
                library.Scan(rays, True)
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'as many times and hits as points'):
            library.Scan.of_points(np.ones((4, 3)), times_s=np.zeros((4, 2)))
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'the cloud has no offset_us, range, '):
            self.target.register(self.cloud[['x', 'y', 'z']], self.priors[0])
        with self.assertRaisesRegex(lasso_mdat.LassoError, r'the cloud has the shape \(2, 3\)'):
            self.target.register(self.cloud[:6].reshape(2, 3), self.priors[0])
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'nothing.stl: is no file'):
            lasso_mdat.Target('nothing.stl')
        broken = flown.folder() / 'broken.3dli'
        broken.write_bytes(b'3DLI and nothing else')
        with self.assertRaisesRegex(lasso_mdat.LassoError, 'broken.3dli: not a valid flight image'):
            lasso_mdat.Target(broken)


if __name__ == '__main__':
    unittest.main()
