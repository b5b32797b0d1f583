"""A miniature of the project for the tests of ./ballpit: two tiny chapters, and executables that
are Python scripts, so that nothing is compiled."""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]

PIECE = """\
// Chapter 02: doubles and halves.
#pragma once
//@starter #include "common/hole.cuh"

//@show twice
inline int twice(int x) {
    return x + x;
}
//@end

inline int one(int x) {
    //@hole beta.one lines=1 "Doubled"
    //@starter TODO_HOLE("beta.one");
    //@starter return 0;
    const int doubledValue = 2 * x;
    return doubledValue;
    //@end
}

inline int two(int x) {
    //@hole beta.two lines=2 "Halved"
    //@starter TODO_HOLE("beta.two");
    //@starter return 0;
    return x / 2;
    //@end
}
"""

HINTS = """\
# Hints

## beta.one

1. What is 3, doubled?
2. Add.
3. Pseudocode:

       the result is x, twice

## beta.two

1. What is 6, halved?
2. Divide.
3. x over two
"""

LESSON = """\
# 02 · Beta

{sections}
"""

TASKS = """\
<!-- gen holes -->
<!-- /gen -->

See `beta.right` and [the file](beta.cuh)."""

OUTPUT = """\
<!-- gen run --count 3 -->
<!-- /gen -->

<!-- gen code solutions/02_beta/beta.cuh twice -->
<!-- /gen -->

![dots](figures/dots.svg)"""

BUGS = """\
<!-- gen bugs -->
<!-- /gen -->"""

INVARIANTS = """\
<!-- gen checks -->
<!-- /gen -->"""

CHECKS = """\
{{"beta.right", "Doubles are right", "All else rests on it.", right},
 {"beta.order", "Any order gives the same", "A GPU gives no order.", order}}
"""

MUTANTS = """\
mutant minus_for_plus
caught by beta.right
looks like a minus in place of a plus
picture
-    return doubledValue;
+    return -doubledValue;
"""

FIGURES = """\
from figure import Figure

def dots(run):
    figure = Figure(100, 20, "As many dots as balls")
    for k in range(run("--count", 4)["count"]):
        figure.circle(10 + 20 * k, 10, 5)
    return figure.svg()

FIGURES = {"dots": dots}
PICTURES = {"view": ["--count", 1]}
"""

# Stands for every executable: what it does depends on its name and arguments.
PROGRAM = """\
import json, os, shutil, sys
name, arguments = os.path.basename(sys.argv[0]), sys.argv[1:]
def after(option):
    return arguments[arguments.index(option) + 1] if option in arguments else None
if "--list" in arguments:
    print(json.dumps([{"id": "beta.right", "claim": "Doubles are right", "why": "All rests on it."},
                      {"id": "beta.order", "claim": "Any order will do", "why": "GPUs."}]))
elif name == "ballpit_doctor":
    print(json.dumps({"name": "graphics", "state": "ok", "text": "", "fix": ""}))
    print(json.dumps({"name": "OpenGL", "state": "ok", "text": "soft", "fix": ""}))
elif after("--events"):
    with open(after("--events"), "w") as file:
        for event in [{"event": "start", "seed": 1, "devices": ["cpu"]},
                      {"event": "case", "id": "beta.right", "device": "cpu"},
                      {"event": "result", "id": "beta.right", "device": "cpu", "state": "wrong",
                       "failures": [], "looks_like": "a minus in place of a plus"},
                      {"event": "end"}]:
            file.write(json.dumps(event) + "\\n")
    if after("--picture"):
        shutil.copy(os.path.join(os.path.dirname(sys.argv[0]), "bug.png"), after("--picture"))
elif after("--png"):
    shutil.copy(os.path.join(os.path.dirname(sys.argv[0]), "view.png"), after("--png"))
elif "--json" in arguments:
    print(json.dumps({"count": int(after("--count"))}))
else:
    print("balls " + after("--count") + "\\nhash  0123")
"""

# Put behind the real build.py and variants.py: nothing is compiled.
NO_BUILD = """

def preset(): return "cpu-release"
def configure(): pass
def try_build(target): return None
def build(targets): pass
"""
NO_VARIANTS = """

def compile_variant(target, label, name, texts): return executable("check_02"), None
"""


