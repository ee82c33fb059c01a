"""Compressed chunks, by the libraries that each Debian has (ctypes: no package of Python is needed): Zstandard by libzstd, frames of LZ4 by liblz4."""
import ctypes
import ctypes.util
import functools

from .errors import LassoError

LZ4F_VERSION = 100


def loaded(name, package):
    path = ctypes.util.find_library(name)
    if path is None:
        raise LassoError(f'lib{name} is not installed, and chunks are compressed by it: apt-get install {package}')
    return ctypes.CDLL(path)


@functools.lru_cache(None)
def zstd_library():
    zstd = loaded('zstd', 'libzstd1')
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    zstd.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    return zstd


@functools.lru_cache(None)
def lz4_library():
    lz4 = loaded('lz4', 'liblz4-1')
    size = ctypes.POINTER(ctypes.c_size_t)
    lz4.LZ4F_createDecompressionContext.restype = ctypes.c_size_t
    lz4.LZ4F_createDecompressionContext.argtypes = [ctypes.POINTER(ctypes.c_void_p), ctypes.c_uint]
    lz4.LZ4F_freeDecompressionContext.argtypes = [ctypes.c_void_p]
    lz4.LZ4F_decompress.restype = ctypes.c_size_t
    lz4.LZ4F_decompress.argtypes = [ctypes.c_void_p, ctypes.c_void_p, size, ctypes.c_void_p, size, ctypes.c_void_p]
    lz4.LZ4F_isError.argtypes = [ctypes.c_size_t]
    return lz4


def zstd(data, size):
    room = ctypes.create_string_buffer(max(size, 1))
    done = zstd_library().ZSTD_decompress(room, size, bytes(data), len(data))
    return room.raw[:size] if done == size else None


def lz4(data, size):
    library, context = lz4_library(), ctypes.c_void_p()
    if library.LZ4F_isError(library.LZ4F_createDecompressionContext(ctypes.byref(context), LZ4F_VERSION)):
        return None
    try:
        return lz4_frames(library, context, bytes(data), size)
    finally:
        library.LZ4F_freeDecompressionContext(context)


def lz4_frames(library, context, data, size):
    """All of `data` has to be used, and its last frame to be whole."""
    source, room = ctypes.create_string_buffer(data, max(len(data), 1)), ctypes.create_string_buffer(max(size, 1))
    used, made, hint = 0, 0, 1
    while used < len(data):
        got, given = ctypes.c_size_t(size - made), ctypes.c_size_t(len(data) - used)
        hint = library.LZ4F_decompress(context, ctypes.byref(room, made), ctypes.byref(got), ctypes.byref(source, used), ctypes.byref(given), None)
        if library.LZ4F_isError(hint) or (got.value == 0 and given.value == 0):
            return None
        used, made = used + given.value, made + got.value
    return room.raw[:size] if made == size and hint == 0 else None


# The `size` bytes that were compressed, by the name that MCAP has for it; None where the data are damaged. Without a name they are as they are.
DECOMPRESS = {'': None, 'zstd': zstd, 'lz4': lz4}
