"""`./ballpit chart` and its program: bad input, files, stops at any moment, pictures and the page.

    python3 tests/test_chart.py BUILD_FOLDER
"""

import contextlib
import html.parser
import io
import json
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools" / "figures"), str(ROOT / "tools" / "chart")]

import gains
import page
import speed_chart
from refusal import assert_refused
from workbook import chart as chart_command
from workbook.errors import InputError

BUILD = Path(sys.argv.pop(1)) if len(sys.argv) > 1 else ROOT / "build" / "cpu-release"
PROGRAM = BUILD / "bin" / "ballpit_chart"

HEADER = ("scene,engine,method,curve,steps_a_frame,dt,passes,passes_name,label,error,tolerance,"
          "verdict,ms_a_second,ms_low,ms_high,real_time_factor,pair_visits_a_second,runs,on_front,"
          "on_front_of_visits,command\n")
TINY = """\
# chart: column
# error: deepest overlap / r
# held against: no overlap
# tolerance: 0.1
# simulated: 3 s
# balls: 10
# a machine, commit 1
""" + HEADER + """\
column,ballpit,warm,both,1,0.0166667,8,iterations,"dt 16.7 ms, 8 iterations",0.01,0.1,ok,10,9,12,100,5000,5,yes,no,./ballpit chart --scene column --method warm --steps 1 --passes 8
column,ballpit,warm,dt,0.5,0.0333333,8,iterations,"dt 33.3 ms, 8 iterations",0.2,0.1,ok,5,5,6,200,2500,5,yes,yes,./ballpit chart --scene column --method warm --steps 0.5 --passes 8
column,ballpit,warm,iterations,1,0.0166667,2,iterations,"dt 16.7 ms, 2 iterations",0.5,0.1,ok,8,8,8,125,1250,5,no,no,./ballpit chart --scene column --method warm --steps 1 --passes 2
column,ballpit,racy,both,1,0.0166667,2,iterations,"</script> & co",nan,0.1,not finite,nan,nan,nan,nan,900,0,no,no,./ballpit chart --scene column --method racy --steps 1 --passes 2
column,ballpit,coloured,both,1,0.0166667,2,iterations,"dt 16.7 ms, 2 iterations",0,0.1,ok,20,18,25,50,700,5,yes,yes,./ballpit chart --scene column --method coloured --steps 1 --passes 2
"""


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.file = self.folder / "chart_column.csv"
        self.file.write_text(TINY)


