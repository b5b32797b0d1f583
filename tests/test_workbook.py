"""./ballpit as a student meets it: whose pieces, progress, runs, wrong calls, Ctrl-C.

    python3 tests/test_workbook.py
"""

import json
import os
import signal
import subprocess
import sys
import time
import unittest

from fake_tools import HANG, Workbook, is_alive, scenario

class Mine(Workbook):
    def header(self, chapter, piece):
        return (self.root / f"build/cpu-release/pieces/{chapter}/{piece}").read_text()

    def test_only_the_chapters_own_piece_is_the_students(self):
        self.ballpit("check", "02")
        self.assertIn("/chapters/02_second/second.cuh", self.header("02", "02_second/second.cuh"))
        self.assertIn("/solutions/01_first/first.cuh", self.header("02", "01_first/first.cuh"))

    def test_mine_adds_chapters_and_touches_only_what_changes(self):
        self.ballpit("check", "02")
        path = self.root / "build/cpu-release/pieces/02/02_second/second.cuh"
        stamp = path.stat().st_mtime_ns
        for word in ("1", "all"):
            result = self.ballpit("check", "02", "--mine", word)
            self.assertIn("chapters/01_first/first.cuh, chapters/02_second/second.cuh",
                          result.stdout)
            self.assertIn("/chapters/01_first/first.cuh", self.header("02", "01_first/first.cuh"))
        self.assertEqual(path.stat().st_mtime_ns, stamp)
        self.refuses(["unknown chapter '7'"], "check", "02", "--mine", "7")

    def test_all_leaves_out_later_chapters(self):
        self.ballpit("check", "01", "--mine", "all")
        self.assertIn("/chapters/01_first/first.cuh", self.header("01", "01_first/first.cuh"))
        self.assertIn("/solutions/02_second/second.cuh", self.header("01", "02_second/second.cuh"))


class Progress(Workbook):
    def states(self):
        return json.loads(self.ballpit("status", "--json").stdout)

    def test_from_not_started_to_done_and_edited(self):
        self.assertEqual(self.states()["chapters"]["01_first"], "not started")
        self.ballpit("check", "01")
        self.assertEqual(self.states()["chapters"]["01_first"], "TODO")
        self.assertIn("./ballpit hint 01 first.value", self.states()["next"])
        piece = self.solve()
        self.assertEqual(self.states()["chapters"]["01_first"], "TODO, edited since")
        self.assertEqual(self.ballpit("check", "01").returncode, 0)
        self.assertEqual(self.states()["chapters"]["01_first"], "CORRECT")
        self.assertEqual(self.states()["done"], 1)
        self.assertIn("02", self.states()["next"])
        piece.write_text(piece.read_text() + "\n")
        self.assertEqual(self.states()["chapters"]["01_first"], "CORRECT, edited since")

    def test_a_part_of_the_checks_is_no_verdict(self):
        self.solve()
        for options in (["--case", "value"], ["--reference"], ["--mine", "2"], ["--device", "cpu"]):
            self.ballpit("check", "01", *options)
            self.assertEqual(self.states()["chapters"]["01_first"], "not checked yet", options)

    def test_the_table_is_what_no_command_shows(self):
        result = self.ballpit()
        self.assertIn("01_first                 not started (2 of 2 holes open)", result.stdout)
        self.assertIn("] 0 of 2 chapters done", result.stdout)
        self.assertIn("next: read chapters/01_first/README.md", result.stdout)
        self.assertFalse((self.root / "build").exists())


class Running(Workbook):
    def test_run_passes_options_on_and_knows_where_films_go(self):
        result = self.ballpit("run", "1", "--count", "5", "--video", "--png", "a.png",
                              "--reference")
        self.assertEqual(result.stdout.split(), [
            "program", "01_first_reference", "--count", "5", "--out",
            f"{self.root}/build/01_first.mp4", "--png", "a.png"])
        self.assertEqual(self.ballpit("run", "01", "--", "--help").stdout.split()[1:],
                         ["01_first", "--help"])

    def test_demo_and_bench_pass_everything_on(self):
        self.assertEqual(self.ballpit("demo", "--out", "a.mp4", "--cpu", "--help").stdout.split(),
                         ["program", "gravity_fall", "--out", "a.mp4", "--help"])
        self.assertEqual(self.ballpit("demo").stdout.split(),
                         ["program", "gravity_fall", "--out", f"{self.root}/videos/gravity_fall.mp4"])
        self.assertEqual(self.ballpit("demo", "--view").stdout.split(),
                         ["program", "gravity_fall", "--view"])
        self.assertEqual(self.ballpit("bench", "--counts", "10", "20").stdout.split(),
                         ["program", "ballpit_bench", "--counts", "10", "20"])

    def test_bench_of_a_chapter_wants_a_right_solution_first(self):
        result = self.ballpit("bench", "01")
        self.assertEqual(result.returncode, 10)
        self.assertNotIn("speed", result.stdout)
        self.solve()
        first, again = self.ballpit("bench", "01"), self.ballpit("bench", "01")
        self.assertIn("CORRECT", first.stdout)
        self.assertIn("speed: yours 3 ms", first.stdout)
        self.assertRegex(again.stdout, "^speed: yours 3 ms")


