"""What students read through the command, and how their work is kept.

    python3 tests/test_reading.py PATH/TO/BUILD
"""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

from miniature import Miniature

BUILD = Path(sys.argv[1])


class Reading(Miniature):
    def setUp(self):
        super().setUp()
        self.gen("--text-only")

    def solve(self, hole, code):
        """Fills a hole of the student's file."""
        self.replace("chapters/02_beta/beta.cuh", f'TODO_HOLE("{hole}");\n    return 0;', code)

    def say_correct(self):
        """As if ./ballpit check had found the present content right."""
        program = ("from workbook import chapters, record\nchapter = chapters.find('02')\n"
                   "record.remember(chapter, 'CORRECT', record.content_hash(chapter), 'CORRECT '"
                   f" + {str(self.root)!r} + ' /home/ada/x')")
        subprocess.run([sys.executable, "-c", program], check=True,
                       env={**os.environ, "PYTHONPATH": str(self.root / "tools")})


class Hints(Reading):
    def test_the_ladder_goes_up_only_with_more(self):
        first = self.ballpit("hint", "02", "beta.one")
        self.assertIn("1. What is 3, doubled?", first)
        self.assertNotIn("Add.", first)
        self.assertEqual(self.ballpit("hint", "02", "beta.one"), first)
        second = self.ballpit("hint", "02", "beta.one", "--more")
        self.assertIn("2. Add.", second)
        self.assertNotIn("Pseudocode", second)
        self.assertEqual(self.ballpit("hint", "02", "one"), second)
        third = self.ballpit("hint", "02", "beta.one", "--more")
        self.assertIn("the result is x, twice", third)
        self.assertIn("last hint", third)
        self.assertEqual(self.ballpit("hint", "02", "beta.one", "--more"), third)
        self.assertNotIn("Divide", self.ballpit("hint", "02", "beta.two"))

    def test_without_a_name_the_first_open_hole_is_meant(self):
        self.assertTrue(self.ballpit("hint", "02").startswith("beta.one"))
        self.solve("beta.one", '// TODO_HOLE("beta.one");\n    return 2 * x;')
        self.assertTrue(self.ballpit("hint", "02").startswith("beta.two"))
        self.solve("beta.two", "return x / 2;")
        said = self.ballpit("hint", "02")
        self.assertIn("Every hole of chapter 02 is filled", said)
        self.assertIn("beta.one, beta.two", said)

    def test_what_is_unknown_is_said_in_one_line(self):
        self.refuses("hint", "02", "beta.three", words=["'beta.three'", "beta.one, beta.two"])
        self.refuses("hint", "01", words=["no holes"])
        self.refuses("hint", "07", words=["unknown chapter"])
        os.remove(self.root / "chapters/02_beta/hints.md")
        self.refuses("hint", "02", words=["no hints"])

    def test_a_damaged_memory_starts_again(self):
        self.write("build/hints.json", "{")
        self.assertIn("1. What", self.ballpit("hint", "02"))


class Explanations(Reading):
    def test_explain_gives_claim_and_reason(self):
        said = self.ballpit("explain", "beta.right")
        for words in ("Doubles are right", "All rests on it.", "check 02 --case beta.right"):
            self.assertIn(words, said)

    def test_an_unknown_check_gets_the_nearest(self):
        self.assertIn("beta.right", self.ballpit("explain", "beta"))
        self.refuses("explain", "beta.rihgt", words=["'beta.rihgt'", "beta.right"])

    def test_diff_shows_files_pieces_and_main(self):
        said = self.ballpit("diff", "02")
        for words in ("after 01_alpha", "new piece beta.cuh: doubles and halves.",
                      "to write: beta.one, beta.two", "tests/checks/check_02.cu",
                      "--- chapters/01_alpha/main.cu", "-    return 1;", "+    return 2;"):
            self.assertIn(words, said)
        self.assertIn("first chapter", self.ballpit("diff", "01"))

    def test_the_solution_opens_with_a_correct_verdict_for_the_present_file(self):
        self.refuses("solution", "02", words=["CORRECT", "--spoil"])
        self.solve("beta.one", "return x << 1;")
        self.say_correct()
        said = self.ballpit("solution", "02")
        self.assertIn("return x << 1;", said)
        self.assertIn("int doubledValue", said)
        self.replace("chapters/02_beta/beta.cuh", "<< 1", "<< 2")
        self.refuses("solution", "02", words=["present"])
        self.assertIn("return x << 2;", self.ballpit("solution", "02", "--spoil"))

    def test_the_solution_fits_the_terminal(self):
        wide = self.ballpit("solution", "02", "--spoil", columns=90)
        row = next(line for line in wide.splitlines() if "doubledValue = 2" in line)
        self.assertIn('TODO_HOLE("beta.one");', row)
        for line in wide.splitlines():
            self.assertLessEqual(len(line), 90)
        narrow = self.ballpit("solution", "02", "--spoil", columns=40)
        self.assertIn("const int doubledValue = 2 * x;", narrow.splitlines())


