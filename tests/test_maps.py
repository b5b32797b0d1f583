"""`./ballpit maps` and its programs: bad input, files, an interruption, how a map is drawn, and the
table of all metrics.

    python3 tests/test_maps.py BUILD_FOLDER
"""

import csv
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools" / "figures"))

import failure_map
from refusal import assert_refused

BUILD = Path(sys.argv.pop(1)) if len(sys.argv) > 1 else ROOT / "build" / "cpu-release"
PROGRAM = BUILD / "bin" / "ballpit_maps"
TABLE = BUILD / "bin" / "ballpit_table"

TINY = '''\
# map: tiny
# title: Does it hold?
# ok: it holds
# value: a value
# a machine, commit 1
kind,panel,x,y,verdict,value,label
axes,"racy, e = 1","radii in a step","balls",,,
cell,"racy, e = 1",1,2,ok,0.5,
cell,"racy, e = 1",10,2,energy,2,
cell,"racy, e = 1",1,4,not finite,nan,
cell,"racy, e = 1",10,4,lost,0,
line,"racy, e = 1",1,2,,,"a < b"
line,"racy, e = 1",10,4,,,"a < b"
line,"racy, e = 1",500,4,,,"a < b"
'''


def run(*arguments, program=PROGRAM):
    return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=120)


