"""Asks the finished pieces' executables: which checks are there, what does a run print."""

import functools
import json
import os
import subprocess

from workbook import build, processes
from workbook.chapters import ROOT
from workbook.errors import ToolError

SECONDS = 300


def answer(target, arguments, seconds=SECONDS, **environment):
    """What an executable prints, built first if it is not up to date. ToolError if it fails."""
    build.build([target])
    shown = " ".join([target, *arguments])
    child = processes.start([str(build.executable(target)), *arguments], cwd=ROOT, text=True,
                            env={**os.environ, **environment}, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)
    try:
        printed, errors = child.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        raise ToolError(f"'{shown}' did not end within {seconds} s") from None
    finally:
        processes.stop(child)
    if child.returncode != 0:
        reason = (errors.strip().splitlines() or ["it printed no reason"])[-1]
        raise ToolError(f"'{shown}' ended with exit code {child.returncode}: {reason}")
    return printed


def document(target, arguments):
    """What an executable prints as JSON."""
    try:
        return json.loads(answer(target, arguments))
    except json.JSONDecodeError as error:
        raise ToolError(f"'{target} {' '.join(arguments)}' printed no JSON: {error}") from None


def has_checks(chapter):
    return (ROOT / "tests" / "checks" / f"check_{chapter.label}.cu").exists()


@functools.cache
def checks(chapter):
    """The chapter's checks in their order, each with `id`, `claim` and `why`."""
    if not has_checks(chapter):
        return []
    return document(f"check_{chapter.label}_reference", ["--list"])


def run(chapter, arguments):
    """What the finished chapter prints."""
    return answer(f"{chapter.folder}_reference", arguments)


def run_as_json(chapter, arguments):
    return document(f"{chapter.folder}_reference", [*arguments, "--json"])
