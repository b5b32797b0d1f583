"""The generator of lessons: what is stale is seen, what is wrong is named, nothing is lost.

    python3 tests/test_lessons.py PATH/TO/BUILD
"""

import re
import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

from miniature import PIECE, PROJECT, Miniature, flat_png
from workbook import blocks, lessons, markers
from workbook.chapters import Chapter
from workbook.errors import ToolError


class Markers(unittest.TestCase):
    def fails(self, words, text):
        with self.assertRaises(ToolError) as raised:
            markers.parse(text, "piece.cuh")
        for word in words:
            self.assertIn(word, str(raised.exception))

    def test_each_fault_is_named_with_its_line(self):
        hole = '//@hole a.b lines=1 "Task"\n//@starter TODO_HOLE("a.b");\n'
        self.fails(["piece.cuh:3", "inside another"], hole + hole)
        self.fails(["piece.cuh:4", "a.b stands here twice"], hole + "//@end\n" + hole)
        self.fails(["piece.cuh:3", "show-block inside"], hole + "//@show x\n")
        self.fails(["piece.cuh:2", "hole inside"], "//@show x\n" + hole)
        self.fails(["piece.cuh:1", "//@end without"], "//@end\n")
        self.fails(["piece.cuh:2", "a.b has no line"], '//@hole a.b lines=1 "Task"\n//@end\n')
        self.fails(["piece.cuh:1", "not a marker"], "//@hole a.b\n")
        self.fails(["piece.cuh:2", "without //@end"], hole)

    def test_starter_with_all_holes_filled_holds_the_solution(self):
        piece = markers.parse(PIECE, "piece.cuh")
        text = markers.starter(piece, solved={"beta.one", "beta.two"})
        frames = [line for line in text.splitlines(keepends=True)
                  if "// ---- " not in line and "hole.cuh" not in line]
        self.assertEqual("".join(frames), markers.plain(piece))
        self.assertNotIn("//@", markers.plain(piece))

    def test_one_hole_alone_is_open(self):
        piece = markers.parse(PIECE, "piece.cuh")
        found = markers.student_holes(markers.starter(piece, solved={"beta.one"}))
        self.assertEqual(found["beta.two"][1], piece.holes[1].starter)
        self.assertEqual(found["beta.one"][1], piece.holes[0].solution)


class Blocks(unittest.TestCase):
    def test_a_summary_shows_neither_time_nor_machine(self):
        printed = ("gravity_fall: 5 balls, 6 frames of 16.67 ms on cpu (AMD (TM), 2 threads)\n"
                   "  planning  5 times\n  time per frame  0.1 ms\n  state hash     12ab\n")
        with mock.patch.object(blocks.reference, "run", return_value=printed):
            lines = blocks.summary_block(Chapter(10, "10_full_system"), ["--device", "cpu"])
        self.assertEqual(lines, ["```console", "$ ./ballpit run 10 --device cpu",
                                 "gravity_fall: 5 balls, 6 frames of 16.67 ms",
                                 "  state hash     12ab", "```"])


