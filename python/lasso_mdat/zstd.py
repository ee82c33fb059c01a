"""Frames of Zstandard, by the libzstd that each Debian has (ctypes: no package of Python is needed)."""
import ctypes
import ctypes.util
import functools

from .errors import LassoError


@functools.lru_cache(None)
def library():
    name = ctypes.util.find_library('zstd')
    if name is None:
        raise LassoError('libzstd is not installed, and chunks are compressed by it: apt-get install libzstd1')
    zstd = ctypes.CDLL(name)
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    zstd.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    return zstd


def decompress(data, size):
    """The `size` bytes that were compressed; None where the data are damaged."""
    room = ctypes.create_string_buffer(max(size, 1))
    done = library().ZSTD_decompress(room, size, bytes(data), len(data))
    return room.raw[:size] if done == size else None
