"""The viewer in a real window: its recordings, all ways in which it ends, and slow steps.

    python3 tests/test_window_recording.py PATH/TO/gravity_fall
"""

import os
import shutil
import signal
import subprocess
import time

import window_driver
from window_driver import HEADER, PATIENCE, WindowTest, press_close_button, run_tests


class Recording(WindowTest):
    def probe(self, path):
        """Width, height and number of frames."""
        if not shutil.which("ffprobe"):
            self.skipTest("ffprobe is missing")
        return subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-of", "csv=p=0", "-show_entries",
             "stream=width,height,nb_read_frames", os.path.join(self.folder, path)],
            check=True, capture_output=True, text=True, timeout=PATIENCE).stdout.strip()

    def test_v_records_one_frame_a_step(self):
        window = self.open()
        window.pause()
        window.toggle("v", "recording")
        path, step = window.state["recording"], window.state["step"]
        self.assertEqual(path, "videos/gravity_fall_001.mp4")
        for k in range(1, 6):
            window.press("n", lambda state, k=k: state["step"] == step + k)
        window.toggle("v", "recording")
        self.assertEqual(self.probe(path), "480,270,5")
        window.press("Escape")
        code, output = window.end()
        self.assertEqual(code, 0)
        self.assertIn(f"saved {path}", output)

    def test_each_recording_has_a_file_of_its_own(self):
        window = self.open_still()
        for number in (1, 2):
            window.toggle("v", "recording")
            self.assertEqual(window.state["recording"], f"videos/gravity_fall_00{number}.mp4")
            step = window.state["step"]
            window.press("n", lambda state: state["step"] == step + 1)
            window.toggle("v", "recording")
        self.assertEqual(len(os.listdir(os.path.join(self.folder, "videos"))), 2)

    def test_a_recording_that_cannot_be_written_is_refused_and_the_window_goes_on(self):
        self.write("videos", "a file in the way")
        window = self.open()
        window.press("v")
        step = window.wait(lambda state: state["message"].startswith("not recorded"))["step"]
        window.wait(lambda state: state["step"] > step + 3)
        window.press("Escape")
        self.assertEqual(window.end()[0], 0)
        self.assertTrue(any("not recorded" in line for line in window.errors), window.errors)

    def test_closing_the_window_completes_the_recording(self):
        window = self.open()
        window.toggle("v", "recording")
        step = window.state["step"]
        window.wait(lambda state: state["step"] > step + 3)
        window.press("Escape")
        self.assertEqual(window.end()[0], 0)
        self.assertEqual(os.listdir(os.path.join(self.folder, "videos")), ["gravity_fall_001.mp4"])
        self.assertTrue(self.probe("videos/gravity_fall_001.mp4").startswith("480,270,"))

    def test_a_window_changes_nothing_in_the_recording_of_every_step(self):
        options = ["--frames", "20", "--ledger", "--width", "320", "--height", "180"]
        self.assertEqual(self.headless(*options, "--out", "alone.mp4").returncode, 0)
        window = self.open(*options[:3], "--out", "beside.mp4", width=320, height=180)
        window.toggle("w", "wireframe")
        self.assertEqual(window.end()[0], 0)
        both = [open(os.path.join(self.folder, name), "rb").read()
                for name in ("alone.mp4", "beside.mp4")]
        self.assertEqual(*both)


class Ends(WindowTest):
    def test_escape_and_the_close_button_end_with_a_summary_and_exit_code_0(self):
        for name, end in [("Esc", lambda window: window.press("Escape")),
                          ("close button", press_close_button)]:
            with self.subTest(name):
                window = self.open()
                window.wait(lambda state: state["step"] >= 3)
                end(window)
                code, output = window.end()
                self.assertEqual(code, 0, window.errors)
                self.assertIn("state hash", output)
                self.assertNotIn("stopped early", output)

    def test_a_window_taken_away_by_force_still_completes_the_video(self):
        for how in ("windowclose", "windowkill"):  # by another program; as if the display broke
            with self.subTest(how):
                window = self.open("--out", how + ".mp4")
                window.wait(lambda state: state["step"] >= 3)
                window.xdotool(how, window.id)
                code, output = window.end()
                self.assertEqual(code, 0, window.errors)
                self.assertIn("state hash", output)
                self.assertIn(how + ".mp4", os.listdir(self.folder))

    def test_ctrl_c_ends_the_window_and_completes_the_video(self):
        window = self.open("--out", "film.mp4")
        window.wait(lambda state: state["step"] >= 3)
        window.process.send_signal(signal.SIGINT)
        self.assertEqual(window.end()[0], 130)
        self.assertEqual(os.listdir(self.folder), ["film.mp4"])

    def test_after_the_frames_asked_for_the_window_closes_in_real_time_at_the_earliest(self):
        start = time.monotonic()
        window = self.open("--frames", "60")
        code, output = window.end()
        self.assertGreater(time.monotonic() - start, 59 / 60)
        self.assertEqual(code, 0)
        self.assertIn(self.hash_after(60), output)

    def test_a_body_that_is_not_finite_closes_the_window_and_saves_the_last_good_state(self):
        self.write("fast.csv", HEADER + "0,5,0,0,-3e38,0,0.5,1,0.5\n")
        window = self.start("--spheres", "fast.csv", "--dt", "1", "--gravity", "-3e38")
        self.assertEqual(window.end()[0], 3)
        self.assertIn("last_good_state.csv", os.listdir(self.folder))

    def test_an_opengl_that_is_too_old_is_named(self):
        result = self.headless("--view", DISPLAY=window_driver.DISPLAY.name, MESA_GL_VERSION_OVERRIDE="1.4")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\Aerror: .*OpenGL is 1\.4.*2\.1.*\n\Z")


class Threads(WindowTest):
    def test_the_window_answers_while_a_step_takes_long(self):
        window = self.open("--count", "5000", "--iterations", "1000", width=240, height=136,
                           OMP_NUM_THREADS="1")
        step = window.wait(lambda state: state["step"] >= 1)["step"]
        for _ in range(8):
            window.toggle("h", "keys")
        self.assertLess(window.state["step"] - step, 6)  # a window that waited would need 8
        window.press("Escape")
        self.assertEqual(window.end()[0], 0)


if __name__ == "__main__":
    run_tests()