class Generating(Miniature):
    def stale(self, *words, arguments=()):
        said = self.ballpit("gen", "--check", *arguments, code=1)
        for word in words:
            self.assertIn(word, said)

    def test_what_gen_makes_passes_its_check(self):
        self.gen()
        self.assertIn("fresh", self.ballpit("gen", "--check"))
        self.assertIn("0 files written", self.ballpit("gen"))

    def test_each_kind_of_block_is_filled_from_the_code(self):
        self.gen()
        lesson = self.read("chapters/02_beta/README.md")
        for words in ("| `beta.two` | 2 | Halved |",
                      "1. `beta.right`: Doubles are right\n2. `beta.order`: Any",
                      "```cpp\ninline int twice(int x) {\n    return x + x;\n}\n```",
                      "```console\n$ ./ballpit run 02 --count 3\nballs 3\nhash  0123\n```",
                      "| ![minus for plus](figures/bug_minus_for_plus.png) | a minus in place of a "
                      "plus | `beta.one`, `./ballpit explain beta.right` |"):
            self.assertIn(words, lesson)

    def test_a_csv_becomes_a_table(self):
        self.write("docs/results/speeds.csv", "# one machine\nscene,ms\nga|s,1.5\npile,12\n")
        self.replace("chapters/02_beta/README.md", "## Measure\n",
                     "## Measure\n<!-- gen csv speeds.csv -->\n<!-- /gen -->\n")
        self.gen()
        self.assertIn("| scene | ms |\n|---|--:|\n| ga\\|s | 1.5 |\n| pile | 12 |\n\n"
                      "<sub>one machine</sub>", self.read("chapters/02_beta/README.md"))

    def test_check_sees_whatever_is_stale_and_writes_nothing(self):
        self.gen()
        changes = [
            ("chapters/02_beta/beta.cuh", "int two", "int tow",
             ["beta.cuh is stale", "-inline int tow", "+inline int two"]),
            ("chapters/02_beta/README.md", "balls 3", "balls 5",
             ["'gen run --count 3'", "-balls 5", "+balls 3"]),
            ("chapters/02_beta/figures/dots.svg", 'cx="30"', 'cx="31"', ["dots.svg is stale"]),
            ("tests/checks/mutants_02.txt", " in place of a plus", "", ["'gen bugs' is stale"]),
            ("tools/figures/figures_02.py", '"view"', '"other"',
             ["other.png is missing", "view.png: nothing makes this picture"]),
        ]
        for name, old, new, words in changes:
            with self.subTest(file=name):
                before = self.read(name)
                self.replace(name, old, new)
                changed = self.read(name)
                self.stale(*words)
                self.assertEqual(self.read(name), changed)
                self.write(name, before)

    def test_pictures_are_compared_exactly_or_nearly(self):
        self.gen()
        figures = "chapters/02_beta/figures/"
        self.write(figures + "view.png", flat_png(201))
        self.assertIn("fresh", self.ballpit("gen", "--check"))
        self.write(figures + "view.png", flat_png(230))
        self.stale("view.png is stale: mean difference 30.00")
        self.write(figures + "bug_minus_for_plus.png", flat_png(11))
        self.stale("bug_minus_for_plus.png is stale: 100 of 100 pixels")
        self.assertIn("fresh", self.ballpit("gen", "--check", "--text-only"))

    def test_without_graphics_pictures_are_skipped_visibly(self):
        self.gen()
        self.replace("build/cpu-release/bin/ballpit_doctor", '"graphics", "state": "ok"',
                     '"graphics", "state": "no"')
        self.write("chapters/02_beta/figures/view.png", flat_png(230))
        self.assertIn("skipped: PNG pictures of chapter 02: this build has no graphics",
                      self.ballpit("gen", "--check"))

    def test_a_wrong_block_is_named_with_its_line(self):
        for old, new, words in [
                ("gen holes", "gen wholes", "unknown block 'wholes'"),
                ("gen checks", "gen checks beta.rihgt", "there is no check 'beta.rihgt'"),
                ("beta.cuh twice", "beta.cuh thrice", "no //@show thrice"),
                ("beta.cuh twice", "gamma.cuh twice", "no file solutions/02_beta/gamma.cuh"),
                ("gen run", "gen csv nothing.csv", "a file in docs/results"),
                ("<!-- /gen -->", "<!-- /gne -->", "a block inside the block"),
                ("<!-- gen bugs -->", "<!-- gen bugs", "not a block's comment")]:
            with self.subTest(words):
                before = self.read("chapters/02_beta/README.md")
                self.replace("chapters/02_beta/README.md", old, new)
                said = self.ballpit("gen", code=1)
                self.assertRegex(said, r"error: chapters/02_beta/README.md:\d+: .*" + words)
                self.assertEqual(len(said.splitlines()[-1:]), 1)
                self.write("chapters/02_beta/README.md", before)

    def test_a_students_file_is_kept_before_it_is_replaced(self):
        self.gen()
        self.replace("chapters/02_beta/beta.cuh", "return 0;", "return my_work;")
        self.assertIn("kept your version of chapters/02_beta/beta.cuh", self.ballpit("gen"))
        kept = list((self.root / "build/backup").iterdir())
        self.assertEqual(len(kept), 1)
        self.assertIn("my_work", kept[0].read_text())
        self.assertNotIn("my_work", self.starter.read_text())

    def test_a_failing_executable_or_figure_is_one_line(self):
        self.replace("tools/figures/figures_02.py", '["count"]', '["balls"]')
        self.assertIn("figures_02.py: figure 'dots': KeyError", self.ballpit("gen", code=1))
        self.write("build/cpu-release/bin/02_beta_reference", "#!/bin/sh\necho oh no >&2\nexit 3\n")
        self.assertIn("ended with exit code 3: oh no", self.ballpit("gen", code=1))


