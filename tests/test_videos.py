"""./ballpit videos: clips are made whole or not at all, and a stale one is found.

    python3 tests/test_videos.py
"""

import json
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))

from fake_tools import is_alive
from miniature import PROJECT, Miniature, flat_png
from workbook import videos
from workbook.png import Picture

# A "clip" is JSON: what it is, and how bright its frames are. The program's pictures are as bright
# as the file `state` says; the other fake takes them out of the clip again.
PROGRAM = """\
import json, os, pathlib, sys, time
sys.path.insert(0, {tests!r})
from miniature import flat_png
arguments = sys.argv[1:]
def after(option):
    return arguments[arguments.index(option) + 1] if option in arguments else None
state = json.loads(pathlib.Path({root!r}, "state").read_text())
pathlib.Path({root!r}, "seen").write_text(json.dumps(arguments))
pathlib.Path({root!r}, "pid").write_text(str(os.getpid()))
if state.get("hangs"):
    pathlib.Path(after("--out")).write_text("half a cl")
    time.sleep(60)
if after("--out"):
    facts = {{"codec": "h264", "width": 960, "height": 540, "frames": int(after("--frames")),
             "frames_per_second": 60.0, **state}}
    pathlib.Path(after("--out")).write_text(json.dumps(facts) + " " * state.get("padding", 0))
if after("--stills"):
    for name, value in zip(("first", "last"), state["ends"]):
        pathlib.Path(after("--stills"), name + ".png").write_bytes(flat_png(value))
"""

CLIP = """\
import json, pathlib, sys
sys.path.insert(0, {tests!r})
from miniature import flat_png
arguments = sys.argv[1:]
facts = json.loads(pathlib.Path(arguments[0]).read_text())
for k, word in enumerate(arguments):
    if word == "--frame":
        value = facts["ends"][0 if arguments[k + 1] == "0" else 1]
        pathlib.Path(arguments[k + 2]).write_bytes(flat_png(value))
    if word in ("--poster", "--sheet"):
        pathlib.Path(arguments[k + 1]).write_bytes(flat_png(facts["ends"][0], 5))
print(json.dumps(facts))
"""

RECIPES = {"02_beta": {"title": "It doubles", "alt": "Balls", "program": "02_beta_reference",
                       "arguments": "--orbit 5", "seconds": 2, "poster": 0.5},
           "other": {"title": "Another", "alt": "More", "program": "02_beta_reference",
                     "arguments": "", "seconds": 1, "poster": 0}}

OVERVIEW = "# Videos\n\n<!-- gen clips -->\n<!-- /gen -->\n"


