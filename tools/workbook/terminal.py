"""What people see: colours on a terminal, notes while something takes long."""

import os
import re
import sys

COLOURS = {"red": 31, "green": 32, "yellow": 33, "magenta": 35, "faint": 2, "bold": 1}


def paint(text, colour, stream=None):
    """The text in a colour, or as it is where nobody sees colours."""
    stream = stream or sys.stdout
    if not stream.isatty() or "NO_COLOR" in os.environ:
        return text
    return f"\033[{COLOURS[colour]}m{text}\033[0m"


def print_outcome(name, problem):
    """One line of a list of proofs: ok, or no and why."""
    mark = paint("no", "red") if problem else paint("ok", "green")
    print(f"{mark}  {name}" + (f": {problem}" if problem else ""), flush=True)


def uncoloured(text):
    """The text without the colours that paint() gave it."""
    return re.sub("\033\\[\\d+m", "", text)


def note(text):
    """What is going on now: on stderr, so that what a command gives stays clean."""
    print(text, file=sys.stderr, flush=True)


def plural(count, noun):
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
