"""Configures and builds: presets, targets, and which pieces are the student's."""

import fcntl
import functools
import os
import re
import shutil
import subprocess
from contextlib import contextmanager
from pathlib import Path

from workbook import processes
from workbook.chapters import ROOT, all_chapters
from workbook.errors import InputError, ToolError
from workbook.terminal import note

NVCC = Path("/usr/local/cuda/bin/nvcc")
LOGS = ROOT / "build" / "logs"
_asked_machine = "auto"


def use_machine(machine):
    """What --cpu and --cuda ask for: "cpu", "cuda" or "auto"."""
    global _asked_machine
    _asked_machine = machine
    preset.cache_clear()


def _has_nvcc():
    return bool(shutil.which("nvcc")) or NVCC.exists()


def _has_gpu():
    try:
        listing = subprocess.run(["nvidia-smi", "-L"], capture_output=True, text=True, timeout=30)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return "GPU" in listing.stdout


@functools.lru_cache(maxsize=None)
def preset():
    """The CMake preset that this call builds with."""
    if _asked_machine == "cuda" and not _has_nvcc():
        raise InputError("--cuda needs CUDA's compiler nvcc, and there is none here: install the "
                         "CUDA toolkit (12 or newer), or leave out --cuda")
    machine = _asked_machine
    if machine == "auto":
        machine = "cuda" if _has_nvcc() and _has_gpu() else "cpu"
    return f"{machine}-release"


def folder():
    return ROOT / "build" / preset()


def executable(name):
    return folder() / "bin" / name


def require_writable():
    """Makes build/logs, or says why that is impossible."""
    try:
        LOGS.mkdir(parents=True, exist_ok=True)
        writable = os.access(LOGS, os.W_OK)
    except OSError:
        writable = False
    if not writable:
        raise InputError(f"{ROOT / 'build'} cannot be written: copy the project to a folder of "
                         "your own")


def first_errors(log):
    """The first errors in a log, each with a few lines: what follows is often an echo."""
    lines = Path(log).read_text(errors="replace").splitlines()
    shown = set()
    errors = [n for n, line in enumerate(lines) if re.search(r"(?i)(error|fatal)[: ]", line)]
    for number in errors[:3]:
        shown.update(range(number, min(number + 7, len(lines))))
    return "\n".join(lines[n] for n in sorted(shown)) if shown else "\n".join(lines[-20:])


def fail(what, log):
    note(first_errors(log))
    raise ToolError(f"this failed: {what}; all of it: {log.relative_to(ROOT)}")


@contextmanager
def _alone():
    """Two builds in one folder at once (a `watch` beside a `check`) would spoil each other."""
    with open(folder() / ".lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def configure():
    """Once; later CMake itself sees what changed."""
    require_writable()
    for tool in ("cmake", "ninja", "c++"):
        if not shutil.which(tool):
            raise InputError(f"{tool} is missing; `./ballpit test` installs it (unless called with "
                             "--no-install)")
    folder().mkdir(exist_ok=True)
    if (folder() / "build.ninja").exists():
        return
    note(f"configuring {preset()}")
    command = ["cmake", "--preset", preset()]
    with _alone():
        if not processes.run_logged(command, LOGS / "configure.log", cwd=ROOT):
            fail(" ".join(command), LOGS / "configure.log")


def left_out():
    """The labels of the chapters that this build leaves out because it has no graphics."""
    configure()
    file = folder() / "left_out"
    return set(file.read_text().split()) if file.exists() else set()


def buildable(chapters):
    """Those of these chapters that this build can build; a line says which are left out."""
    missing = left_out()
    for chapter in chapters:
        if chapter.label in missing:
            print(f"skipped: chapter {chapter.label} needs graphics, and this build has none")
    return [chapter for chapter in chapters if chapter.label not in missing]


def require(chapter):
    """InputError if this build leaves the chapter out."""
    if chapter.label in left_out():
        raise InputError(f"chapter {chapter.label} needs graphics, and this build has none: install "
                         "the packages of docs/dependencies.md (./ballpit test does that), delete "
                         f"{folder().relative_to(ROOT)} and try again")


def try_build(target):
    """Builds a target quietly. None, or the log of what failed."""
    configure()
    if target != "all" and not executable(target).exists():
        note(f"building {target} (a minute or two the first time)")
    log = LOGS / f"build_{target}.log"
    with _alone():
        command = ["cmake", "--build", str(folder()), "--target", target]
        return None if processes.run_logged(command, log, cwd=ROOT) else log


def build(targets):
    """Builds a list of targets; ToolError with the first errors if that fails."""
    for target in targets:
        if log := try_build(target):
            fail(f"building {target}", log)


# ---- whose pieces a chapter is built from -------------------------------------------------------

def pieces_folder(chapter):
    """Where the chapter's own programs look first for pieces: one forwarding header each."""
    return folder() / "pieces" / chapter.label


def set_mine(chapter, mine):
    """The chapter's programs get the pieces of the chapters in `mine` from chapters/, all others
    from solutions/. Headers that stay the same are not touched, so that nothing is rebuilt."""
    for other in all_chapters():
        for solution in other.solutions:
            file = other.student_file(solution) if other in mine else solution
            header = pieces_folder(chapter) / other.folder / solution.name
            line = f'#include "{file}"\n'  # as tools/cmake/BallpitChapters.cmake writes it
            if not header.exists() or header.read_text() != line:
                header.parent.mkdir(parents=True, exist_ok=True)
                header.write_text(line)