class Restoring(Reading):
    def kept(self):
        copies = (self.root / "build/backup").glob("beta.cuh.*")
        return [file.read_bytes() for file in sorted(copies)]

    def test_reset_keeps_the_students_version(self):
        fresh = self.starter.read_bytes()
        self.solve("beta.one", "return x + x;  // caf\N{LATIN SMALL LETTER E WITH ACUTE}")
        mine = self.starter.read_bytes()
        said = self.ballpit("reset", "02")
        self.assertIn("kept your version: build/backup/beta.cuh.", said)
        self.assertEqual(self.starter.read_bytes(), fresh)
        self.assertEqual(self.kept(), [mine])
        self.assertIn("Nothing to do", self.ballpit("reset", "02"))
        self.assertEqual(len(self.kept()), 1)

    def test_reset_of_one_hole_leaves_all_else(self):
        self.solve("beta.one", "return x + x;\n    // more\n    // lines")
        self.solve("beta.two", "return x / 2;")
        self.write("chapters/02_beta/beta.cuh", self.starter.read_bytes() + b"// mine: \xff\r\n")
        mine = self.starter.read_bytes()
        self.ballpit("reset", "02", "beta.one")
        now = self.starter.read_bytes()
        self.assertEqual(now, mine.replace(b"return x + x;\n    // more\n    // lines",
                                           b'TODO_HOLE("beta.one");\n    return 0;'))
        self.assertEqual(self.kept(), [mine])
        self.assertIn("Nothing to do: beta.one", self.ballpit("reset", "02", "beta.one"))

    def test_two_resets_in_one_second_keep_both(self):
        for value in ("1", "2", "3"):
            self.solve("beta.one", f"return {value};")
            self.ballpit("reset", "02")
        self.assertEqual(len(self.kept()), 3)

    def test_a_missing_file_comes_back(self):
        fresh = self.starter.read_bytes()
        os.remove(self.starter)
        self.refuses("reset", "02", "beta.one", words=["missing"])
        self.ballpit("reset", "02")
        self.assertEqual(self.starter.read_bytes(), fresh)

    def test_a_broken_or_copied_frame_is_refused_and_nothing_changes(self):
        whole = self.read("chapters/02_beta/beta.cuh")
        frame = whole[whole.index("    // ---- hole beta.one"):whole.index("inline int two")]
        for text in (whole.replace("// ---- end of beta.one", ""), whole + frame,
                     whole.replace("// ---- hole beta.one", "// beta.one")):
            self.write("chapters/02_beta/beta.cuh", text)
            self.refuses("reset", "02", "beta.one", words=["frame", "reset the whole chapter"])
            self.assertEqual(self.read("chapters/02_beta/beta.cuh"), text)
        self.assertEqual(self.kept(), [])

    def test_bad_names_and_folders_are_one_line(self):
        self.refuses("reset", "02", "beta.three", words=["beta.three"])
        self.refuses("reset", "01", words=["nothing to reset"])
        self.solve("beta.one", "return 7;")
        mine = self.starter.read_bytes()
        self.write("build/backup", "a file where a folder should be")
        self.refuses("reset", "02", words=["build/backup", "cannot be written"])
        self.assertEqual(self.starter.read_bytes(), mine)


class Machine(Reading):
    def test_doctor_tells_ok_note_and_no(self):
        said = self.ballpit("doctor")
        self.assertRegex(said, r"(?m)^ok    Python +\d")
        self.assertIn("ok    OpenGL        soft", said)
        self.replace("build/cpu-release/bin/ballpit_doctor", '"OpenGL", "state": "ok"',
                     '"OpenGL", "state": "no"')
        self.assertIn("needs this first: OpenGL", self.ballpit("doctor", code=1))

    def test_a_probe_that_crashes_is_named(self):
        self.replace("build/cpu-release/bin/ballpit_doctor", "name, arguments =",
                     "import atexit\natexit.register(os.abort)\nname, arguments =")
        said = self.ballpit("doctor", code=1)
        self.assertIn("no    after OpenGL", said)

    def test_the_executable_reports_every_probe(self):
        printed = subprocess.run([BUILD / "bin/ballpit_doctor"], text=True, check=True,
                                 capture_output=True).stdout
        findings = [json.loads(line) for line in printed.splitlines()]
        names = [finding["name"] for finding in findings]
        self.assertEqual(names[:3], ["threads", "CUDA", "graphics"])
        for finding in findings:
            self.assertIn(finding["state"], ("ok", "note", "no"))
            self.assertTrue(finding["text"])

    def test_report_names_no_person_and_no_place(self):
        self.say_correct()
        said = self.ballpit("report")
        for words in ("version   0.1", "02 CORRECT", "last verdict:", "CORRECT . ~/x"):
            self.assertIn(words, said)
        for secret in (str(self.root), str(Path.home()) + "/", "ada"):
            self.assertNotIn(secret, said)
        self.solve("beta.one", "return 1;")
        self.assertIn("02 CORRECT (edited since)", self.ballpit("report"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
