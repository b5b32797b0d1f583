"""./ballpit prove and mutants: they must fail when a starter or a check is not what it claims.

    python3 tests/test_proving.py
"""

import argparse
import contextlib
import gc
import io
import json
import sys
import unittest
from unittest import mock

from fake_tools import PROJECT, Workbook

sys.path.insert(0, str(PROJECT / "tools"))
from workbook import mutants, processes, proving  # noqa: E402
from workbook.chapters import Chapter  # noqa: E402
from workbook.errors import ToolError  # noqa: E402

CAUGHT = """# a comment
mutant two_for_one
caught by value
looks like a two in place
-    return 1;
+    return 2;
"""


class Results(unittest.TestCase):
    def test_after_the_last_result_other_programs_may_start(self):
        args = argparse.Namespace(chapters=["01"], json=False)
        chapter = Chapter(1, "01_first")
        with mock.patch.object(proving.checking, "find_checked", return_value=chapter), \
                mock.patch.object(proving, "build"), contextlib.redirect_stdout(io.StringIO()):
            code = proving.run_all(args, lambda chapter: [("good", lambda: "")])
        gc.collect()
        self.assertEqual(code, 0)
        self.assertEqual(processes.output_of([sys.executable, "-c", "print(7)"]), "7\n")


class Authors(Workbook):
    def lines(self, code, *arguments, **options):
        result = self.ballpit(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout.splitlines()

    def change_solution(self, old, new):
        path = self.root / "solutions/01_first/first.cuh"
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new))


class Proving(Authors):
    def test_good_chapters_are_proved(self):
        before = (self.root / "chapters/01_first/first.cuh").read_text()
        self.solve()
        lines = self.lines(0, "prove")
        self.assertEqual(lines[-1], "11 ok, 0 failed")
        self.assertEqual(lines[-2], "ok  10 the whole system from filled starters ends in the same "
                         "state")
        self.assertEqual(lines[:5], ["ok  01 the starter is TODO with all its holes",
                                     "ok  01 first.other alone is TODO",
                                     "ok  01 first.value alone is TODO",
                                     "ok  01 the starter with every hole filled is CORRECT",
                                     "ok  01 the solution is CORRECT"])
        self.assertNotEqual((self.root / "chapters/01_first/first.cuh").read_text(), before)

    def test_a_whole_system_that_ends_otherwise_is_found(self):
        # A finished file that still holds a TODO_HOLE outside any hole: no check of the fakes sees it.
        file = self.root / "solutions/02_second/second.cuh"
        file.write_text(file.read_text() + 'inline void more() { TODO_HOLE("second.more"); }\n')
        lines = self.lines(1, "prove")
        self.assertIn("no  10 the whole system from filled starters ends in the same state: the "
                      "hashes are ['of 1 open', 'of 0 open']", lines)

    def test_a_whole_system_without_a_state_is_no_success(self):
        lines = self.lines(1, "prove", FAKE_STATELESS="1")
        self.assertIn("no  10 the whole system from filled starters ends in the same state: the "
                      "hashes are [None, None]", lines)

    def test_a_hole_that_no_check_reaches_is_found(self):
        self.change_solution('//@starter TODO_HOLE("first.other");',
                             '//@starter // TODO_HOLE("first.other");')
        lines = self.lines(1, "prove", "1")
        self.assertEqual(lines[0], "no  01 the starter is TODO with all its holes: open are "
                                   "first.other, first.value, reported were first.value")
        self.assertEqual(lines[1], "no  01 first.other alone is TODO: open are first.other, "
                                   "reported were none")
        self.assertEqual(lines[-1], "3 ok, 2 failed")

    def test_a_hole_that_is_reported_although_it_is_filled_is_found(self):
        self.change_solution("return 2;", 'TODO_HOLE("first.other"); return 2;')
        self.assertEqual(self.lines(1, "prove", "1")[2], "no  01 first.value alone is TODO: open "
                         "are first.value, reported were first.other, first.value")

    def test_a_wrong_solution_is_found(self):
        self.change_solution("return 1;", "return 3;")
        lines = self.lines(1, "prove", "01")
        self.assertIn("no  01 the solution is CORRECT: WRONG: value", lines)

    def test_a_starter_that_crashes_is_found(self):
        crash = ("[('value', [{'event': 'hole', 'id': 'first.value'}, {'event': 'hole', 'id': "
                 "'first.other'}, lambda: os.abort()])]")
        line = self.lines(1, "prove", "01", scenario=crash)[0]
        self.assertIn("all its holes: crashed: value (cpu); it was aborted", line)

    def test_a_chapter_without_holes_needs_no_mutants(self):
        self.write("chapters/00_look/README.md", "# A chapter\n")
        self.write("chapters/00_look/look.cuh", "return 1;\n")
        self.write("solutions/00_look/look.cuh", "//@show all\nreturn 1;\n//@end\n")
        self.write("tests/checks/check_00.cu", "")
        self.assertEqual(self.lines(0, "prove", "0"), [
            "ok  00 the starter with every hole filled is CORRECT",
            "ok  00 the solution is CORRECT", "2 ok, 0 failed"])
        self.lines(0, "mutants", "0")

    def test_json(self):
        outcome = json.loads(self.lines(0, "prove", "2", "--json")[0])
        self.assertEqual((outcome["ok"], outcome["failed"]), (5, 0))


