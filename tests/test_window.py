"""The viewer in a real window: synthetic mouse and keys on a virtual display, and what they must do.

    python3 tests/test_window.py PATH/TO/gravity_fall

Needs xvfb, xdotool and imagemagick, and says so where one is missing; installs nothing. Tests wait for
what the program reports (--report-state), never for a time, and compare pictures of the same run.
"""

import ctypes
import ctypes.util
import json
import os
import queue
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

GRAVITY_FALL = os.path.abspath(sys.argv[1])
# Mesa's GLX driver leaves a little memory behind when it is unloaded: no fault of ours.
os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0")
PATIENCE = float(os.environ.get("BALLPIT_TEST_PATIENCE", 60))  # s, for anything to happen on a busy machine
HEADER = "x,y,z,vx,vy,vz,radius,mass,restitution\n"


class VirtualDisplay:
    """An X server without a screen, on a number that was free."""

    def __init__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


class Picture:
    """What a window shows: rows of red, green, blue."""

    def __init__(self, ppm):
        match = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", ppm)
        self.width, self.height = int(match[1]), int(match[2])
        self.bytes = ppm[match.end():]

    def differing(self, other):
        """Column and row of each pixel that differs visibly."""
        assert (self.width, self.height) == (other.width, other.height)
        if self.bytes == other.bytes:
            return []
        pairs = zip(self.bytes[1::3], other.bytes[1::3])  # green tells enough
        return [(k % self.width, k // self.width) for k, (a, b) in enumerate(pairs) if abs(a - b) > 8]

    def difference(self, other):
        """The share of pixels that differ visibly."""
        return len(self.differing(other)) / (self.width * self.height)


class Window:
    """gravity_fall --view on the virtual display, and what it has reported so far."""

    def __init__(self, folder, *options, width=480, height=270, **environment):
        self.process = subprocess.Popen(
            [GRAVITY_FALL, "--view", "--report-state", "--device", "cpu", "--width", str(width),
             "--height", str(height), *options], cwd=folder, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={**os.environ, "DISPLAY": DISPLAY.name, **environment})
        self.id, self.state = None, None
        self.lines, self.other, self.errors = queue.Queue(), [], []
        self.readers = [threading.Thread(target=self.read_reports),
                        threading.Thread(target=lambda: self.errors.extend(self.process.stderr))]
        for reader in self.readers:
            reader.start()

    def await_opening(self):
        self.wait(lambda state: True)
        self.id = self.xdotool("search", "--sync", "--name", "^Ballpit: ").split()[-1]
        self.xdotool("windowfocus", "--sync", self.id)

    def read_reports(self):
        for line in self.process.stdout:
            if line.startswith("{"):
                self.lines.put(json.loads(line))
            else:
                self.other.append(line)
        self.lines.put(None)

    def wait(self, condition, what="the state"):
        """The first report from now on that satisfies the condition; the last one counts as well."""
        if self.state and condition(self.state):
            return self.state
        deadline = time.monotonic() + PATIENCE
        while True:
            try:
                state = self.lines.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                raise AssertionError(f"no such report of {what}; the last: {self.state}") from None
            if state is None:
                raise AssertionError(f"the program ended: {self.other} {self.errors}")
            self.state = state
            if condition(state):
                return state

    def settled(self):
        """The state once nothing more is reported for a while."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            try:
                self.state = self.lines.get(timeout=0.3)
            except queue.Empty:
                return self.state
        raise AssertionError(f"the window does not come to rest: {self.state}")

    @staticmethod
    def xdotool(*arguments):
        return subprocess.run(["xdotool", *arguments], check=True, text=True, timeout=PATIENCE,
                              stdout=subprocess.PIPE, env={**os.environ, "DISPLAY": DISPLAY.name}
                              ).stdout

    def press(self, key, condition=None):
        self.xdotool("key", key)
        return condition and self.wait(condition, f"key {key}")

    def toggle(self, key, field):
        """Presses a key that turns something on or off, and waits for that."""
        before = self.state[field]
        return self.press(key, lambda state: state[field] != before)

    def pause(self):
        return self.press("space", lambda state: state["paused"])

    def drag(self, button, right, down, condition):
        x, y = self.state["width"] // 2, self.state["height"] // 2
        self.xdotool("mousemove", "--window", self.id, str(x), str(y), "mousedown", str(button),
                     "mousemove", "--window", self.id, str(x + right), str(y + down),
                     "mouseup", str(button))
        return self.wait(condition, f"a drag with button {button}")

    def picture(self):
        """What the window shows, once it holds still."""
        last = None
        while True:
            shot = subprocess.run(["import", "-silent", "-window", self.id, "-depth", "8", "ppm:-"],
                                  check=True, timeout=PATIENCE, stdout=subprocess.PIPE,
                                  env={**os.environ, "DISPLAY": DISPLAY.name}).stdout
            if shot == last:
                return Picture(shot)
            last = shot

    def end(self):
        """Waits for the end. The exit code, and what was printed beside reports."""
        code = self.process.wait(timeout=PATIENCE)
        for reader in self.readers:
            reader.join()
        return code, "".join(self.other)

    def kill(self):
        self.process.kill()
        self.end()
        self.process.stdout.close()
        self.process.stderr.close()


def press_close_button(window):
    """What a window manager sends when its close button is pressed; none runs here."""
    x11 = ctypes.CDLL(ctypes.util.find_library("X11"))
    x11.XOpenDisplay.restype = x11.XInternAtom.restype = ctypes.c_ulong
    x11.XOpenDisplay.argtypes = [ctypes.c_char_p]
    x11.XInternAtom.argtypes = [ctypes.c_ulong, ctypes.c_char_p, ctypes.c_int]
    x11.XSendEvent.argtypes = [ctypes.c_ulong, ctypes.c_ulong, ctypes.c_int, ctypes.c_long,
                               ctypes.c_void_p]
    x11.XCloseDisplay.argtypes = [ctypes.c_ulong]

    class ClientMessage(ctypes.Structure):
        _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                    ("display", ctypes.c_ulong), ("window", ctypes.c_ulong),
                    ("message", ctypes.c_ulong), ("format", ctypes.c_int),
                    ("data", ctypes.c_long * 5), ("rest", ctypes.c_long * 12)]

    display = x11.XOpenDisplay(DISPLAY.name.encode())
    atom = lambda name: x11.XInternAtom(display, name, 0)
    client_message = 33
    event = ClientMessage(client_message, 0, 1, display, int(window.id), atom(b"WM_PROTOCOLS"), 32)
    event.data[0] = atom(b"WM_DELETE_WINDOW")
    x11.XSendEvent(display, int(window.id), 0, 0, ctypes.byref(event))
    x11.XCloseDisplay(display)


class WindowTest(unittest.TestCase):
    """Each test runs in an empty folder."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="ballpit_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def open(self, *options, **settings):
        window = self.start(*options, **settings)
        window.await_opening()
        return window

    def start(self, *options, **settings):
        """A window that need not stay open until it is found."""
        window = Window(self.folder, *options, **settings)
        self.addCleanup(window.kill)
        return window

    def open_still(self, *options, **settings):
        """A window that is paused and shows no figures, so that its picture holds still."""
        window = self.open(*options, **settings)
        window.pause()
        window.toggle("l", "ledger")
        return window

    def headless(self, *options, **environment):
        return subprocess.run([GRAVITY_FALL, "--device", "cpu", *options], cwd=self.folder,
                              text=True, capture_output=True, timeout=PATIENCE,
                              env={**os.environ, **environment})

    def hash_after(self, steps, *options):
        result = self.headless("--frames", str(steps), "--json", *options)
        return json.loads(result.stdout)["state_hash"]

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)


CAMERA = ("yaw", "pitch", "distance", "target")


def camera(state):
    return [state[key] for key in CAMERA]


class OneBall(WindowTest):
    """A large ball that hovers in the middle of the world."""

    def open_on_ball(self):
        self.write("ball.csv", HEADER + "0,20,0,0,0,0,6,1,0\n")
        return self.open_still("--spheres", "ball.csv", "--gravity", "0", "--cell-size", "12")

    def ball_pixels(self, window):
        """Where the picture changes with the ball's colour."""
        pictures = []
        for color in ("speed", "body"):
            while window.state["color"] != color:
                window.toggle("c", "color")
            pictures.append(window.picture())
        return pictures[0].differing(pictures[1])

    def ball_box(self, window):
        """Middle and size of what the ball covers: x, y, width, height."""
        columns, rows = zip(*self.ball_pixels(window))
        (left, right), (top, bottom) = (min(columns), max(columns)), (min(rows), max(rows))
        return (left + right) / 2, (top + bottom) / 2, right - left + 1, bottom - top + 1

    def test_pan_moves_the_picture_with_the_mouse(self):
        window = self.open_on_ball()
        x, y, *_ = self.ball_box(window)
        window.drag(2, 60, -30, lambda state: True)
        window.settled()
        new_x, new_y, *_ = self.ball_box(window)
        self.assertAlmostEqual(new_x - x, 60, delta=6)
        self.assertAlmostEqual(new_y - y, -30, delta=6)

    def test_w_leaves_only_lines_of_the_ball(self):
        window = self.open_on_ball()
        solid = self.ball_pixels(window)
        window.toggle("w", "wireframe")
        self.assertLess(len(self.ball_pixels(window)), 0.8 * len(solid))
        window.toggle("w", "wireframe")
        self.assertEqual(self.ball_pixels(window), solid)

    def test_a_ball_stays_round_in_a_window_of_any_shape(self):
        window = self.open_on_ball()
        for width, height in [(480, 270), (300, 300), (240, 500), (700, 200)]:
            with self.subTest(size=(width, height)):
                window.xdotool("windowsize", window.id, str(width), str(height))
                window.wait(lambda state: (state["width"], state["height"]) == (width, height))
                x, y, across, along = self.ball_box(window)
                self.assertAlmostEqual(x / width, 0.5, delta=0.1)
                self.assertAlmostEqual(y / height, 0.5, delta=0.15)
                self.assertGreater(along, 20)
                self.assertAlmostEqual(across / along, 1.0, delta=0.06)


class Mouse(WindowTest):
    def test_orbit_zoom_and_pan_move_the_camera_and_r_brings_it_back(self):
        window = self.open_still()
        first, shown_first = dict(window.state), window.picture()
        moved = lambda *keys: lambda state: all(state[key] != first[key] for key in keys)
        back = lambda state: camera(state) == camera(first)
        for what, act, changes in [
                ("orbit", lambda: window.drag(1, 60, 30, moved("yaw", "pitch")), ("yaw", "pitch")),
                ("zoom", lambda: window.xdotool("click", "4"), ("distance",)),
                ("pan", lambda: window.drag(2, 40, 25, moved("target")), ("target",))]:
            with self.subTest(what):
                act()
                window.wait(moved(*changes), what)
                state = window.settled()
                self.assertEqual([key for key in CAMERA if state[key] != first[key]],
                                 list(changes))
                self.assertGreater(window.picture().difference(shown_first), 0.02)
                window.press("r", back)
                self.assertEqual(window.picture().difference(shown_first), 0.0)

    def test_the_wheel_goes_nearer_when_turned_forwards_and_back_as_far(self):
        window = self.open_still()
        first = window.state["distance"]
        window.xdotool("mousemove", "--window", window.id, "200", "100", "click", "4")
        window.wait(lambda state: state["distance"] < first)
        window.xdotool("click", "5")
        window.wait(lambda state: abs(state["distance"] - first) < 1e-3)


class Keys(WindowTest):
    def test_space_stops_and_goes_on(self):
        window = self.open()
        state = window.pause()
        step, state_hash = state["step"], state["hash"]
        self.assertEqual(state_hash, self.hash_after(step) if step else state_hash)
        for _ in range(5):  # the window goes on drawing
            window.toggle("g", "grid")
            self.assertEqual((window.state["step"], window.state["hash"]), (step, state_hash))
        window.press("space", lambda state: not state["paused"] and state["step"] > step)

    def test_n_makes_one_step_and_pauses(self):
        window = self.open()
        step = window.press("n", lambda state: state["paused"])["step"]
        step = window.settled()["step"]
        for k in range(1, 4):
            window.press("n", lambda state, k=k: state["step"] == step + k)
            self.assertEqual(window.settled()["step"], step + k)
        self.assertTrue(window.state["paused"])
        self.assertEqual(window.state["hash"], self.hash_after(step + 3))

    def test_g_h_and_l_change_the_picture_and_change_it_back(self):
        window = self.open_still()
        first = window.picture()
        for key, field, at_least in [("g", "grid", 0.002), ("h", "keys", 0.1), ("l", "ledger", 0.1)]:
            with self.subTest(key):
                window.toggle(key, field)
                self.assertGreater(window.picture().difference(first), at_least)
                window.toggle(key, field)
                self.assertEqual(window.picture().difference(first), 0.0)

    def test_the_window_begins_with_the_colouring_of_the_command_line(self):
        self.open("--color", "cell").wait(lambda state: state["color"] == "cell")

    def test_c_goes_through_all_colourings_and_comes_back(self):
        window = self.open_still()
        first, seen = window.picture(), [window.state["color"]]
        for _ in range(4):
            before = window.picture()
            seen.append(window.toggle("c", "color")["color"])
            self.assertGreater(window.picture().difference(before), 0.002, seen)
        self.assertEqual(seen, ["body", "speed", "contacts", "cell", "memory"])
        window.toggle("c", "color")
        self.assertEqual(window.state["color"], "body")
        window.settled()
        self.assertEqual(window.picture().difference(first), 0.0)


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
        result = self.headless("--view", DISPLAY=DISPLAY.name, MESA_GL_VERSION_OVERRIDE="1.4")
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
    missing = [tool for tool in ("Xvfb", "xdotool", "import") if not shutil.which(tool)]
    if missing:
        print(f"SKIPPED: no {', no '.join(missing)}: install xvfb, xdotool and imagemagick")
        sys.exit()
    DISPLAY = VirtualDisplay()
    try:
        unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
    finally:
        DISPLAY.close()
