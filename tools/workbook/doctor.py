"""`doctor`: does this machine have what the course needs? `report`: the facts for a question."""

import functools
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from workbook import build, record
from workbook.chapters import ROOT, all_chapters
from workbook.errors import FAILED, InputError, ToolError
from workbook.terminal import paint

TOOLS = [  # name, command, oldest version that will do, Debian's package
    ("compiler", "c++", (11,), "g++"),
    ("CMake", "cmake", (3, 25), "cmake"),
    ("Ninja", "ninja", (1, 10), "ninja-build"),
]
LIBRARIES = [  # name, headers (one of them will do), Debian's package
    ("Catch2", ["catch2/catch_all.hpp", "catch2/catch.hpp"], "catch2"),
    ("CLI11", ["CLI/CLI.hpp"], "libcli11-dev"),
    ("JSON library", ["nlohmann/json.hpp"], "nlohmann-json3-dev"),
]
OLDEST_PYTHON, OLDEST_CUDA, DISK_BYTES = (3, 10), (12,), 2 << 30
SECONDS = 60
COLOURS = {"ok": "green", "note": "yellow", "no": "red"}


@dataclass(frozen=True)
class Finding:
    name: str
    state: str  # "ok", "note", or "no": something the course needs is not there
    text: str
    fix: str = ""


def register(commands):
    parser = commands.add_parser("doctor", help="is everything here that the course needs?")
    parser.set_defaults(run=examine)
    parser = commands.add_parser("report", help="the facts about this machine, for a question")
    parser.set_defaults(run=write_report)


def output(command, text=None):
    """What a command prints on stdout, or None if it is missing or fails."""
    try:
        result = subprocess.run(command, input=text, cwd=ROOT, text=True, errors="replace",
                                capture_output=True, timeout=SECONDS)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return result.stdout if result.returncode == 0 else None


def version_in(text):
    match = re.search(r"\d+(?:\.\d+)+", text)
    return tuple(map(int, match[0].split("."))) if match else (0,)


def look_at_tool(name, command, oldest, package):
    fix = f"sudo apt-get install {package}"
    printed = output([command, "--version"])
    if printed is None:
        return Finding(name, "no", f"{command} is missing", fix)
    first = printed.splitlines()[0]
    if version_in(first) < oldest:
        needed = ".".join(map(str, oldest))
        return Finding(name, "no", f"{first} is too old: {needed} or newer is needed", fix)
    return Finding(name, "ok", first if command in first.lower() else f"{command} {first}")


def look_at_python():
    version = platform.python_version()
    if sys.version_info < OLDEST_PYTHON:
        return Finding("Python", "no", f"{version} is too old", "install Python 3.10 or newer")
    return Finding("Python", "ok", version)


def look_at_library(name, headers, package):
    source = "".join(f"#if __has_include(<{header}>)\nfound\n#endif\n" for header in headers)
    if "found" in (output(["c++", "-E", "-P", "-x", "c++", "-"], source) or ""):
        return Finding(name, "ok", "found")
    return Finding(name, "no", "not found", f"sudo apt-get install {package}")


def look_at_disk():
    free = shutil.disk_usage(ROOT).free
    text = f"{free / 2**30:.1f} GiB free"
    if free < DISK_BYTES:
        return Finding("disk", "no", text, f"builds and videos want {DISK_BYTES >> 30} GiB")
    return Finding("disk", "ok", text)


def look_at_gpu():
    query = ["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"]
    cards = [line for line in (output(query) or "").splitlines() if "," in line]
    if not cards:
        return Finding("GPU", "note", "no NVIDIA GPU with a driver",
                       "none is needed: every chapter runs on the CPU")
    name, driver = cards[0].rsplit(",", 1)
    more = f", and {len(cards) - 1} more" if len(cards) > 1 else ""
    return Finding("GPU", "ok", f"{name.strip()}, driver {driver.strip()}{more}")


