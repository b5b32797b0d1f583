"""Variants of a chapter's program: nothing stale is kept, and only what a change touches is compiled.

    python3 tests/test_variants.py
"""

import os
import sys
import unittest
from pathlib import Path
from unittest import mock

from fake_tools import PROJECT, Workbook

sys.path.insert(0, str(PROJECT / "tools"))
from workbook import variants  # noqa: E402

MUTANT = """mutant two_for_one
caught by value
-    return 1;
+    return {value};
"""

COMMANDS = """c++ -O3 -I/b/pieces/09 -o {dir}check.o -c check.cu
c++ -O3 -I/b/pieces/09 -o {dir}film.o -c film.cpp
: && c++ -O3 {dir}check.o {dir}film.o -o bin/{target} lib.a && :
"""
INCLUDED = """CMakeFiles/check_09_reference.dir/check.o: #deps 2, deps mtime 1 (VALID)
    /p/check.cu
    /p/solutions/09_video/encoder.h

CMakeFiles/check_09_reference.dir/film.o: #deps 2, deps mtime 1 ({state})
    /p/film.cpp
    /p/solutions/08_spheres/sphere.h
"""


class Kept(Workbook):
    def hunt(self, value):
        """The variant's program after `mutants 01`, and when it was made."""
        self.write("tests/checks/mutants_01.txt", MUTANT.format(value=value))
        self.assertEqual(self.ballpit("mutants", "01").returncode, 0)
        variant = self.root / "build/cpu-release/variants/01/mutant_two_for_one"
        piece = (variant / "pieces/01_first/first.cuh").read_text()
        self.assertIn(f"return {value};", piece)
        return (variant / "check_01").stat().st_mtime_ns

    def test_the_same_variant_is_compiled_once(self):
        self.assertEqual(self.hunt(2), self.hunt(2))

    def test_another_text_is_compiled(self):
        self.assertNotEqual(self.hunt(2), self.hunt(3))

    def test_after_a_change_of_the_reference_all_is_compiled(self):
        before = self.hunt(2)
        os.utime(self.root / "build/cpu-release/bin/check_01_reference")
        self.assertNotEqual(before, self.hunt(2))


class Untouched(unittest.TestCase):
    def commands(self, piece, state="VALID"):
        def ninja(tool, *arguments):
            target = arguments[0]
            return (INCLUDED.format(state=state) if tool == "deps" else
                    COMMANDS.format(target=target, dir=f"CMakeFiles/{target}.dir/"))

        for cached in (variants._untouched, variants._included, variants._commands):
            cached.cache_clear()
            self.addCleanup(cached.cache_clear)
        with mock.patch.object(variants, "_ninja", ninja), \
                mock.patch.object(variants, "folder", return_value=Path("/b")):
            return variants._commands_for(Path("/v"), "check_09", "09", {piece: "text"})

    def test_what_includes_no_changed_piece_is_linked_from_the_reference(self):
        self.assertEqual(self.commands("09_video/encoder.h"), [
            "c++ -Og -I/v/pieces -o /v/objects/check.o -c check.cu",
            ": && c++ -Og /v/objects/check.o CMakeFiles/check_09_reference.dir/film.o "
            "-o /v/check_09 lib.a && :"])

    def test_what_includes_a_changed_piece_is_compiled(self):
        compile_film = "c++ -Og -I/v/pieces -o /v/objects/film.o -c film.cpp"
        self.assertIn(compile_film, self.commands("08_spheres/sphere.h"))

    def test_what_ninja_does_not_know_for_sure_is_compiled(self):
        self.assertEqual(len(self.commands("09_video/encoder.h", state="STALE")), 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