class Linting(Miniature):
    """One fault at a time is put into a lesson without faults."""

    def setUp(self):
        super().setUp()
        self.gen()

    def finds(self, words, name, *replacements):
        before = self.read(name)
        for old, new in replacements:
            self.replace(name, old, new)
        said = self.ballpit("gen", "--check", "--text-only", code=1)
        self.write(name, before)
        self.assertIn(words, said)
        self.assertIn("gen --check: 1 fault", said)

    def test_each_fault_of_a_lesson(self):
        lesson = "chapters/02_beta/README.md"
        for words, *replacements in [
                ("'Measure' is missing", ("## Measure\n", "")),
                ("'Files' belongs before 'Tasks'", ("## Files\n\nText.\n\n## Tasks", "## Tasks"),
                 ("## What you should", "## Files\n\n## What you should")),
                ("'Extras' is not one", ("## Measure\n", "## Measure\n\n## Extras\n")),
                ("'Reading' stands here twice", ("## Reading\n", "## Reading\n\n## Reading\n")),
                ("words outside code", (("word " * 20 + "\n") * 10, "")),
                ("words outside code", ("word " * 20, ("word " * 20 + "\n") * 40)),
                ("columns: 110 at most", ("Text.", "letters" * 16)),
                ("picture to figures/dost.svg", ("figures/dots.svg", "figures/dost.svg")),
                ("link to bete.cuh", ("](beta.cuh)", "](bete.cuh)")),
                ("no words for readers", ("![dots]", "![]")),
                ("no check or hole 'beta.rihgt'", ("`beta.right` and", "`beta.rihgt` and")),
                ("no check or hole 'bta.right'", ("Text.", "Type `./ballpit explain bta.right`."))]:
            with self.subTest(words):
                self.finds(words, lesson, *replacements)

    def test_a_hole_without_a_task(self):
        lesson = "chapters/02_beta/README.md"
        text = self.read(lesson)
        start, end = text.index("<!-- gen holes -->"), text.index("See `beta.right`")
        self.write(lesson, text[:start] + "- `beta.one`\n\n" + text[end:])
        said = self.ballpit("gen", "--check", "--text-only", code=1)
        self.assertIn("hole beta.two has no task in section Tasks", said)

    def test_each_fault_of_the_hints(self):
        hints = "chapters/02_beta/hints.md"
        self.finds("beta.two has 2 hints", hints, ("3. x over two\n", ""))
        self.finds("beta.one gives the code away", hints,
                   ("2. Add.", "2. const int doubledValue = 2 * x;"))
        self.finds("there is no hole 'beta.three'", hints,
                   ("## beta.two", "## beta.three\n\n## beta.two"))

    def test_what_is_no_fault(self):
        link, code, row = "x" * 120, "y" * 150, "z " * 70
        self.replace("chapters/02_beta/README.md", "Text.",
                     f"See [there](https://example.org/{link}) and `main.cu`, [above](#tasks).\n\n"
                     f"```\n{code}\n```\n\n| {row}|")
        self.assertIn("fresh", self.ballpit("gen", "--check", "--text-only"))

    def test_every_section_of_the_contract_is_known(self):
        contract = (PROJECT / "docs/authoring.md").read_text()
        named = re.search(r"Sections, in this order: (.*?)\. 600", contract, re.DOTALL)[1]
        self.assertEqual(named.replace("\n", " ").split(" · "), lessons.SECTIONS)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
