"""Registration and search of single scans, by the component that flies (liblasso_mdat, mdat/library/lasso_mdat.h): what mdat replay computes, bit by bit."""
import ctypes
import ctypes.util
import functools
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from .errors import LassoError
from .tables import read_table

INTERFACE, ROOM = 1, 400
HERE = pathlib.Path(__file__).resolve()
BUILD = HERE.parents[2] / 'out/build/mdat'
PLACES = BUILD / 'library/liblasso_mdat.so', HERE.parents[3] / 'liblasso_mdat.so'  # of the sources, or installed: lib/python3/dist-packages/lasso_mdat
RAY = np.dtype([('direction', 'f4', 3), ('range_m', 'f4'), ('t_us', 'i8'), ('sigma_factor', 'f4'), ('state', 'i4')], align=True)
REGISTRATION = np.dtype([('pose', 'f8', 7), ('covariance', 'f8', (6, 6)), ('t_us', 'i8'), ('valid', 'i4'), ('reason', 'i4'), ('iterations', 'i4'),
                         ('rays', 'i4'), ('returns', 'i4'), ('inliers', 'i4'), ('rms_m', 'f8'), ('normalized_residual', 'f8'), ('inlier_share', 'f8'),
                         ('agreement', 'f8')], align=True)
SEARCH = np.dtype([('pose', 'f8', 7), ('covariance', 'f8', (6, 6)), ('t_us', 'i8'), ('outcome', 'i4'), ('reason', 'i4'), ('disagreement', 'f8'), ('ratio', 'f8'),
                   ('candidates', 'i4'), ('candidate', [('pose', 'f8', 7), ('disagreement', 'f8'), ('score', 'f8')], 6)], align=True)


@functools.lru_cache(None)
def library():
    path = os.environ.get('LASSO_MDAT_LIBRARY') or next((str(file) for file in PLACES if file.exists()), None) \
        or ctypes.util.find_library('lasso_mdat')
    if path is None:
        raise LassoError(f'{PLACES[0]} is not there: make python builds it; or LASSO_MDAT_LIBRARY names it')
    found = ctypes.CDLL(path)
    found.lasso_open.restype = ctypes.c_void_p
    found.lasso_most_rays.restype = ctypes.c_size_t
    for name in 'lasso_reason', 'lasso_outcome', 'lasso_search_reason':
        getattr(found, name).restype = ctypes.c_char_p
    if found.lasso_interface() != INTERFACE:
        raise LassoError(f'{path}: has interface {found.lasso_interface()}, expected {INTERFACE}: make python builds the one of these sources')
    return found


def call(name, *arguments):
    why = ctypes.create_string_buffer(ROOM)
    if getattr(library(), name)(*arguments, why, ctypes.c_size_t(ROOM)) != 0:
        raise LassoError(why.value.decode())


def address(array):
    return None if array is None else array.ctypes.data_as(ctypes.c_void_p)


class Listed(ctypes.Structure):
    """lasso_scan."""
    _fields_ = [('rays', ctypes.c_void_p), ('count', ctypes.c_size_t), ('misses_known', ctypes.c_int32)]


class Scan:
    """Rays as the component takes them. `misses_known`: rays without return are among them."""

    def __init__(self, rays, misses_known):
        """Of an array of RAY, whose bytes the library reads as they are."""
        if not isinstance(rays, np.ndarray) or rays.dtype != RAY or rays.ndim != 1:
            raise LassoError('rays are expected as an array (n,) of library.RAY')
        self.rays, self.misses_known = rays, bool(misses_known)

    @staticmethod
    def of(scan):
        """Of an array of points (n, 3) in the sensor's frame, m; of a cloud of a recording's /scan; of the name of a file .csv; or a Scan."""
        if isinstance(scan, Scan):
            return scan
        if isinstance(scan, (str, os.PathLike)):
            return read_scan(scan)
        scan = np.asarray(scan)
        return Scan.of_cloud(scan) if scan.dtype.names else Scan.of_points(scan)

    @staticmethod
    def of_cloud(cloud):
        """Each sample as it was, bit by bit."""
        missing = {'ux', 'uy', 'uz', 'range', 'sigma_factor', 'offset_us', 'state'} - set(cloud.dtype.names)
        if missing:
            raise LassoError(f'the cloud has no {", ".join(sorted(missing))}: expected the fields of /scan, or points (n, 3)')
        if cloud.ndim != 1:
            raise LassoError(f'the cloud has the shape {cloud.shape}, expected (n,)')
        rays = np.zeros(len(cloud), RAY)
        rays['direction'] = np.stack([cloud[name] for name in ('ux', 'uy', 'uz')], 1)
        rays['range_m'], rays['sigma_factor'], rays['t_us'] = cloud['range'], cloud['sigma_factor'], cloud['offset_us']
        rays['state'] = np.minimum(cloud['state'], 2)  # one that was lost on its way says nothing
        return Scan(rays, True)

    @staticmethod
    def of_points(points_m, times_s=None, hits=None):
        """`hits` false: a miss, its point the unit direction. Rows of zeros or NaN are no rays. Of more rays than the component takes, some are taken."""
        points_m = np.ascontiguousarray(points_m, 'f8')
        if points_m.ndim != 2 or points_m.shape[1] != 3:
            raise LassoError(f'points have the shape {points_m.shape}, expected (n, 3)')
        times_s, hits = (None if values is None else np.ascontiguousarray(values, kind) for values, kind in ((times_s, 'f8'), (hits, 'u1')))
        if any(values is not None and values.shape != (len(points_m),) for values in (times_s, hits)):
            raise LassoError(f'expected as many times and hits as points, {len(points_m)}')
        rays, count = np.zeros(library().lasso_most_rays(), RAY), ctypes.c_size_t()
        call('lasso_rays_of_points', address(points_m), address(times_s), address(hits), ctypes.c_size_t(len(points_m)), address(rays), ctypes.byref(count))
        return Scan(rays[:count.value], hits is not None)