class Program(unittest.TestCase):
    def refuses(self, words, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            result = run(*([] if "--out" in arguments else ["--out", folder]), *arguments)
            assert_refused(self, result, words)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_an_unknown_map_is_refused_with_the_list(self):
        self.refuses(["error: map 'gass'", "known maps are gas, column, heavy"], "hub", "gass")

    def test_unknown_options_and_devices_are_refused(self):
        self.refuses(["--fine"], "--fine")
        self.refuses(["--device"], "--device", "abacus")

    def test_a_folder_that_is_none_is_refused(self):
        self.refuses(["--out /no/such/folder: is not a folder"], "hub", "--out", "/no/such/folder")

    def test_a_map_says_its_time_before_it_starts_and_names_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("penalty", "--coarse", "--out", folder, "--stamp", "commit 1")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("penalty: 4 cells, about 1 s", result.stderr.splitlines()[0])
            self.assertEqual(result.stdout.strip(), f"{folder}/map_penalty.csv")
            self.assertEqual([file.name for file in Path(folder).iterdir()], ["map_penalty.csv"])
            notes, panels = failure_map.read(f"{folder}/map_penalty.csv")
            self.assertEqual(notes[""], ["commit 1"])
            self.assertEqual(panels[0].cells[0.05, 1.0], "ok")
            self.assertEqual(panels[0].cells[0.5, 1.0], "energy")

    def test_the_docs_have_the_table_of_scenes_as_the_program_prints_it(self):
        table = run("--scenes").stdout
        self.assertIn("| `six_cubed` | 216 |", table)
        text = (ROOT / "docs" / "stability.md").read_text()
        block = text.split("<!-- from: ballpit_maps --scenes -->\n")[1].split("<!-- end -->")[0]
        self.assertEqual(block, table)

    def test_the_docs_show_every_map_that_there_is(self):
        text = (ROOT / "docs" / "stability.md").read_text()
        known = run("gass").stderr.split("known maps are ")[1].strip().split(", ")
        self.assertEqual(len(known), 8)
        for name in known:
            self.assertIn(f"(results/map_{name}.svg)", text)
            for ending in ("svg", "csv"):
                file = ROOT / "docs" / "results" / f"map_{name}.{ending}"
                self.assertTrue(file.exists(), file)
            drawn = failure_map.draw(ROOT / "docs" / "results" / f"map_{name}.csv")
            self.assertEqual(drawn, (ROOT / "docs" / "results" / f"map_{name}.svg").read_text())

    def test_an_interrupted_map_leaves_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            child = subprocess.Popen([PROGRAM, "gas", "--out", folder], stderr=subprocess.PIPE,
                                     text=True)
            child.stderr.readline()  # it has begun
            child.send_signal(signal.SIGINT)
            child.communicate(timeout=60)
            self.assertEqual(child.returncode, 130)
            self.assertEqual(list(Path(folder).iterdir()), [])


class Table(unittest.TestCase):
    def table(self, *arguments):
        """The lines of the head, and the rows as dictionaries by scene and method."""
        with tempfile.TemporaryDirectory() as folder:
            result = run(*arguments, "--out", folder, "--stamp", "a machine\ncommit 1",
                         program=TABLE)
            self.assertEqual(result.returncode, 0, result.stderr)
            path = Path(folder) / "stability_table_cpu"
            self.assertEqual(result.stdout.split(), [f"{path}.csv", f"{path}.md"])
            lines = path.with_suffix(".csv").read_text().splitlines()
            self.markdown = path.with_suffix(".md").read_text()
        head = [line for line in lines if line.startswith("#")]
        rows = list(csv.DictReader(lines[len(head):]))
        return head, {(row["scene"], row["method"]): row for row in rows}

    def test_a_row_has_what_its_scene_can_say_and_nothing_else(self):
        head, rows = self.table("pocket", "--methods", "coloured", "jacobi", "mass-split")
        self.assertEqual(head, ["# a machine", "# commit 1"])
        self.assertEqual(list(rows), [("pocket", "coloured"), ("pocket", "jacobi"),
                                      ("pocket", "mass-split")])
        good = rows["pocket", "coloured"]
        self.assertEqual((good["status"], good["balls"], good["same bits"]), ("ok", "4", "1"))
        self.assertEqual(good["repeat distance (m)"], "0")
        self.assertLess(float(good["error"]), 1e-6)
        self.assertEqual(float(good["within"]), 0.001)
        self.assertLess(float(good["momentum error"]), 1e-6)
        self.assertGreater(float(good["TIME: ms / simulated s"]), 0)
        # Two rounds, the longer of three contacts, in the only step of half a second.
        self.assertEqual(float(good["pair visits / simulated s"]), 12)
        for empty in ("T / Haff", "Maxwell distance", "packing", "floor load / weight"):
            self.assertEqual(good[empty], "")
        # Three times the energy: stopped there, and no time for what is wrong.
        bad = rows["pocket", "jacobi"]
        self.assertEqual((bad["status"], bad["TIME: ms / simulated s"]), ("energy", ""))
        self.assertAlmostEqual(float(bad["energy drift largest"]), 2, delta=0.01)
        self.assertLess(float(bad["simulated s"]), float(good["simulated s"]))
        self.assertEqual(rows["pocket", "mass-split"]["status"], "inaccurate")

    def test_what_stands_carries_its_weight_and_what_is_no_number_has_no_measures(self):
        _, rows = self.table("heavy_on_light", "not_finite", "--methods", "warm")
        standing = rows["heavy_on_light", "warm"]
        self.assertAlmostEqual(float(standing["floor load / weight"]), 1, delta=1e-3)
        self.assertLess(float(standing["velocity noise / (g dt)"]), 0.01)
        broken = rows["not_finite", "warm"]
        self.assertEqual(broken["status"], "not finite")
        for empty in ("error", "penetration rms / r", "same bits", "TIME: ms / simulated s"):
            self.assertEqual(broken[empty], "")

    def test_the_floor_load_is_that_of_the_last_second(self):
        # They bounce just before it, and then are in the air all the time.
        _, rows = self.table("bounce", "--methods", "coloured")
        self.assertEqual(rows["bounce", "coloured"]["simulated s"], "20")
        self.assertAlmostEqual(float(rows["bounce", "coloured"]["floor load / weight"]), 0,
                               delta=1e-3)

    def test_the_markdown_has_the_same_cells(self):
        _, rows = self.table("heavy_on_light", "--methods", "coloured")
        cells = [cell.strip() for cell in self.markdown.splitlines()[-1].strip("|").split("|")]
        self.assertEqual(cells, list(rows["heavy_on_light", "coloured"].values()))
        self.assertTrue(self.markdown.startswith("a machine\n\ncommit 1\n\n| scene | method |"))

    def test_unknown_scenes_methods_and_folders_are_refused(self):
        for word, arguments in (("error: scene 'gas': scenes with a row in the table are two_bodies",
                                 ["gas"]),
                                ("error: response 'jakobi': known", ["--methods", "jakobi"]),
                                ("--out /no/such/folder: is not a folder",
                                 ["pocket", "--out", "/no/such/folder"])):
            assert_refused(self, run(*arguments, program=TABLE), [word])

    def test_an_interrupted_table_leaves_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            child = subprocess.Popen([TABLE, "elastic_gas", "--out", folder],
                                     stderr=subprocess.PIPE, text=True)
            child.stderr.readline()  # it has begun
            child.send_signal(signal.SIGINT)
            child.communicate(timeout=60)
            self.assertEqual(child.returncode, 130)
            self.assertEqual(list(Path(folder).iterdir()), [])


class Drawing(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.file = Path(self.folder.name) / "tiny.csv"
        self.file.write_text(TINY)

    def tearDown(self):
        self.folder.cleanup()

    def test_a_picture_has_title_axes_machine_and_a_legend_of_what_occurs(self):
        picture = failure_map.draw(self.file)
        for words in ("Does it hold?", "ok: it holds", "racy, e = 1", "radii in a step", "balls",
                      "a machine, commit 1", "energy from nowhere", "line: a &lt; b"):
            self.assertIn(words, picture)
        self.assertNotIn(">too many pairs<", picture)

    def test_each_verdict_has_its_colour_and_its_letter(self):
        colours = [colour for colour, _, _ in failure_map.VERDICTS.values()]
        letters = [letter for _, letter, _ in failure_map.VERDICTS.values()]
        self.assertEqual(len(set(colours)), len(colours))
        self.assertEqual(len(set(letters)), len(letters))
        picture = failure_map.draw(self.file)
        for letter in "ENL":
            self.assertEqual(picture.count(f">{letter}</text>"), 2)  # legend and cell

    def test_values_lie_between_cells_by_their_ratio_and_outside_nowhere(self):
        self.assertEqual(failure_map.place(1, [1, 10, 100]), 0)
        self.assertAlmostEqual(failure_map.place(31.6227766, [1, 10, 100]), 1.5)
        self.assertAlmostEqual(failure_map.place(0.5, [0, 1, 2]), 0.5)
        self.assertIsNone(failure_map.place(1000, [1, 10, 100]))
        self.assertIsNone(failure_map.place(0.1, [1, 10, 100]))

    def test_a_line_ends_where_it_leaves_the_panel(self):
        picture = failure_map.draw(self.file)
        self.assertEqual(picture.count('stroke-width="5"'), 1)
        piece = picture.split('d="M')[1].split('"')[0]
        self.assertEqual(piece.count("L"), 1)


if __name__ == "__main__":
    unittest.main()