class Clips(Miniature):

    def setUp(self):
        super().setUp()
        self.write("videos/recipes.json", json.dumps(RECIPES))
        self.write("videos/README.md", OVERVIEW)
        self.state()
        for name, text in (("02_beta_reference", PROGRAM), ("ballpit_clip", CLIP)):
            script = text.format(tests=str(PROJECT / "tests"), root=str(self.root))
            self.write(f"build/cpu-release/bin/{name}", f"#!{sys.executable}\n{script}")
            os.chmod(self.root / "build/cpu-release/bin" / name, 0o755)

    def state(self, **changes):
        self.write("state", json.dumps({"ends": [50, 200], **changes}))

    def files(self):
        return {path.name: path.read_bytes() for path in (self.root / "videos").iterdir()}

    def test_missing_clips_are_made_and_fresh_ones_kept(self):
        said = self.ballpit("videos")
        self.assertIn("2 made, 0 fresh already", said)
        self.assertEqual(set(self.files()), {"02_beta.mp4", "02_beta.png", "other.mp4", "other.png",
                                             "recipes.json", "README.md"})
        self.assertIn("(other.png)](other.mp4)", self.read("videos/README.md"))
        self.assertIn("0 made, 2 fresh already", self.ballpit("videos"))
        self.assertIn("1 made, 0 fresh already", self.ballpit("videos", "other"))
        self.assertIn("2 clips, all fresh", self.ballpit("videos", "--check"))
        self.assertEqual(os.listdir(self.root / "build"), ["cpu-release"])

    def test_the_program_gets_the_clips_length_and_its_own_arguments(self):
        self.ballpit("videos", "02_beta")
        self.ballpit("videos", "--check", "02_beta")
        seen = json.loads(self.read("seen"))
        for words in (["--frames", "120"], ["--orbit", "5"], ["--device", "cpu"]):
            at = seen.index(words[0])
            self.assertEqual(seen[at:at + 2], words)
        self.assertIn("--stills", seen)
        self.assertNotIn("--out", seen)

    def test_a_clip_whose_program_draws_something_else_is_stale(self):
        self.ballpit("videos")
        for ends, word in (([90, 200], "first"), ([50, 160], "last")):
            self.state(ends=ends)
            said = self.ballpit("videos", "--check", code=1)
            self.assertIn(f"no  02_beta: the {word} frame is stale", said)
        before = self.files()
        self.ballpit("videos", "--check", code=1)
        self.assertEqual(self.files(), before)
        self.assertIn("2 made", self.ballpit("videos"))
        self.ballpit("videos", "--check")

    def test_a_wrong_length_size_poster_or_file_is_found(self):
        self.ballpit("videos")
        whole = self.files()
        facts = json.loads(whole["other.mp4"])
        for name, content, words in [
                ("other.mp4", json.dumps({**facts, "frames": 59}), "frames 59, not 60"),
                ("other.mp4", json.dumps({**facts, "width": 480}), "width 480, not 960"),
                ("other.mp4", whole["other.mp4"] + b" " * 1_500_000, "1500000 at most"),
                ("other.mp4", b"{", "cannot be played"),
                ("other.png", flat_png(9, 5), "the poster is not of this clip"),
                ("third.mp4", b"x", "nothing makes videos/third.mp4"),
                ("README.md", OVERVIEW, "videos/README.md is stale")]:
            with self.subTest(words):
                self.write(f"videos/{name}", content)
                self.assertIn(words, self.ballpit("videos", "--check", code=1))
                os.remove(self.root / "videos" / name)
                if name in whole:
                    self.write(f"videos/{name}", whole[name])
        os.remove(self.root / "videos/other.png")
        self.assertIn("videos/other.png is missing", self.ballpit("videos", "--check", code=1))

    def test_what_demo_left_there_is_nobodys_fault(self):
        self.ballpit("videos")
        self.write("videos/gravity_fall.mp4", b"x")
        self.ballpit("videos", "--check")

    def test_unknown_names_and_contradictions_are_refused(self):
        self.refuses("videos", "betta", words=["no clip 'betta'", "02_beta, other"])
        self.refuses("videos", "--check", "--sheet", "x", words=["exclude each other"])
        self.assertFalse((self.root / "videos/other.mp4").exists())

    def test_an_incomplete_recipe_is_named(self):
        broken = {**RECIPES, "other": {"title": "Another"}}
        self.write("videos/recipes.json", json.dumps(broken))
        self.assertIn("'other': missing or unknown: alt", self.ballpit("videos", code=1))
        late = {**RECIPES, "other": {**RECIPES["other"], "poster": 1}}
        self.write("videos/recipes.json", json.dumps(late))
        self.assertIn("must lie within the clip", self.ballpit("videos", code=1))

    def test_a_clip_that_came_out_too_large_takes_no_ones_place(self):
        self.ballpit("videos")
        before = self.files()
        self.state(padding=1_500_000)
        self.assertIn("at most; change its recipe", self.ballpit("videos", "other", code=1))
        self.assertEqual(self.files(), before)

    def test_an_interrupted_run_leaves_no_half_file_and_no_child(self):
        self.ballpit("videos")
        before = self.files()
        self.state(hangs=True)
        os.remove(self.root / "pid")
        command = [sys.executable, self.root / "tools/ballpit.py", "videos", "other"]
        child = subprocess.Popen(command, cwd=self.root, stderr=subprocess.PIPE, text=True)
        while not (self.root / "pid").exists() or not self.read("pid"):
            time.sleep(0.02)
        child.send_signal(signal.SIGINT)
        errors = child.communicate(timeout=30)[1]
        self.assertEqual(child.returncode, 130, errors)
        self.assertEqual(self.files(), before)
        self.assertFalse(is_alive(self.read("pid")))
        self.assertEqual(os.listdir(self.root / "build"), ["cpu-release"])

    def test_sheets_are_taken_from_the_clips_as_they_are(self):
        self.ballpit("videos")
        self.ballpit("videos", "--sheet", "sheets", "other")
        self.assertEqual(os.listdir(self.root / "sheets"), ["other.png"])

    def test_a_lesson_embeds_a_poster_that_leads_to_the_clip(self):
        block = "<!-- gen clip{} -->\n<!-- /gen -->"
        self.write("chapters/01_alpha/README.md", "# 01\n\n" + block.format(" other") + "\n")
        self.ballpit("gen", "--text-only", "01")
        self.assertIn("[![More](../../videos/other.png)](../../videos/other.mp4)\n\n"
                      "*Another (1 s)*", self.read("chapters/01_alpha/README.md"))
        self.write("chapters/01_alpha/README.md", "# 01\n\n" + block.format("") + "\n")
        self.assertIn("no clip '01_alpha'", self.ballpit("gen", "01", code=1))


def stripes(shift=0, width=64, height=32, light=220, dark=40):
    """A picture with detail: stripes of eight pixels."""
    row = [value for x in range(width) for value in [light if (x + shift) // 8 % 2 else dark] * 3]
    return Picture(width, height, 3, bytes(row * height))


def smeared(picture, share):
    """As compression does it: each sample a little nearer to its right neighbour's."""
    samples = picture.samples
    mixed = [round((1 - share) * a + share * b) for a, b in zip(samples, samples[3:] + samples[:3])]
    return Picture(picture.width, picture.height, 3, bytes(mixed))


class Comparison(unittest.TestCase):

    def test_a_frame_that_compression_smeared_is_the_same_frame(self):
        for decoded in (stripes(), smeared(stripes(), 0.15)):
            self.assertEqual(videos.frame_difference(decoded, stripes()), "")

    def test_a_shifted_or_recoloured_frame_or_one_of_another_size_is_not(self):
        for decoded in (stripes(3), stripes(light=150), stripes(width=62)):
            self.assertNotEqual(videos.frame_difference(decoded, stripes()), "")

    def test_two_flat_frames_differ_by_their_colour(self):
        flat = [Picture(8, 8, 3, bytes([value] * 192)) for value in (50, 50, 60)]
        self.assertEqual(videos.frame_difference(flat[0], flat[1]), "")
        self.assertNotEqual(videos.frame_difference(flat[0], flat[2]), "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
