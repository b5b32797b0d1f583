"""gravity_fall's real window on a virtual display, driven by a synthetic mouse and keys.

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
import subprocess
import sys
import tempfile
import threading
import time
import unittest

GRAVITY_FALL = os.path.abspath(sys.argv[1])
# Mesa's GLX driver leaves a little memory behind when it is unloaded: no fault of ours.
os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0")
DISPLAY = None  # set by run_tests
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


def run_tests():
    """Runs the tests of the calling script on a display of their own."""
    global DISPLAY
    missing = [tool for tool in ("Xvfb", "xdotool", "import") if not shutil.which(tool)]
    if missing:
        print(f"SKIPPED: no {', no '.join(missing)}: install xvfb, xdotool and imagemagick")
        sys.exit()
    DISPLAY = VirtualDisplay()
    try:
        unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
    finally:
        DISPLAY.close()