class Program(unittest.TestCase):
    def refuses(self, words, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            result = run(*([] if "--out" in arguments else ["--out", folder]), *arguments)
            assert_refused(self, result, words)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_unknown_scenes_methods_options_and_folders_are_refused(self):
        self.refuses(["error: scene 'pile'", "two_bodies, bounce"], "--scene", "pile")
        self.refuses(["error: method 'wram'", "racy, atomic"], "--scene", "666", "--method", "wram")
        self.refuses(["--device"], "--device", "abacus")
        self.refuses(["--steps"], "--steps", "0")
        self.refuses(["--out /no/such/folder: is not a folder"], "--out", "/no/such/folder")

    def test_a_chart_says_its_time_and_has_every_point_with_head_and_command(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("--quick", "--scene", "pocket", "--method", "warm", "--method", "jacobi",
                         "--out", folder, "--stamp", "a machine, commit 1\nthe command")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stderr.splitlines()[0], r"^14 points, about \d+ s on an idle")
            self.assertEqual(result.stdout.strip(), f"{folder}/chart_pocket.csv")
            self.assertEqual([f.name for f in Path(folder).iterdir()], ["chart_pocket.csv"])
            notes, rows = speed_chart.read(f"{folder}/chart_pocket.csv")
            self.assertEqual(notes[""], ["a machine, commit 1", "the command",
                                         "seed 1, cpu, quick"])
            self.assertEqual(len(rows), 14)
            self.assertEqual({row["verdict"] for row in rows if row["method"] == "jacobi"},
                             {"energy"})
            for row in rows:
                right = row["verdict"] == "ok"
                self.assertEqual(right, row["runs"] >= 3, row)
                self.assertEqual(right, row["real_time_factor"] is not None, row)
                if right:
                    self.assertLessEqual(row["ms_low"], row["ms_a_second"])
                    self.assertLessEqual(row["ms_a_second"], row["ms_high"])

    def test_the_command_of_a_point_repeats_it(self):
        words = "--scene pocket --method jacobi --steps 2 --passes 4".split()
        with tempfile.TemporaryDirectory() as folder:
            result = run(*words, "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("verdict            energy", result.stdout)
            self.assertNotIn("real-time factor", result.stdout)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_a_killed_run_goes_on_and_ends_with_the_rows_of_a_whole_one(self):
        for name, torn in (("few fields", lambda text: text + "column,ballpit,warm,dt,8"),
                           ("the last field", lambda text: text[:-5])):
            with self.subTest(torn=name), tempfile.TemporaryDirectory() as folder:
                self.kill_and_go_on(Path(folder), torn)

    def kill_and_go_on(self, folder, torn):
        """`torn` makes of the file that a killed run left one whose last line has no end."""
        words = ["--quick", "--scene", "column", "--method", "warm", "--method", "small-steps",
                 "--out", folder]
        child = subprocess.Popen([PROGRAM, *words], stderr=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL)
        part = folder / "chart.part"
        deadline = time.time() + 120
        while time.time() < deadline and child.poll() is None and \
                (not part.exists() or part.read_text().count("\n") < 4):
            time.sleep(0.01)
        child.kill()
        child.wait()
        self.assertEqual(child.returncode, -signal.SIGKILL, "it was done too early")
        part.write_text(torn(part.read_text()))
        result = run(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr.splitlines()[0], r"^goes on: \d+ points are there")
        self.assertEqual([f.name for f in folder.iterdir()], ["chart_column.csv"])
        rows = speed_chart.read(folder / "chart_column.csv")[1]
        self.assertEqual(len({(r["method"], r["steps_a_frame"], r["passes"]) for r in rows}), 14)
        self.assertEqual(len(rows), 14)
        for row in rows:
            self.assertRegex(row["command"], r" --passes \d+$")

    def test_the_docs_have_the_table_of_questions_as_the_program_prints_it(self):
        table = run("--questions").stdout
        self.assertIn("| `six_cubed` | rms overlap / r |", table)
        text = (ROOT / "docs" / "speed_and_accuracy.md").read_text()
        block = text.split("<!-- from: ballpit_chart --questions -->\n")[1]
        self.assertEqual(block.split("<!-- end -->")[0], table)


class Reading(InFolder):
    def test_rows_have_numbers_and_nothing_where_nothing_was_measured(self):
        notes, rows = speed_chart.read(self.file)
        self.assertEqual(notes["error"], "deepest overlap / r")
        self.assertEqual(notes[""], ["a machine, commit 1"])
        self.assertEqual(rows[1]["steps_a_frame"], 0.5)
        self.assertIsNone(rows[3]["error"])
        self.assertEqual(rows[4]["error"], 0)

    def test_files_that_are_no_charts_are_refused(self):
        for text in ("", "hello\nthere\n", TINY.split(HEADER)[0] + HEADER, TINY.replace("0.01", "x")):
            self.file.write_text(text)
            with self.assertRaisesRegex(speed_chart.ChartError, "not a chart's CSV"):
                speed_chart.read(self.file)

    def test_a_curve_follows_its_knob_and_the_usual_setting_is_part_of_each(self):
        rows = speed_chart.read(self.file)[1]
        curves = speed_chart.curves(rows, "warm")
        self.assertEqual([row["dt"] for row in curves["dt"]], [0.0333333, 0.0166667])
        self.assertEqual([row["passes"] for row in curves["iterations"]], [2, 8])
        self.assertEqual([list(c) for c in speed_chart.curves(rows, "racy").values()], [[]])

    def test_every_method_has_a_colour_and_a_marker_of_its_own(self):
        names = [*speed_chart.STYLES, "bullet", "ode", "third"]
        styles = speed_chart.methods([{"method": name} for name in names])
        self.assertEqual(len({marker for _, marker in styles.values()}), len(names))
        shapes = re.search(r"SHAPES = \{(.*?)\};", page.TEMPLATE.read_text(), re.S)[1]
        for _, marker in [*styles.values(), *speed_chart.SPARE]:
            self.assertIn(f'"{marker}":', shapes)

    def test_an_error_of_0_is_drawn_below_all_others(self):
        self.assertLess(speed_chart.floor_of(speed_chart.read(self.file)[1]), 0.01)


class Drawing(InFolder):
    def setUp(self):
        super().setUp()
        if chart_command.drawing_python() is None:
            self.skipTest("SKIPPED: no matplotlib: apt-get install python3-matplotlib")

    def draw(self):
        with contextlib.redirect_stderr(io.StringIO()):
            chart_command.draw(self.file)
        return self.file.with_suffix(".svg").read_text()

    def test_a_picture_has_axes_curves_tolerance_front_failures_and_machine(self):
        picture = self.draw()
        for words in ("real-time factor", "deepest overlap / r", "tolerance 0.1", "Pareto front",
                      "a machine, commit 1", "warm", "racy: 1 wrong", "not timed", "33.3 ms"):
            self.assertIn(words, picture)
        self.assertEqual(self.file.with_suffix(".png").read_bytes()[:4], b"\x89PNG")

    def test_the_same_numbers_give_the_same_picture(self):
        first = self.draw()
        self.assertNotIn("<dc:date>", first)
        self.assertEqual(self.draw(), first)

    def test_redraw_needs_no_measurement_and_refuses_what_is_no_chart(self):
        with contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(chart_command.redraw([str(self.file)]), 0)
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()),
                         ["chart.html", "chart_column.csv", "chart_column.png", "chart_column.svg",
                          "plan_gains.md"])
        with self.assertRaisesRegex(InputError, "nowhere.csv: cannot be read"):
            chart_command.redraw([str(self.folder / "nowhere.csv")])
        self.file.write_text("hello\n")
        with self.assertRaisesRegex(InputError, "not a chart's CSV"):
            chart_command.redraw([str(self.file)])


