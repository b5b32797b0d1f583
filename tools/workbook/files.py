"""Files written whole or not at all, and copies of what a student would lose."""

import contextlib
import os
import time

from workbook.chapters import ROOT
from workbook.errors import InputError


def relative(path):
    """A path as people read it: from the project's folder."""
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def write(path, content):
    """Puts text or bytes into a file in one move: an interruption leaves the old file whole."""
    data = content if isinstance(content, bytes) else content.encode()
    partial = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial.write_bytes(data)
        os.replace(partial, path)
    except OSError as error:
        with contextlib.suppress(OSError):
            partial.unlink()
        raise InputError(f"{relative(path)} cannot be written: {error.strerror}") from None


def back_up(path):
    """Copies a file to build/backup/<name>.<date-time>, and returns where to."""
    stamp = time.strftime("%Y-%m-%d_%H-%M-%S")
    copy = ROOT / "build" / "backup" / f"{path.name}.{stamp}"
    count = 1
    while copy.exists():
        count += 1
        copy = copy.with_name(f"{path.name}.{stamp}_{count}")
    write(copy, path.read_bytes())
    return copy