class BadCalls(Workbook):
    def test_unknown_names(self):
        self.refuses(["unknown command 'chekc'", "did you mean check?"], "chekc")
        self.refuses(["unknown command 'xyz'", "known are", "status"], "xyz")
        self.refuses(["unknown chapter '7'", "01_first, 02_second"], "check", "7")
        self.refuses(["unknown check 'vaule'", "value, other"], "check", "01", "--case", "vaule")
        self.refuses(["--sed"], "check", "01", "--sed", "3")
        self.refuses(["chapter"], "check")
        self.refuses(["--time-limit"], "check", "01", "--time-limit", "-1")

    def test_missing_things(self):
        self.refuses(["no CUDA code", "--device cpu"], "check", "01", "--device", "cuda")
        self.refuses(["nvcc"], "check", "01", "--cuda")
        self.refuses(["exclude"], "check", "01", "--cuda", "--cpu")
        (self.root / "fake/cmake").unlink()
        self.refuses(["cmake is missing"], "check", "01",
                     PATH=f"{self.root}/fake:{essentials(self.root)}")
        (self.root / "chapters/01_first/first.cuh").unlink()
        self.refuses(["first.cuh is missing", "reset 01"], "check", "01")

    def test_a_folder_that_cannot_be_written(self):
        self.write("build", "not a folder")
        self.refuses(["cannot be written", "copy the project"], "check", "01")
        self.assertEqual(self.ballpit("status").returncode, 0)
        self.assertEqual(self.ballpit("help").returncode, 0)

    def test_any_folder_is_a_place_to_call_it_from(self):
        result = self.ballpit("check", "01", cwd="/")
        self.assertEqual(result.returncode, 10, result.stderr)
        self.assertIn("TODO  chapters/01_first/first.cuh", result.stdout)

    def test_without_python_it_says_so(self):
        self.refuses(["python3 is missing"], "status", PATH=essentials(self.root))


class Interrupted(Workbook):
    def begin(self, *arguments, **environment):
        process = subprocess.Popen([self.root / "ballpit", *arguments, "--no-install"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=self.root,
                                   env={**self.environment, **environment})
        self.addCleanup(process.terminate)
        return process

    def interrupt(self, *arguments, pid_file, **environment):
        """Ctrl-C while a child runs: the child is gone. Returns the ended process."""
        process = self.begin(*arguments, **environment)
        pid_file = self.root / pid_file
        wait_until(lambda: pid_file.exists() and pid_file.read_text().strip())
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        process.out, process.err = process.communicate(timeout=15)  # the check would take 30
        self.assertFalse(is_alive(int(pid_file.read_text())))
        return process

    def test_a_check_and_a_build_end_with_130_and_nothing_is_lost(self):
        piece = self.solve()
        before = piece.read_text()
        hang = {"FAKE_SCENARIO": scenario(("a", HANG))}
        for command, environment in [("check", hang), ("prove", hang),
                                     ("check", {"FAKE_SLOW": str(self.root / "pid")})]:
            process = self.interrupt(command, "01", pid_file="pid", **environment)
            self.assertEqual((process.returncode, process.out), (130, ""), process.err)
            self.assertEqual(process.err.splitlines()[-1], "interrupted")
            self.assertNotIn("Traceback", process.err)
            (self.root / "pid").unlink()
        self.assertEqual(piece.read_text(), before)
        self.assertFalse((self.root / "build/verdicts.json").exists())

    def test_watch_checks_at_every_save_and_ends_politely(self):
        process = self.begin("watch", "01")
        verdicts = self.root / "build/verdicts.json"
        wait_until(lambda: verdicts.exists() and "TODO" in verdicts.read_text())
        self.solve()
        wait_until(lambda: "CORRECT" in verdicts.read_text())
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual((output.count("TODO  "), output.count("CORRECT  ")), (1, 1))
        self.assertIn("stopped watching", errors)


def wait_until(condition, seconds=30):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError("waited in vain")
        time.sleep(0.05)


def essentials(root):
    """A PATH with nothing but what `ballpit` itself calls."""
    folder = root / "essentials"
    folder.mkdir(exist_ok=True)
    for tool in ("sh", "dirname", "env", "ninja"):
        if not (folder / tool).exists():
            os.symlink(f"/usr/bin/{tool}" if tool != "sh" else "/bin/sh", folder / tool)
    return str(folder)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
