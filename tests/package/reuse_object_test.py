#!/usr/bin/env python3
"""When reuse_object.py takes another build's object, and when it compiles.

usage: reuse_object_test.py CXX
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
CXX = 'c++'
MARK = b'the object of the other build'


class ReuseObjectTest(unittest.TestCase):
    """The other build's object is a text, which tells it from what a compiler makes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, content in (('one.h', b'#pragma once\n'), ('one.cpp', b'#include "one.h"\n'),
                              ('one.o.d', f'one.o: {self.path("one.cpp")} \\\n one.h\n'.encode())):
            self.write(name, content)
        self.write('commands.json', json.dumps([{
            'directory': self.folder, 'file': self.path('one.cpp'),
            'command': f'{CXX} -I{self.folder} -O1 -o one.o -c {self.path("one.cpp")}'}]).encode())
        self.write('one.o', MARK, age=0)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content, age=100):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'wb') as stream:
            stream.write(content)
        time = os.stat(self.path(name)).st_mtime - age
        os.utime(self.path(name), (time, time))

    def is_taken(self, *options, source='one.cpp'):
        command = [CXX, '-Done_EXPORTS', '-I' + self.folder, *options, '-MD', '-MT', 'new.o', '-MF', self.path('new.o.d'),
                   '-o', self.path('new.o'), '-c', self.path(source)]
        subprocess.run([sys.executable, '-B', os.path.join(HERE, 'reuse_object.py'), self.path('commands.json'), *command],
                       check=True)
        with open(self.path('new.o.d'), encoding='utf-8') as stream:
            dependencies = stream.read()
        self.assertTrue(dependencies.startswith('new.o:'), dependencies)
        self.assertIn('one.h', dependencies)
        with open(self.path('new.o'), 'rb') as stream:
            return stream.read() == MARK

    def test_the_same_command_takes_the_object(self):
        self.assertTrue(self.is_taken('-O1'))

    def test_other_options_compile(self):
        self.assertFalse(self.is_taken('-O2'))
        self.assertFalse(self.is_taken('-O1', '-DNDEBUG'))

    def test_an_object_that_is_older_than_a_header_is_not_taken(self):
        self.write('one.h', b'#pragma once\n', age=-100)
        self.assertFalse(self.is_taken('-O1'))

    def test_a_copy_of_the_source_takes_the_object_while_it_is_the_same(self):
        self.write('copy/one.cpp', b'#include "one.h"\n')
        self.assertTrue(self.is_taken('-O1', source='copy/one.cpp'))
        self.write('copy/one.cpp', b'#include "one.h"\nint one;\n')
        self.assertFalse(self.is_taken('-O1', source='copy/one.cpp'))


if __name__ == '__main__':
    CXX = sys.argv.pop(1)
    unittest.main()
