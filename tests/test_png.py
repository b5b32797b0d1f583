"""The PNG reader and the comparison of pictures, against pictures made by hand.

    python3 tests/test_png.py
"""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

from miniature import flat_png, png
from workbook.errors import ToolError
from workbook.png import decode, difference


class Pictures(unittest.TestCase):

    def test_every_filter_is_undone(self):
        above, row = [10, 35, 30, 40, 50, 60], [15, 22, 200, 47, 58, 61]
        left = [0, 0, 0, *row[:3]]
        # Paeth: up, up, up; then up of (15, 40, 10), corner of (22, 50, 35), left of (200, 60, 30).
        nearest = [10, 35, 30, 40, 35, 200]
        filtered = {0: row, 1: [(a - b) % 256 for a, b in zip(row, left)],
                    2: [(a - b) % 256 for a, b in zip(row, above)],
                    3: [(a - (b + c) // 2) % 256 for a, b, c in zip(row, left, above)],
                    4: [(a - b) % 256 for a, b in zip(row, nearest)]}
        for kind, stored in filtered.items():
            with self.subTest(filter=kind):
                picture = decode(png(2, 2, 3, [above, stored], [0, kind]))
                self.assertEqual(list(picture.samples), above + row)

    def test_gray_and_transparent_pictures(self):
        self.assertEqual(decode(png(2, 1, 1, [[7, 1]], [1])).samples, bytes([7, 8]))
        self.assertEqual(decode(png(1, 1, 4, [[1, 2, 3, 4]])).channels, 4)

    def test_a_damaged_file_is_an_error(self):
        good = flat_png(9)
        for bad in (b"", b"GIF", good[:-20], good[:50] + b"x" + good[51:]):
            with self.assertRaises(ToolError):
                decode(bad)
        with self.assertRaises(ToolError):
            decode(png(2, 1, 1, [[0, 0]], [5]))

    def test_exact_and_tolerant_comparison(self):
        now = decode(flat_png(100, 20))

        def against(*values):
            rows = [[100] * 60 for _ in range(20)]
            for k, value in enumerate(values):
                rows[k][0] = value
            return decode(png(20, 20, 3, rows))

        self.assertEqual(difference(now, decode(flat_png(102, 20)), exact=False), "")
        self.assertIn("mean", difference(now, decode(flat_png(103, 20)), exact=False))
        self.assertEqual(difference(now, against(255, 255, 255, 255), exact=False), "")  # 1 %
        self.assertIn("pixels off", difference(now, against(*[255] * 5), exact=False))
        self.assertIn("1 of 400 pixels", difference(now, against(101), exact=True))
        self.assertIn("sizes", difference(now, decode(flat_png(100)), exact=False))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
