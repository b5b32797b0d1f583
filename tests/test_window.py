"""The viewer in a real window: what mouse and keys do to its picture.

    python3 tests/test_window.py PATH/TO/gravity_fall
"""

from window_driver import HEADER, WindowTest, run_tests

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


if __name__ == "__main__":
    run_tests()
