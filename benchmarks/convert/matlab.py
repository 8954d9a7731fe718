"""Variables of MATLAB files: structs are dictionaries, cells are lists, texts str, numbers arrays of two axes.

SciPy is not used: damaged files crash its reader, and its writer takes six times as long for many obstacles."""
import struct
import zlib

import numpy as np

from improved_astar import Error

LARGEST = 64 << 20     # maximum bytes of a file and of its compressed content: a world of a million corners takes less
MOST_VALUES = 1000000  # maximum bytes of an array, which may take more memory than in a file
DEEPEST = 32           # maximum depth of nested values
HEADER = 128           # bytes
# Types of elements, by MATLAB's "MAT-File Format", level 5.
INT8, UINT8, INT32, UINT32, DOUBLES, MATRIX, COMPRESSED, UTF8, UTF16 = 1, 2, 5, 6, 9, 14, 15, 16, 17
NUMBERS = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 9: 'f8', 12: 'i8', 13: 'u8', UTF8: 'u1',
           17: 'u2', 18: 'u4'}
# Classes of arrays; those between the last two are numbers.
CELL, STRUCT, CHARACTERS, DOUBLE, BYTES, UINT64 = 1, 2, 4, 6, 9, 15
LOGICAL, COMPLEX = 0x200, 0x800  # flags beside the class
NAME_WIDTH = 32                  # bytes of the name of a field


def is_matlab(content):
    return content.startswith(b'MATLAB ')


def read(file, content, name):
    """The variable of this name. Raises Error for damaged files and for content that a case cannot have."""
    version = content[124:HEADER]
    if version in (b'\0\2IM', b'\2\0MI'):
        raise Error(f"{file}: a file of MATLAB 7.3 (HDF5); save it with save(..., '-v7')")
    if version not in (b'\0\1IM', b'\1\0MI'):
        raise Error(f"{file}: not a MATLAB 5 file (as written by save(..., '-v7') or '-v6')")
    try:
        found, left, order = None, LARGEST, '<' if version.endswith(b'IM') else '>'
        for kind, data in elements(content[HEADER:], order):  # to the end: the file must be complete
            if kind == COMPRESSED:
                data = inflated(data, left)
                left -= len(data)
                (kind, data), = elements(data, order)
            if kind != MATRIX:
                raise Error(f'data of type {kind} where a variable is expected')
            if found is None and name.encode() in [each for _, each in elements(data, order)][2:3]:
                found = value_of(data, order)
        if found is None:
            raise Error('there is no such variable')
        return found
    except Error as error:
        raise Error(f'{file}: {name} cannot be read: {error}') from None
    except Exception as error:  # parts that are missing or inconsistent
        raise Error(f'{file}: {name} cannot be read: the file is damaged: {error}') from None


def elements(data, order):
    """The elements in order: type and bytes of each."""
    found, place = [], 0
    while place < len(data):
        if len(data) - place < 8:
            raise Error(f'the file is damaged: {len(data) - place} bytes are left over')
        kind, size = struct.unpack_from(f'{order}II', data, place)
        place += 8
        if kind > 0xffff:  # up to four bytes within the tag
            kind, size, place = kind & 0xffff, kind >> 16, place - 4
        if size > len(data) - place:
            raise Error(f'the file is damaged: {size} bytes should follow, but {len(data) - place} do')
        found.append((kind, data[place:place + size]))
        place += size
        if kind != COMPRESSED:
            place += -place % 8
    return found


def inflated(data, most):
    stream = zlib.decompressobj()
    content = stream.decompress(data, most)
    if len(content) == most:
        raise Error(f'more than {LARGEST} bytes are compressed in the file')
    # The end is reached only if zlib's checksum of all compressed data is right.
    if not stream.eof or stream.unused_data:
        raise Error('the compressed data is damaged')
    return content


def value_of(data, order, depth=0):
    if not data:  # empty, like the fields of a struct
        return np.empty((0, 0))
    parts = elements(data, order)
    if depth > DEEPEST or len(parts) > MOST_VALUES:
        raise Error('it nests values deeper than a case, or contains more than a million')
    flags = int(np.frombuffer(parts[0][1], f'{order}u4')[0])
    rows, columns = map(int, np.frombuffer(parts[1][1], f'{order}i4'))
    kind = flags & 0xff
    if kind in (STRUCT, CELL):
        begin = 5 if kind == STRUCT else 3
        values = [value_of(each, order, depth + 1) for _, each in parts[begin:]]
        if kind == CELL:
            return require_count(values, rows * columns)
        width, = np.frombuffer(parts[3][1], f'{order}i4')
        names = [name.tobytes().rstrip(b'\0').decode('ascii', 'replace')
                 for name in np.frombuffer(parts[4][1], 'u1').reshape(-1, width)]
        return dict(zip(names, require_count(values, rows * columns * len(names))))  # the first of an array
    if flags & COMPLEX:
        raise Error('it contains complex numbers')
    numbers = np.frombuffer(parts[3][1], order + NUMBERS[parts[3][0]])
    if kind == CHARACTERS:
        return parts[3][1].decode('utf-8') if parts[3][0] == UTF8 else ''.join(map(chr, numbers))
    if not DOUBLE <= kind <= UINT64:
        raise Error(f'it contains a value of class {kind}, which is not part of a case')
    return require_count(numbers, rows * columns).astype(float).reshape(rows, columns, order='F')


def require_count(values, count):
    if len(values) != count:
        raise Error(f'the file is damaged: {len(values)} values where {count} are expected')
    return values


def content_of(name, value):
    """The bytes of a MATLAB 5 file with one variable."""
    packed = zlib.compress(matrix(value, name))
    return b'MATLAB 5.0 MAT-file'.ljust(HEADER - 4) + b'\0\1IM' + struct.pack('<II', COMPRESSED, len(packed)) + packed


def element(kind, data):
    return struct.pack('<II', kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(value, name=''):
    """The element of a value: a dictionary, a list (a row of cells), a text, a truth value, or numbers."""
    if isinstance(value, dict):
        flags, shape = STRUCT, (1, 1)
        names = b''.join(each.encode().ljust(NAME_WIDTH, b'\0') for each in value)
        content = struct.pack('<HHi', INT32, 4, NAME_WIDTH) + element(INT8, names) + b''.join(map(matrix, value.values()))
    elif isinstance(value, list):
        flags, shape, content = CELL, (1, len(value)), b''.join(map(matrix, value))
    elif isinstance(value, str):
        text = value.encode('utf-16-le')
        flags, shape, content = CHARACTERS, (min(1, len(text)), len(text) // 2), element(UTF16, text)
    elif isinstance(value, bool):
        flags, shape, content = BYTES | LOGICAL, (1, 1), element(UINT8, bytes([value]))
    else:
        numbers = np.atleast_2d(np.asarray(value, '<f8'))
        flags, shape, content = DOUBLE, numbers.shape, element(DOUBLES, numbers.tobytes('F'))
    head = element(UINT32, struct.pack('<II', flags, 0)) + element(INT32, struct.pack('<ii', *shape))
    return element(MATRIX, head + element(INT8, name.encode()) + content)