class Hunting(Authors):
    def hunt(self, text, code, *options):
        """The first line of `mutants 01` with these mutants."""
        self.write("tests/checks/mutants_01.txt", text)
        return self.lines(code, "mutants", "01", *options)[0]

    def test_a_mutant_is_caught_by_its_check_with_its_guess(self):
        self.assertEqual(self.hunt(CAUGHT, 0), "ok  01 two_for_one is caught by value")

    def test_a_wrong_check_state_or_guess_is_found(self):
        for old, new, words in [
                ("caught by value", "caught by other", "that check did not fail, but value"),
                ("two in place", "three in place", "no guess says 'a three in place'"),
                ("return 2", "return 1; //", "the verdict is CORRECT, not WRONG"),
                ("caught", "state RACY\ncaught", "the verdict is WRONG, not RACY"),
                ("caught", "picture\ncaught", "value drew no picture")]:
            with self.subTest(new=new):
                line = self.hunt(CAUGHT.replace(old, new), 1, "--keep-pictures", "pictures")
                self.assertTrue(line.startswith("no  01 two_for_one is caught by"), line)
                self.assertIn(words, line)

    def test_nothing_to_show_is_no_success(self):
        self.assertIn("no  01 has mutants: write tests/checks/mutants_01.txt",
                      self.lines(1, "mutants", "01"))
        for folder in ("01_first", "02_second"):
            (self.root / f"chapters/{folder}/README.md").unlink()
        for command in ("prove", "mutants"):
            self.refuses(["no chapter with pieces"], command, code=1)

    def test_lines_that_are_not_there_once_are_refused(self):
        for old, count in [("return 9;", 0), ("return 1;", 2)]:
            if count == 2:
                self.change_solution("return 2;", "return 1;")
            self.write("tests/checks/mutants_01.txt", CAUGHT.replace("return 1;", old))
            self.refuses([f"not {count} times", "mutants_01.txt:2"], "mutants", "01", code=1)

    def test_faults_in_the_file_are_named_with_their_line(self):
        for text, words in [("caught by a\n", "x:1: expected `mutant NAME`"),
                            ("mutant a\n+b\n", "x:2: a `+` line"),
                            ("mutant a\nnonsense\n", "x:2: not understood"),
                            ("mutant a\n-b\n+c\n", "x:1: mutant a needs"),
                            (CAUGHT + CAUGHT, "two mutants two_for_one")]:
            with self.subTest(text=text), self.assertRaises(ToolError) as caught:
                mutants.parse(text, "x")
            self.assertIn(words, str(caught.exception))

    def test_all_fields_are_read(self):
        mutant, = mutants.parse("mutant a\ncaught by c\nlooks like l\nstate RACY\npicture\n"
                                "-  one\n-\n+  two\n-three\n", "x")
        self.assertEqual(mutant.changes, [(["  one", ""], ["  two"]), (["three"], [])])
        self.assertEqual((mutant.caught_by, mutant.looks_like, mutant.state, mutant.picture),
                         ("c", "l", "RACY", True))
        self.assertEqual(mutant.removed, ["  one", "", "three"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