def read_scan(path):
    """A scan as mdat writes it (.csv: t_s, x_m, y_m, z_m, valid; the first and the last may be missing)."""
    table = read_table(path)
    if not {'x_m', 'y_m', 'z_m'} <= set(table.dtype.names):
        raise LassoError(f'{path}: has no columns x_m, y_m and z_m')
    points = np.stack([table[name] for name in ('x_m', 'y_m', 'z_m')], 1)
    return Scan.of_points(points, *(table[name] if name in table.dtype.names else None for name in ('t_s', 'valid')))


def program():
    path = os.environ.get('LASSO_MDAT') or (str(BUILD / 'mdat') if (BUILD / 'mdat').exists() else shutil.which('mdat'))
    if path is None:
        raise LassoError('mdat is not there, which makes a model of a mesh: make build builds it; or LASSO_MDAT names it')
    return path


def mdat(*arguments):
    """Runs mdat, and returns what it prints. LassoError with its last word where it fails."""
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise LassoError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f'mdat {arguments[0]} failed')
    return done.stdout


def image_of(path, scale):
    """Bytes of the flight image: of a file that is one, of a mission (.toml), or of a mesh, for which mdat writes a mission first."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise LassoError(f'{path}: is no file; expected a mesh, a mission (.toml) or a flight image (.3dli)')
    with open(path, 'rb') as file:
        if file.read(4) == b'3DLI':
            return path.read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        mission, image = path, f'{folder}/target.3dli'
        if path.suffix != '.toml':
            mission = f'{folder}/target.toml'
            mdat('mission', 'new', '--model', path.resolve(), '--scale', repr(float(scale)), '--out', mission)
        mdat('mission', 'compile', mission, '--out', image)
        return pathlib.Path(image).read_bytes()


class Target:
    """What is looked for: a mesh (its unit times `scale` is a metre), a mission, or a flight image. One thread at a time."""

    def __init__(self, path, scale=1.0):
        image, why = image_of(path, scale), ctypes.create_string_buffer(ROOM)
        self.handle = library().lasso_open(image, ctypes.c_size_t(len(image)), why, ctypes.c_size_t(ROOM))
        if not self.handle:
            raise LassoError(f'{path}: {why.value.decode()}')

    def __del__(self):
        if getattr(self, 'handle', None):
            library().lasso_close(ctypes.c_void_p(self.handle))

    def ask(self, name, scan, kind, *between):
        scan, result = Scan.of(scan), np.zeros(1, kind)
        rays = np.ascontiguousarray(scan.rays)
        call(name, ctypes.c_void_p(self.handle), ctypes.byref(Listed(address(rays), len(rays), scan.misses_known)), *between, address(result))
        return result[0]

    def register(self, scan, prior, wide=False):
        """The registration from a pose T_sensor_target (x, y, z, w, then m): a record of REGISTRATION. `wide`: the prior is rough. Its covariance is of
        (rotation, translation)."""
        prior = np.ascontiguousarray(prior, 'f8')
        if prior.shape != (7,):
            raise LassoError(f'the prior has the shape {prior.shape}, expected 7 numbers: x, y, z, w of the quaternion, and the position')
        return self.ask('lasso_register', scan, REGISTRATION, address(prior), int(wide))

    def search(self, scan):
        """The pose without any prior: a record of SEARCH, whose first `candidates` of `candidate` count."""
        return self.ask('lasso_search', scan, SEARCH)


def target_of(mesh):
    return mesh if isinstance(mesh, Target) else Target(mesh)


def register(scan, mesh, prior, wide=False):
    return target_of(mesh).register(scan, prior, wide)


def search(scan, mesh):
    return target_of(mesh).search(scan)


def reason(result):
    """Why a registration can be trusted, or not; why a search ended so."""
    names = 'lasso_reason' if 'valid' in result.dtype.names else 'lasso_search_reason'
    return getattr(library(), names)(int(result['reason'])).decode()


def outcome(result):
    return library().lasso_outcome(int(result['outcome'])).decode()
