#!/usr/bin/env python3
"""The style of the pictures: round ticks, dark colours, and keyframes that keep to the drive."""
import glob
import importlib.machinery
import importlib.util
import math
import os
import re
import sys
import unittest
from xml.etree import ElementTree

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def load(name, path):
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(ROOT, path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.modules[name] = module
    loader.exec_module(module)
    return module


style = load('picture_style', 'scripts/lib/picture_style.py')
pictures = load('pictures', 'scripts/pictures')


class PicturesTest(unittest.TestCase):
    def test_ticks_are_round_and_inside(self):
        self.assertEqual(style.round_ticks(0.0, 31.0, 8), [0, 5, 10, 15, 20, 25, 30])
        self.assertEqual(style.decade_ticks(2e-4, 1.0), [1e-3, 1e-2, 0.1, 1.0])
        for low, high in ((0.0, 7.7), (-3.0, 3.0), (0.013, 0.9), (120.0, 4031.0)):
            ticks = style.round_ticks(low, high, 6)
            step = ticks[1] - ticks[0]
            self.assertIn(round(step / 10.0 ** math.floor(math.log10(step) + 1e-9), 6), (1.0, 2.0, 5.0))
            self.assertTrue(low - 1e-9 <= ticks[0] < low + step and high - step < ticks[-1] <= high + 1e-9)
            self.assertLessEqual(len(ticks), 7)

    def test_every_picture_drawn_by_programs_has_dark_colours_for_all_of_its_own(self):
        for file in glob.glob(os.path.join(ROOT, 'docs', 'images', '**', '*.svg'), recursive=True):
            with self.subTest(os.path.relpath(file, ROOT)):
                with open(file, encoding='utf-8') as stream:
                    text = stream.read()
                ElementTree.fromstring(text)
                drawn = text.replace(style.dark_rules(), '')
                if drawn == text:
                    self.assertTrue('prefers-color-scheme' in text, 'no dark colours')
                    continue
                used = set(re.findall(r'(?:fill|stroke)="(#[0-9a-f]+)"', drawn))
                self.assertEqual(used - set(style.DARK), set())

    def test_keyframes_keep_to_the_drive(self):
        drive = [(0.1 * k, math.sin(0.05 * k), math.cos(0.03 * k), 0.02 * k if k < 100 else 2.0, 0.0) for k in range(200)]
        frames = pictures.keyframes(drive)
        self.assertEqual((frames[0], frames[-1]), (drive[0], drive[-1]))
        self.assertLess(len(frames), 60)
        for point in drive:
            after = next(k for k in range(1, len(frames)) if frames[k][0] >= point[0])
            a, b = frames[after - 1], frames[after]
            share = (point[0] - a[0]) / (b[0] - a[0])
            for k, error in ((1, pictures.KEYFRAME_ERROR[0]), (2, pictures.KEYFRAME_ERROR[0]), (3, pictures.KEYFRAME_ERROR[1])):
                self.assertLessEqual(abs(a[k] + share * (b[k] - a[k]) - point[k]), error + 1e-9)

    def test_moving_picture_is_small_enough_for_a_readme(self):
        self.assertLess(os.path.getsize(os.path.join(ROOT, 'docs', 'images', 'parking.svg')), 150000)


if __name__ == '__main__':
    unittest.main()