class Data(html.parser.HTMLParser):
    """The text of the script whose id is "data"."""

    def __init__(self, text):
        super().__init__()
        self.inside, self.text = False, ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.inside = ("id", "data") in attributes

    def handle_data(self, data):
        self.text += data if self.inside else ""

    def handle_endtag(self, tag):
        self.inside = False


class Page(InFolder):
    def test_the_page_holds_all_rows_with_their_commands(self):
        scenes = json.loads(Data(page.page([self.file])).text)
        self.assertEqual([scene["name"] for scene in scenes], ["column"])
        rows = scenes[0]["rows"]
        self.assertEqual(len(rows), 5)
        self.assertEqual(rows[3]["verdict"], "not finite")
        self.assertEqual(rows[3]["label"], "</script> & co")
        self.assertIsNone(rows[3]["error"])
        self.assertTrue(all(row["command"].startswith("./ballpit chart") for row in rows))
        self.assertEqual(set(scenes[0]["methods"]), {"warm", "racy", "coloured"})

    def test_the_page_needs_no_network(self):
        text = page.page([self.file])
        for word in ("http://", "https://", "src=", "@import", "url("):
            self.assertNotIn(word, text)

    def test_a_browser_can_read_the_script(self):
        script = page.page([self.file]).split("<script>\n")[1].split("</script>")[0]
        try:
            result = subprocess.run(["node", "--check", "-"], input=script, text=True,
                                    capture_output=True)
        except FileNotFoundError:
            self.skipTest("SKIPPED: no node")
        self.assertEqual(result.returncode, 0, result.stderr)


class Gains(InFolder):
    """The plan and the original loop, put into the tiny chart."""

    def put(self, *points):
        """Adds these points ("method, label, error, verdict, ms") to the chart."""
        lines = []
        for point in points:
            method, label, error, verdict, ms = point.split(", ")
            factor = "nan" if ms == "nan" else 1000 / float(ms)
            lines.append(f"column,ballpit,{method},dt,2,0.008,2,iterations,{label},{error},0.1,{verdict},"
                         f"{ms},{ms},{ms},{factor},100,5,yes,yes,command\n")
        self.file.write_text(TINY + "".join(lines))

    def row(self, *points):
        """The table's row of a chart with these points, without scene and tolerance."""
        self.put(*points)
        return gains.gain(self.file)[2:]

    def test_the_loop_is_asked_for_its_error_in_the_plans_time_and_its_time_at_the_plans_error(self):
        row = self.row("mass-split, original loop, 1.5, ok, 3", "mass-split, x, 1.2, ok, 7",
                       "mass-split, y, 0.02, ok, 50", "mass-split, z, 0.5, ok, 8.5",
                       "plan, plan, 0.03, ok, 8")
        self.assertEqual(row, ["1.5", "3", "0.03", "8", "1.2", "50", "8", "plan, 8 ms", "1.00"])

    def test_a_loop_that_is_never_so_fast_or_so_accurate_is_told_so(self):
        row = self.row("mass-split, original loop, 1.5, ok, 30", "plan, plan, 0.03, ok, 8")
        self.assertEqual(row[4:6], ["not so fast", "never"])

    def test_the_cheapest_is_within_the_tolerance_and_no_exhibit_and_no_failure(self):
        row = self.row("mass-split, original loop, nan, lost, nan", "atomic, a, 0.01, ok, 1",
                       "coloured, b, 0.01, energy, nan", "warm, c, 0.11, ok, 2",
                       "warm, d, 0.09, ok, 4", "plan, plan, 0.03, ok, 8")
        self.assertEqual(row[:2], ["lost", ""])
        self.assertEqual(row[6:], ["4", "warm, 8 ms", "2.00"])

    def test_a_plan_that_failed_is_told_and_a_chart_without_plan_or_loop_has_no_row(self):
        row = self.row("mass-split, original loop, 1.5, ok, 3", "plan, plan, 0.03, lost, nan")
        self.assertEqual(row[2:], ["lost"] + [""] * 6)
        for alone in ([], ["plan, plan, 0.03, ok, 8"], ["mass-split, original loop, 1.5, ok, 3"]):
            self.put(*alone)
            self.assertIsNone(gains.gain(self.file), alone)

    def test_the_docs_have_the_tables_of_their_charts(self):
        for folder in (ROOT / "docs/results", ROOT / "docs/results/h100"):
            self.assertEqual((folder / "plan_gains.md").read_text(),
                             gains.markdown(sorted(folder.glob("chart_*.csv"))))


if __name__ == "__main__":
    unittest.main()
