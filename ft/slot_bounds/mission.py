"""What an image of a mission says of its model: how many edges, views and points of the hull it has, and of its look-up field."""
import struct

HEADER_WORDS, ENTRY_WORDS, TABLES_AT = 16, 5, 3
RAY_CELLS, EDGES, HULL, VIEWS, SYMMETRIES = 6, 10, 11, 14, 15  # fsw/mission/image_format.hpp
EMPTY, LIST_OFFSET_BITS = 0x80000000, 22


def tables(data):
    """Records, words a record and place of each table, by its id."""
    found = {}
    for i in range(struct.unpack_from('>I', data, 4 * TABLES_AT)[0]):
        kind, words, records, at, _ = struct.unpack_from('>5I', data, 4 * (HEADER_WORDS + ENTRY_WORDS * i))
        found[kind] = records, words, at
    return found


def longest_list(data, table):
    """Elements in the fullest cell."""
    records, words, at = table
    cells = struct.unpack_from(f'>{records * words}I', data, at)
    return max((cell >> LIST_OFFSET_BITS for cell in cells if not cell & EMPTY), default=0)


def names_of(path):
    data = path.read_bytes()
    found = tables(data)
    return {'edges': found[EDGES][0], 'hull': found[HULL][0], 'views': found[VIEWS][0], 'symmetries': found[SYMMETRIES][0],
            'list': longest_list(data, found[RAY_CELLS])}