def png(width, height, channels, rows, filters=None):
    """PNG bytes; `rows` are bytes as they stand in the file, behind their filter's number."""
    def chunk(kind, content):
        return (struct.pack(">I", len(content)) + kind + content
                + struct.pack(">I", zlib.crc32(kind + content)))

    colour = {1: 0, 3: 2, 4: 6}[channels]
    packed = b"".join(bytes([kind]) + bytes(row)
                      for kind, row in zip(filters or [0] * height, rows))
    return (b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(packed)) + chunk(b"IEND", b""))


def flat_png(value, size=10):
    return png(size, size, 3, [[value] * 3 * size] * size)


def lesson(sections, blocks=True):
    """A lesson with all `sections` (names) and about 650 words."""
    bodies = {"Invariants": INVARIANTS, "Tasks": TASKS, "What you should see": OUTPUT,
              "If it looks like this": BUGS} if blocks else {}
    bodies["Go further"] = "\n".join(["word " * 20] * 31)
    return LESSON.format(sections="\n\n".join(
        f"## {name}\n\n{bodies.get(name, 'Text.')}" for name in sections))


class Miniature(unittest.TestCase):
    """Each test has a project of its own, with fresh starters and a finished lesson."""

    def setUp(self):
        from workbook import lessons
        self.root = Path(tempfile.mkdtemp(prefix="ballpit_test_"))
        self.addCleanup(shutil.rmtree, self.root)
        shutil.copytree(PROJECT / "tools", self.root / "tools",
                        ignore=shutil.ignore_patterns("__pycache__", "figures_*", "cmake"))
        for module, replacement in (("build", NO_BUILD), ("variants", NO_VARIANTS)):
            with open(self.root / f"tools/workbook/{module}.py", "a") as file:
                file.write(replacement)
        self.write("CMakeLists.txt", "project(ballpit VERSION 0.1 LANGUAGES CXX)\n")
        self.write("chapters/01_alpha/README.md", lesson(lessons.SECTIONS, blocks=False))
        self.write("chapters/01_alpha/main.cu", "int main() {\n    return 1;\n}\n")
        self.write("chapters/02_beta/README.md", lesson(lessons.SECTIONS))
        self.write("chapters/02_beta/hints.md", HINTS)
        self.write("chapters/02_beta/main.cu", "int main() {\n    return 2;\n}\n")
        self.write("solutions/02_beta/beta.cuh", PIECE)
        self.write("tests/checks/check_02.cu", CHECKS)
        self.write("tests/checks/mutants_02.txt", MUTANTS)
        self.write("tools/figures/figures_02.py", FIGURES)
        for name in ("02_beta_reference", "check_02_reference", "check_02", "ballpit_doctor"):
            self.write(f"build/cpu-release/bin/{name}", f"#!{sys.executable}\n{PROGRAM}")
            os.chmod(self.root / "build/cpu-release/bin" / name, 0o755)
        for name, value in (("bug", 10), ("view", 200)):
            self.write(f"build/cpu-release/bin/{name}.png", flat_png(value))
        self.starter = self.root / "chapters/02_beta/beta.cuh"

    def write(self, name, content):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def read(self, name):
        return (self.root / name).read_text()

    def replace(self, name, old, new):
        text = self.read(name)
        self.assertIn(old, text)
        self.write(name, text.replace(old, new, 1))

    def ballpit(self, *arguments, code=0, columns=100):
        """Runs a command of the miniature, and returns what it says."""
        environment = {**os.environ, "COLUMNS": str(columns), "PYTHONDONTWRITEBYTECODE": "1"}
        result = subprocess.run([sys.executable, self.root / "tools/ballpit.py", *arguments],
                                cwd=self.root, env=environment, text=True, capture_output=True,
                                timeout=120)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result.stdout + result.stderr

    def refuses(self, *arguments, words):
        """One error line with all `words`, exit code 2."""
        said = self.ballpit(*arguments, code=2)
        self.assertEqual(len(said.strip().splitlines()), 1, said)
        self.assertTrue(said.startswith("error: "), said)
        for word in words:
            self.assertIn(word, said)

    def gen(self, *options):
        self.ballpit("gen", *options)
