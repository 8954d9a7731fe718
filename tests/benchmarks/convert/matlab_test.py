"""Files of MATLAB: what is written is read again; what is damaged is refused, whatever the damage."""

import io
import os
import struct
import unittest
import zlib
from random import Random as random_numbers

import numpy as np
import scipy.io

import improved_astar as ia
from convert import commonparking, matlab

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'matlab_files')
NINE = (9, bytes(8))  # a double


def element(kind, data, order='<'):
    return struct.pack(order + 'II', kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(flags, rows, columns, *contents, order='<'):
    """An element with the variable v; contents are elements, or types and bytes of them."""
    head = (element(6, struct.pack(order + 'II', flags, 0), order) + element(5, struct.pack(order + 'II', rows, columns), order)
            + element(1, b'v', order))
    return element(14, head + b''.join(each if isinstance(each, bytes) else element(*each, order) for each in contents), order)


def file(*elements, order='<'):
    end = b'\0\1IM' if order == '<' else b'\1\0MI'
    return b'MATLAB 5.0 MAT-file'.ljust(124) + end + b''.join(elements)


def compressed(data):
    return struct.pack('<II', 15, len(data)) + data


def refusal(content):
    """The message with which a file is refused; empty when it is read."""
    try:
        matlab.read('a.mat', content, 'v')
    except ia.Error as error:
        assert str(error).startswith('a.mat: '), error
        return str(error)
    return ''


class MatlabTest(unittest.TestCase):
    def case(self):
        """A case that the project has written, and what it holds."""
        scenario = ia.Scenario.from_polygons([[(2, 2), (4, 2), (4, 4), (2, 4)], [(-5, -5), (-3, -5), (-4, -4)]],
                                             (0, 0, 0), (8, 1, -1.2))
        return commonparking.case_content(scenario, 'Case07.mat'), self.described(scenario)

    @staticmethod
    def described(scenario):
        return scenario.start, scenario.goals, [polygon.tolist() for polygon in scenario.polygons]

    def outcome(self, content):
        """What a case holds, or the message with which it is refused."""
        try:
            return self.described(commonparking.read_case('a.mat', content, None, None, None))
        except ia.Error as error:
            self.assertTrue(str(error).startswith('a.mat: '), error)
            return str(error)

    def test_reads_what_it_writes(self):
        value = {'row': np.array([[1.0, -2.5, 1e300]]), 'yes': True, 'text': 'a text', 'none': np.empty((0, 0)),
                 'list': [3.0, '']}
        read = matlab.read('a.mat', matlab.content_of('v', value), 'v')
        self.assertEqual(list(read), list(value))
        self.assertEqual(read['row'].tolist(), [[1.0, -2.5, 1e300]])
        self.assertEqual((read['yes'].tolist(), read['text'], read['none'].size), ([[1.0]], 'a text', 0))
        self.assertEqual((read['list'][0].tolist(), read['list'][1]), ([[3.0]], ''))
        self.assertIn('w cannot be read: there is no such variable', str(self.assert_error(matlab.content_of('v', value), 'w')))

    def assert_error(self, content, name):
        with self.assertRaises(ia.Error) as caught:
            matlab.read('a.mat', content, name)
        return caught.exception

    def test_reads_large_worlds(self):
        x, y = np.meshgrid(np.arange(100.0), 10.0 + np.arange(100.0))
        polygons = [np.add(corner, [(0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5)]) for corner in zip(x.flat, y.flat)]
        content = commonparking.case_content(ia.Scenario.from_polygons(polygons, (0, 0, 0), (2, 0, 0)), 'Case08.mat')
        self.assertEqual(len(self.outcome(content)[2]), 10000)

    def test_reads_what_the_format_allows(self):
        for expected, content in (
                # Whole numbers in the smallest type, and within their tag when they are few.
                ([[1, 255, 2]], file(matrix(6, 1, 3, struct.pack('<I', 3 << 16 | 2) + b'\1\xff\2\0'))),
                ([[1], [-1]], file(matrix(6, 2, 1, (1, b'\1\xff')))),
                ([[1, 3], [2, 4]], file(matrix(8, 2, 2, (1, b'\1\2\3\4')))),  # column by column
                # Another machine's order of bytes.
                ([[70000]], file(matrix(6, 1, 1, (5, struct.pack('>I', 70000)), order='>'), order='>')),
                # Other variables, of classes that are not read.
                ([[5]], file(element(14, element(6, struct.pack('<II', 17, 0)) + element(1, b'o')), matrix(6, 1, 1, (2, b'\5')))),
                ([[0]], file(compressed(zlib.compress(matrix(6, 1, 1, NINE)))))):
            self.assertEqual(matlab.read('a.mat', content, 'v').tolist(), expected)
        for text in ((17, 'aä'.encode('utf-16-le')), (16, 'aä'.encode())):
            self.assertEqual(matlab.read('a.mat', file(matrix(4, 1, 2, text)), 'v'), 'aä')

    def test_refuses_what_does_not_agree(self):
        deep = matrix(1, 0, 0)
        for _ in range(40):
            deep = matrix(1, 1, 1, deep)
        good = compressed(zlib.compress(matrix(6, 1, 1, NINE)))
        for content, part in (
                (file(matrix(6, 2, 1, NINE)), '1 values where 2 are expected'), (file(matrix(6, 1, 1, (8, b'x'))), 'damaged'),
                (file(matrix(6, 1, 0xffffffff, NINE)), 'damaged'), (file(matrix(6, 1, 1, (9, bytes(7)))), 'damaged'),
                (file(matrix(1, 0x400, 0x1000)), '0 values where 4194304 are expected'), (file(matrix(6, 1, 1)), 'damaged'),
                (file(matrix(6 | 0x800, 1, 1, NINE, NINE)), 'complex'), (file(matrix(5, 1, 1, NINE)), 'class 5'),
                (file(matrix(2, 1, 1, (5, bytes(4)), (1, b'x'))), 'damaged'),
                (file(struct.pack('<I', 5 << 16 | 14) + b'abcd'), '5 bytes should follow, but 4 do'),
                (file(struct.pack('<II', 14, 0xffffffff)), '4294967295 bytes should follow, but 0 do'),
                (file(compressed(b'abcd')), 'damaged'), (file(compressed(good[8:] + b'1234')), 'compressed data is damaged'),
                (file(compressed(good[8:-1] + bytes([good[-1] ^ 1]))), 'damaged'), (file(element(3, b'x')), 'type 3'),
                (file(compressed(zlib.compress(matrix(6, 1, 1, NINE) + bytes(4)))), 'damaged'), (file(deep), 'deeper'),
                (file(matrix(6, 1, 1, NINE)).replace(b'IM', b'MI'), 'not a MATLAB 5 file'),
                (file().replace(b'\0\1IM', b'\0\2IM'), "MATLAB 7.3 (HDF5); save it with save(..., '-v7')"), (b'MATLAB ', 'not a MATLAB 5')):
            with self.subTest(part=part, content=content[128:200]):
                self.assertIn(part, refusal(content))

    def test_refuses_what_takes_little_in_a_file_and_much_in_memory(self):
        bomb = matlab.content_of('v', np.zeros((65 << 20) // 8))
        self.assertLess(len(bomb), 1 << 20)
        self.assertIn('more than 67108864 bytes are compressed', refusal(bomb))
        half = matlab.content_of('v', np.zeros((33 << 20) // 8))
        self.assertEqual(refusal(half), '')
        self.assertIn('more than 67108864 bytes are compressed', refusal(half + half[matlab.HEADER:]))
        self.assertIn('more than a million', refusal(file(matrix(1, 1, 1000001, element(14, b'') * 1000001))))

    def test_every_truncation_is_an_error(self):
        good, held = self.case()
        self.assertEqual(self.outcome(good), held)
        for length in range(len(good)):
            self.assertIsInstance(self.outcome(good[:length]), str, length)

    def test_a_changed_byte_is_an_error_or_makes_no_difference(self):
        good, held = self.case()
        refused = 0
        for place in range(len(good)):
            for value in (0, 0x80, 0xff):
                outcome = self.outcome(good[:place] + bytes([value]) + good[place + 1:])
                refused += isinstance(outcome, str)
                self.assertTrue(isinstance(outcome, str) or outcome == held, place)
        # The header is text for people; what is compressed carries a sum.
        self.assertGreater(refused, 3 * (len(good) - matlab.HEADER) - 20)

    def test_files_that_crashed_readers_are_read_or_refused(self):
        refused = 0
        for name in sorted(os.listdir(FOLDER)):
            with open(os.path.join(FOLDER, name), 'rb') as stream:
                refused += isinstance(self.outcome(stream.read()), str)
        self.assertEqual(refused, 5)

    def test_whatever_is_changed_where_nothing_is_compressed(self):
        stream = io.BytesIO()
        scipy.io.savemat(stream, scipy.io.loadmat(os.path.join(FOLDER, 'case.mat')))
        plain, random = stream.getvalue(), random_numbers(1)
        for _ in range(5000):
            changed = bytearray(plain)
            for _ in range(random.randint(1, 3)):
                changed[random.randrange(matlab.HEADER, len(plain))] = random.choice([0, 1, 0x80, 0xff])
            self.outcome(bytes(changed))


if __name__ == '__main__':
    unittest.main(verbosity=2)
