"""The last verdict on each chapter: build/verdicts.json, and its text in build/last_verdict.txt."""

import hashlib
import json
import time

from workbook import files
from workbook.chapters import ROOT
from workbook.terminal import uncoloured

VERDICTS = ROOT / "build" / "verdicts.json"
LAST_TEXT = ROOT / "build" / "last_verdict.txt"


def content_hash(chapter):
    """Of the student's files of a chapter: changes with every edit."""
    digest = hashlib.sha256()
    for solution in chapter.solutions:
        file = chapter.student_file(solution)
        digest.update(file.name.encode() + b"\0")
        digest.update(file.read_bytes() if file.exists() else b"(missing)")
    return digest.hexdigest()


def load():
    """All verdicts: chapter's folder -> {"state", "hash", "time"}."""
    try:
        return json.loads(VERDICTS.read_text())
    except (OSError, ValueError):
        return {}


def remember(chapter, state, content, text):
    """`content` is the hash from before the check: a file saved meanwhile was not tested."""
    entry = {"state": state, "hash": content, "time": time.strftime("%Y-%m-%d %H:%M:%S")}
    verdicts = load() | {chapter.folder: entry}
    files.write(VERDICTS, json.dumps(verdicts, indent=1) + "\n")
    files.write(LAST_TEXT, uncoloured(text) + "\n")


def last_state(chapter):
    """(state of the last verdict or None, whether the files were edited since)."""
    entry = load().get(chapter.folder)
    if not entry:
        return None, False
    return entry["state"], entry["hash"] != content_hash(chapter)


def is_correct(chapter):
    """Was the present content of the student's files found CORRECT?"""
    return last_state(chapter) == ("CORRECT", False)