def look_at_nvcc():
    printed = output([shutil.which("nvcc") or str(build.NVCC), "--version"])
    fix = "with an NVIDIA GPU, install the CUDA toolkit (12 or newer); without, it is not needed"
    if printed is None:
        return Finding("nvcc", "note", "CUDA's compiler is not installed", fix)
    release = re.search(r"release [\d.]+", printed)
    version = version_in(release[0] if release else "")
    text = "CUDA " + ".".join(map(str, version))
    return Finding("nvcc", "note" if version < OLDEST_CUDA else "ok", text,
                   fix if version < OLDEST_CUDA else "")


@functools.lru_cache(maxsize=None)
def probes():
    """What the executable ballpit_doctor finds, built first. Problems are findings, too."""
    try:
        build.build(["ballpit_doctor"])
    except (InputError, ToolError) as error:
        return [Finding("build", "no", str(error), "mend the lines above first")]
    # Not output(): what was printed before a crash counts.
    with subprocess.Popen([str(build.executable("ballpit_doctor"))], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        try:
            lines = process.communicate(timeout=SECONDS)[0].splitlines()
        except subprocess.TimeoutExpired:
            process.kill()
            lines = process.communicate()[0].splitlines()
    found = [Finding(**json.loads(line)) for line in lines if line.endswith("}")]
    if process.returncode != 0:
        last = found[-1].name if found else "the start"
        found.append(Finding("after " + last, "no", "the next probe crashed or hung",
                             "most often the graphics driver: update it"))
    return found


def works(name):
    """Whether the executable's probe of this name is content."""
    return any(finding.name == name and finding.state != "no" for finding in probes())


def tool_findings():
    return [*(look_at_tool(*tool) for tool in TOOLS), look_at_python()]


def examine(args):
    """Prints one line a finding; the fix stands below what needs one."""
    findings = [*tool_findings(), *(look_at_library(*library) for library in LIBRARIES),
                look_at_disk(), look_at_gpu(), look_at_nvcc()]
    for finding in findings:
        show(finding)
    for finding in probes():
        show(finding)
        findings.append(finding)
    missing = [finding.name for finding in findings if finding.state == "no"]
    if missing:
        print(f"\nThe course needs this first: {', '.join(missing)}.")
        return FAILED
    print("\nEverything that the course needs is here.")
    return 0


def show(finding):
    state = paint(f"{finding.state:<4}", COLOURS[finding.state])
    print(f"{state}  {finding.name:<12}  {finding.text}", flush=True)
    if finding.fix:
        print(f"{'':20}{finding.fix}")


def write_report(args):
    lines = [("version", version_and_commit()), ("system", system())]
    lines += [(finding.name, finding.text)
              for finding in [*tool_findings(), look_at_nvcc(), look_at_gpu()]]
    lines.append(("build", build.preset()))
    lines.append(("chapters", chapter_states()))
    print("Ballpit report")
    for name, text in lines:
        print(anonymous(f"  {name:<9} {text}"))
    if record.LAST_TEXT.exists():
        print("  last verdict:")
        for line in record.LAST_TEXT.read_text().splitlines():
            print(anonymous(f"    {line}"))
    return 0


def version_and_commit():
    version = re.search(r"project\(ballpit VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    text = version[1] if version else "unknown"
    commit = output(["git", "rev-parse", "--short", "HEAD"])
    if commit is None:
        return f"{text}, not a git checkout"
    changed = len((output(["git", "status", "--porcelain"]) or "").splitlines())
    return f"{text}, commit {commit.strip()}, {f'{changed} files changed' if changed else 'clean'}"


def system():
    try:
        name = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        name = platform.system()
    return f"{name}, {platform.machine()}, {os.cpu_count()} processors"


def chapter_states():
    states = []
    for chapter in all_chapters():
        state, edited = record.last_state(chapter)
        if state:
            states.append(f"{chapter.label} {state}{' (edited since)' if edited else ''}")
    return ", ".join(states) or "none checked yet"


def anonymous(text):
    """Without the names of people: no home folder, no place of the project."""
    text = text.replace(str(ROOT), ".")
    if len(Path.home().parts) > 1:
        text = text.replace(str(Path.home()), "~")
    text = re.sub(r"/(home|Users)/[^/\s]+", "~", text)
    user = os.environ.get("USER") or Path.home().name
    return re.sub(rf"(?<=/){re.escape(user)}(?=/|\s|$)", "USER", text) if user else text
