"""A small workbook in a temporary folder, with tools that only pretend to compile: so the tests of
./ballpit take seconds and can play every way in which a check may end."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent

PIECE = """// Chapter {label}: a piece.
//@starter #include "common/hole.cuh"
inline int value() {{
    //@hole {topic}.value lines=1 "Return one"
    //@starter TODO_HOLE("{topic}.value");
    //@starter return 0;
    return 1;
    //@end
}}
inline int other() {{
    //@hole {topic}.other lines=1 "Return two"
    //@starter TODO_HOLE("{topic}.other");
    //@starter return 0;
    return 2;
    //@end
}}
"""

# "Builds" by copying the fake program; fails with the log in $FAKE_LOG.
CMAKE = """#!/bin/sh
case $1 in
--preset) mkdir -p "build/$2/bin" && : >"build/$2/build.ninja" ;;
--build)
    [ -n "${FAKE_SLOW:-}" ] && { echo $$ >"$FAKE_SLOW"; sleep 60; }
    [ -n "${FAKE_LOG:-}" ] && { cat "$FAKE_LOG"; exit 1; }
    cmp -s "$FAKE_PROGRAM" "$2/bin/$4" || cp "$FAKE_PROGRAM" "$2/bin/$4"
    ;;
esac
"""

# `ninja -C FOLDER -t commands check_NN`: a library's command, and one that "compiles and links".
NINJA = """#!/bin/sh
label=${5#check_}
echo "false of another target"
echo ": CMakeFiles/$5.dir/ -I$2/pieces/$label && cp '$FAKE_PROGRAM' -T bin/$5 && : -o bin/$5 "
"""

# A check program. It plays $FAKE_SCENARIO, a Python list of (check, steps), or else looks into the
# piece that it is "built" from.
PROGRAM = r'''#!/usr/bin/env python3
import json, os, re, signal, sys, time
from pathlib import Path

me, options = Path(sys.argv[0]), sys.argv[1:]
value = lambda name: options[options.index(name) + 1] if name in options else None
label = (re.findall(r"\d\d", me.name) or ["none"])[0]
root = Path(os.environ["FAKE_ROOT"])

if "--time" in options:
    reference = me.name.endswith("_reference")
    print(json.dumps({"milliseconds": 2.0 if reference else 3.0, "count": 1000}))
    sys.exit()
if me.name.startswith(("gravity_fall", "10_full_system")) and "--json" in options:
    # The whole system: its state tells whether every piece is filled.
    pieces = [file.read_text() for file in me.parent.glob("pieces/*/*.cuh")]
    open_ones = sum("TODO_HOLE" in re.sub("//.*", "", text) for text in pieces)
    state = {"state_hash": "of %d open" % open_ones}
    print(json.dumps({} if "FAKE_STATELESS" in os.environ else state))
    sys.exit()
if not me.name.startswith("check"):
    print("program", me.name, *options)
    sys.exit()

def piece():
    if me.name.endswith("_reference"):
        return next((root / "solutions").glob(label + "_*/*.cuh")).read_text()
    folder = me.parent / "pieces" if "variants" in me.parts else me.parents[1] / "pieces" / label
    text = next(folder.glob(label + "_*/*.cuh")).read_text()
    forward = re.match(r'#include "(/.*)"', text)
    return Path(forward[1]).read_text() if forward else text

def looked_at():
    text = re.sub("//.*", "", piece())
    holes = [{"event": "hole", "id": id} for id in re.findall(r'TODO_HOLE\("(.*?)"\)', text)]
    state = "passed" if "return 1;" in text else "wrong"
    guess = "a two in place of a one" if text.count("return 2;") == 2 else ""
    return [("value", [*holes, {"state": state, "looks_like": guess}]), ("other", [{}])]

scenario = os.environ.get("FAKE_SCENARIO")
cases = eval(scenario) if scenario else looked_at()
wanted = value("--case")
if wanted and wanted not in [name for name, _ in cases]:
    print("error: unknown check '%s': there are %s" % (wanted, ", ".join(n for n, _ in cases)))
    sys.exit(2)
if value("--device") == "cuda":
    print("error: --device cuda: this build has no CUDA code: use --device cpu")
    sys.exit(2)
log = open(value("--events") or os.devnull, "a")
def tell(event):
    log.write(json.dumps(event) + "\n")
    log.flush()
tell({"event": "start", "chapter": label, "seed": int(value("--seed") or 1), "devices": ["cpu"],
      "skipped": [{"device": "cuda", "why": "no GPU here"}]})
names = [name for name, _ in cases]
first = names.index(value("--after")) + 1 if "--after" in options else 0
for name, steps in cases[first:]:
    if wanted not in (None, name):
        continue
    tell({"event": "case", "id": name, "device": "cpu"})
    for step in steps:
        if callable(step):
            step()
        elif "event" in step:
            tell(step)
        else:
            tell({"event": "result", "id": name, "device": "cpu", "state": "passed", "failures": [],
                  "claim": name + " is right", "failure_count": 0, "message": "", **step})
tell({"event": "end"})
'''


# Steps of a check that hangs, after it has written its process id.
HANG = "lambda: open('pid', 'w').write(str(os.getpid())), lambda: time.sleep(60)"


def scenario(*cases):
    """Cases as (id, steps), for $FAKE_SCENARIO."""
    return "[" + ", ".join(f"('{name}', [{steps}])" for name, steps in cases) + "]"


def is_alive(pid):
    """Is the process still running? (A zombie is not.)"""
    try:
        return " Z " not in Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False


class Workbook(unittest.TestCase):
    """Each test gets a workbook of its own with the chapters 01_first and 02_second."""

    def setUp(self):
        self.root = Path(tempfile.mkdtemp(prefix="ballpit_test_")).resolve()
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        shutil.copy(PROJECT / "ballpit", self.root)
        shutil.copytree(PROJECT / "tools", self.root / "tools",
                        ignore=shutil.ignore_patterns("__pycache__"))
        # A toolkit of this machine must not decide.
        build = self.root / "tools/workbook/build.py"
        build.write_text(build.read_text().replace("/usr/local/cuda", "/nowhere"))
        for folder in ("01_first", "02_second"):
            self.add_chapter(folder)
        self.environment = self.make_tools()

    def add_chapter(self, folder):
        label, topic = folder.split("_")
        self.write(f"chapters/{folder}/README.md", "# A chapter\n")
        self.write(f"solutions/{folder}/{topic}.cuh", PIECE.format(label=label, topic=topic))
        self.write(f"tests/checks/check_{label}.cu", "")
        sys.path.insert(0, str(PROJECT / "tools"))
        from workbook import markers
        starter = markers.starter(markers.parse(PIECE.format(label=label, topic=topic), folder))
        self.write(f"chapters/{folder}/{topic}.cuh", starter)

    def make_tools(self):
        for name, text in [("cmake", CMAKE), ("ninja", NINJA), ("c++", "#!/bin/sh\n"),
                           ("nvidia-smi", "#!/bin/sh\n"), ("program", PROGRAM)]:
            self.write(f"fake/{name}", text).chmod(0o755)
        os.symlink(sys.executable, self.root / "fake/python3")
        return {**os.environ, "PATH": f"{self.root}/fake:/usr/bin:/bin",
                "FAKE_ROOT": str(self.root), "FAKE_PROGRAM": str(self.root / "fake/program")}

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def solve(self, folder="01_first"):
        """Fills the holes of a chapter rightly."""
        topic = folder.split("_")[1]
        return self.write(f"chapters/{folder}/{topic}.cuh", "int value() { return 1; }\n")

    def ballpit(self, *arguments, cwd=None, scenario=None, **environment):
        extra = {"FAKE_SCENARIO": scenario} if scenario else {}
        return subprocess.run([self.root / "ballpit", *arguments, "--no-install"], text=True,
                              capture_output=True, timeout=60, cwd=cwd or self.root,
                              env={**self.environment, **extra, **environment})

    def refuses(self, words, *arguments, code=2, **options):
        """One line on stderr with all `words`, nothing on stdout."""
        result = self.ballpit(*arguments, **options)
        self.assertEqual(result.returncode, code, result.stderr)
        lines = result.stderr.strip().splitlines()
        self.assertEqual(len([line for line in lines if line.startswith("error: ")]), 1, lines)
        self.assertTrue(lines[-1].startswith("error: "), lines)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(word, lines[-1])
