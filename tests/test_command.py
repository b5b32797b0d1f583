"""What a user with bad luck sees: every bad input gives one clear line, exit code 2, and no file.

    python3 tests/test_command.py PATH/TO/gravity_fall PATH/TO/ballpit_bench
"""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from refusal import assert_refused

GRAVITY_FALL, BENCH = (os.path.abspath(path) for path in sys.argv[1:3])
DUELS, LOOPS = (os.path.join(os.path.dirname(GRAVITY_FALL), f"{chapter}_reference")
                for chapter in ("11_stability", "12_speed_and_accuracy"))
HEADER = "x,y,z,vx,vy,vz,radius,mass,restitution\n"


class Folder(unittest.TestCase):
    """Each test runs in an empty folder."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="ballpit_test_")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_program(self, *arguments, program=GRAVITY_FALL, **environment):
        return subprocess.run([program, *arguments], cwd=self.folder, text=True, timeout=120,
                              capture_output=True, env={**os.environ, **environment})

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)

    def files(self):
        return sorted(os.listdir(self.folder))

    def refuses(self, words, *arguments, before=(), **options):
        """Refused with all `words`, and no file that was not there `before`."""
        assert_refused(self, self.run_program(*arguments, **options), words)
        self.assertEqual(self.files(), sorted(before))

    def has_graphics(self):
        result = self.run_program("--frames", "1", "--count", "1", "--png", "probe.png")
        if result.returncode == 0:
            os.remove(os.path.join(self.folder, "probe.png"))
        return result.returncode == 0


class Plans(Folder):
    def summary(self, *arguments):
        result = self.run_program("--json", "--device", "cpu", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_the_original_loop_keeps_its_hash(self):
        found = self.summary("--plan", "original")
        self.assertEqual(found["state_hash"], "9477c493691706c7")
        self.assertEqual(found["plan"], "mass-split, 2 passes, cells of 2 m")
        self.assertEqual(found["plan_readings"], 0)

    def test_a_plan_is_made_unless_settings_were_given(self):
        planned = self.summary("--frames", "130")
        self.assertIn("small-steps", planned["plan"])
        self.assertEqual(planned["plan_readings"], 2)
        given = self.summary("--frames", "2", "--response", "coloured")
        self.assertIn("coloured", given["plan"])
        self.assertEqual(given["plan_readings"], 0)

    def test_all_frames_last_as_long_as_the_scene_says(self):
        found = self.summary("--scene", "bullet", "--frames", "1", "--save", "end.csv")
        self.assertIn("4 steps a frame", found["plan"])
        self.assertEqual(found["steps"], 1)
        with open(os.path.join(self.folder, "end.csv")) as file:
            bullet = next(csv.DictReader(file))
        self.assertAlmostEqual(float(bullet["x"]), -4 + 1.5, delta=1e-5)  # three radii a frame


class BadOptions(Folder):
    def test_unknown_option_suggests_the_nearest(self):
        self.refuses(["--frmaes", "did you mean --frames?"], "--frmaes", "3")

    def test_values_outside_their_range(self):
        for option, value, word in [("--count", "0", "at least 1"), ("--count", "-5", "at least 1"),
                                    ("--frames", "0", "at least 1"), ("--dt", "0", "above 0"),
                                    ("--dt", "nan", "above 0"), ("--dt", "-1", "above 0"),
                                    ("--restitution", "1.5", "between 0"),
                                    ("--restitution", "-0.1", "between 0"),
                                    ("--gravity", "inf", "finite"), ("--cell-size", "0", "cell size"),
                                    ("--cell-size", "-2", "cell size"),
                                    ("--damping", "-1", "damping"), ("--damping", "nan", "damping"),
                                    ("--iterations", "0", "at least 1")]:
            with self.subTest(option=option, value=value):
                self.refuses([word], option, value)

    def test_a_chapter_with_scenes_names_those_that_it_has(self):
        self.refuses(["scene 'pillar'", "one of pocket, gas, column"], "--scene", "pillar",
                     program=DUELS)
        self.refuses(["shows one scene", "--scene"], "--png", "all.png", program=DUELS)
        self.refuses(["scene 'pillar'", "column", "deep_pile"], "--scene", "pillar", program=LOOPS)
        self.refuses(["'column'", "shows six_cubed"], "--scene", "column", "--png", "a.png",
                     program=LOOPS)

    def test_wrong_cameras_colours_and_stills(self):
        for words, *arguments in [
                (["--zoom", "above 0"], "--zoom", "0"), (["finite"], "--orbit", "inf"),
                (["--compression", "0 to 51"], "--compression", "52"),
                (["colour by 'hue'", "body, speed"], "--color", "hue"),
                (["scene 'snow'", "head_on"], "--scene", "snow"),
                (["--stills", "leave out"], "--stills", ".", "--out", "a.mp4"),
                (["nowhere"], "--stills", "nowhere")]:
            with self.subTest(arguments=arguments):
                self.refuses(words, *arguments)

    def test_not_a_number(self):
        self.refuses(["--count"], "--count", "many")

    def test_unknown_scene(self):
        self.refuses(["gravity_fal", "known scenes"], "--scene", "gravity_fal")

    def test_unknown_response_names_the_known_ones(self):
        self.refuses(["gauss", "mass-split", "small-steps", "penalty"], "--response", "gauss")

    def test_knob_that_the_response_does_not_have(self):
        self.refuses(["substeps 4", "coloured", "small-steps"],
                     "--response", "coloured", "--substeps", "4")

    def test_a_plan_and_what_it_would_choose_exclude_each_other(self):
        for option, value in [("--response", "coloured"), ("--substeps", "2"),
                              ("--cell-size", "2"), ("--broad-phase", "naive")]:
            with self.subTest(option=option):
                self.refuses(["--plan auto", option, "leave one"], "--plan", "auto", option, value)
        self.refuses(["--plan"], "--plan", "best")
        self.refuses(["--tolerance", "only --plan auto"], "--tolerance", "0.1",
                     "--plan", "original")
        self.refuses(["--tolerance", "above 0"], "--tolerance", "0")

    def test_a_tolerance_that_nothing_meets_names_the_best(self):
        self.refuses(["tolerance 1e-05", "best within reach", "pair visits"],
                     "--scene", "six_cubed_elastic", "--tolerance", "1e-5")
        plan = os.path.join(os.path.dirname(GRAVITY_FALL), "ballpit_plan")
        self.refuses(["best within reach"], "six_cubed_elastic", "--tolerance", "1e-5",
                     program=plan)
        self.refuses(["scene 'snow'", "known scenes"], "snow", program=plan)

    def test_restitution_that_springs_cannot_give(self):
        self.refuses(["restitution 0", "penalty", "small-steps"],
                     "--response", "penalty", "--restitution", "0")

    def test_cell_smaller_than_a_ball_names_the_right_size(self):
        self.refuses(["cell size 0.5", "at least"], "--cell-size", "0.5")

    def test_more_balls_than_memory(self):
        self.refuses(["2000000000", "GiB"], "--scene", "uniform", "--count", "2000000000")

    def test_unwritable_outputs(self):
        for option, name in [("--out", "nowhere/film.mp4"), ("--png", "nowhere/shot.png"),
                             ("--save", "nowhere/balls.csv")]:
            with self.subTest(option=option):
                self.refuses(["nowhere", "does not exist"], option, name, "--frames", "1")

    def test_unknown_container(self):
        if not self.has_graphics():
            self.skipTest("a build without graphics records nothing")
        self.refuses([".mp4"], "--out", "film.txt", "--frames", "1")

    def test_cuda_without_a_gpu(self):
        result = self.run_program("--device", "cuda", "--frames", "1", CUDA_VISIBLE_DEVICES="")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--device cpu", result.stderr)

    def test_no_opengl(self):
        self.refuses(["OpenGL" if self.has_graphics() else "no graphics"], "--png", "shot.png",
                     "--frames", "1", __EGL_VENDOR_LIBRARY_FILENAMES="/nowhere.json",
                     __EGL_VENDOR_LIBRARY_DIRS="/nowhere")

    def test_a_window_without_a_display(self):
        for display in ("", ":4711"):
            self.refuses([f"display '{display}'", "--out"] if self.has_graphics() else
                         ["no graphics"], "--view", DISPLAY=display)

    def test_bench_refuses_an_unknown_scene_and_device(self):
        self.refuses(["known scenes"], "--scenes", "lava", program=BENCH)
        self.refuses(["--device"], "--device", "tpu", program=BENCH)
        self.refuses(["nowhere"], "--csv", "nowhere/bench.csv", program=BENCH)


class BadSpheres(Folder):
    def test_each_fault_is_named_with_its_line(self):
        good = "0,5,0,0,0,0,0.5,1,0.5\n"
        for line, word in [("0,5,0,0,0,0,0.5\n", "fields"), ("0,nan,0,0,0,0,0.5,1,0.5\n", "position"),
                           ("0,5,0,inf,0,0,0.5,1,0.5\n", "velocity"),
                           ("0,5,0,0,0,0,-0.5,1,0.5\n", "radius"), ("0,5,0,0,0,0,0.5,0,0.5\n", "mass"),
                           ("0,5,0,0,0,0,0.5,-1,0.5\n", "mass"),
                           ("0,5,0,0,0,0,0.5,1,1.5\n", "restitution"),
                           ("0,five,0,0,0,0,0.5,1,0.5\n", "not a number")]:
            with self.subTest(line=line):
                self.write("balls.csv", HEADER + good + line)
                self.refuses(["balls.csv:3", word], "--spheres", "balls.csv", "--save", "end.csv",
                             before=["balls.csv"])

    def test_missing_and_empty_files(self):
        self.refuses(["nothing.csv", "cannot be read"], "--spheres", "nothing.csv")
        self.write("empty.csv", HEADER)
        self.refuses(["no balls"], "--spheres", "empty.csv", before=["empty.csv"])


class GoodRuns(Folder):
    def summary(self, *arguments):
        result = self.run_program(*arguments, "--json", "--device", "cpu")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_help(self):
        for program in (GRAVITY_FALL, BENCH):
            result = self.run_program("--help", program=program)
            self.assertEqual(result.returncode, 0)
            self.assertIn("--device", result.stdout)

    def test_save_and_go_on_loses_nothing(self):
        first = self.summary("--frames", "5", "--count", "50", "--save", "middle.csv")
        again = self.summary("--frames", "5", "--count", "50", "--save", "again.csv")
        self.assertEqual(first["state_hash"], again["state_hash"])
        self.assertEqual(first["lost"], 0)
        onward = self.summary("--frames", "5", "--spheres", "middle.csv")
        straight = self.summary("--frames", "10", "--count", "50")
        self.assertEqual(onward["state_hash"], straight["state_hash"])

    def test_not_finite_saves_the_last_good_state(self):
        self.write("fast.csv", HEADER + "0,5,0,0,-3e38,0,0.5,1,0.5\n")
        result = self.run_program("--spheres", "fast.csv", "--dt", "1", "--gravity", "-3e38",
                                  "--frames", "9")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("body 0", result.stderr)
        self.assertIn("last_good_state.csv", self.files())

    def test_ctrl_c_leaves_a_complete_file(self):
        if not self.has_graphics():
            self.skipTest("a build without graphics records nothing")
        process = subprocess.Popen([GRAVITY_FALL, "--out", "film.mp4", "--frames", "100000"],
                                   cwd=self.folder, stderr=subprocess.PIPE, stdout=subprocess.PIPE)
        deadline = time.time() + 60
        part = os.path.join(self.folder, "film.part.mp4")
        while time.time() < deadline and not os.path.exists(part):
            time.sleep(0.05)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn(b"stopped early", output)
        self.assertEqual(self.files(), ["film.mp4"])
        with open(os.path.join(self.folder, "film.mp4"), "rb") as file:
            self.assertIn(b"moov", file.read(200000))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
