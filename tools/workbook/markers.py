"""Hole markers: reads them in a solution, and makes the starter of it."""

import re
from dataclasses import dataclass, field

from workbook.errors import ToolError

HOLE = re.compile(r'^\s*//@hole (?P<id>[a-z0-9_]+\.[a-z0-9_]+) lines=(?P<lines>\d+) "(?P<task>[^"]+)"$')
STARTER = re.compile(r"^(?P<indent>\s*)//@starter ?(?P<code>.*)$")
SHOW = re.compile(r"^\s*//@show (?P<name>[a-z0-9_]+)$")
END = re.compile(r"^\s*//@end$")


@dataclass
class Hole:
    """One hole: what a student is asked to write."""
    id: str
    lines: int
    task: str
    starter: list = field(default_factory=list)   # lines that stand in the hole of the starter
    solution: list = field(default_factory=list)  # the finished lines


@dataclass
class Piece:
    """A solution file in parts, in order: lines of text, "starter only" lines, holes."""
    path: str
    parts: list = field(default_factory=list)  # ("text" | "starter", line) or ("hole", Hole)
    shown: dict = field(default_factory=dict)  # name: the lines between //@show and //@end

    @property
    def holes(self):
        return [part for kind, part in self.parts if kind == "hole"]


def parse(text, path):
    """The Piece in `text`. ToolError with the line of the first marker that is not right."""
    piece = Piece(path)
    hole = shown = None

    def fail(message):
        raise ToolError(f"{path}:{number}: {message}")

    for number, line in enumerate(text.splitlines(), 1):
        if match := HOLE.match(line):
            if hole or shown is not None:
                fail("a hole inside another block")
            if any(match["id"] == other.id for other in piece.holes):
                fail(f"hole {match['id']} stands here twice")
            hole = Hole(match["id"], int(match["lines"]), match["task"])
            piece.parts.append(("hole", hole))
        elif match := SHOW.match(line):
            if hole or shown is not None:
                fail("a show-block inside another block")
            shown = piece.shown.setdefault(match["name"], [])
        elif match := STARTER.match(line):
            code = match["indent"] + match["code"] if match["code"] else ""
            if hole:
                hole.starter.append(code)
            else:
                piece.parts.append(("starter", code))
        elif END.match(line):
            if not hole and shown is None:
                fail("//@end without a block")
            if hole and not any(f'TODO_HOLE("{hole.id}")' in code for code in hole.starter):
                fail(f'hole {hole.id} has no line //@starter TODO_HOLE("{hole.id}");')
            hole = shown = None
        elif "//@" in line:
            fail(f"not a marker: {line.strip()}")
        elif hole:
            hole.solution.append(line)
        else:
            if shown is not None:
                shown.append(line)
            piece.parts.append(("text", line))
    if hole or shown is not None:
        fail("a block without //@end")
    return piece


def framed(hole, content):
    """The lines of a hole in a starter, with the frame by which it is found again."""
    first = (hole.starter or hole.solution)[0]
    indent = first[:len(first) - len(first.lstrip())]
    plural = "" if hole.lines == 1 else "s"
    return [f"{indent}// ---- hole {hole.id} (about {hole.lines} line{plural}): {hole.task}",
            *content, f"{indent}// ---- end of {hole.id}"]


def starter(piece, solved=None):
    """The starter's text. Holes whose ids are in `solved` hold the finished lines; with None, no
    hole does. "Only hole X open" is: solved = all ids but X."""
    solved = solved or set()
    lines = []
    for kind, part in piece.parts:
        if kind == "hole":
            lines += framed(part, part.solution if part.id in solved else part.starter)
        else:
            lines.append(part)
    return "\n".join(lines) + "\n"


def plain(piece):
    """The solution without any marker: what a reader of the solution is shown."""
    lines = []
    for kind, part in piece.parts:
        lines += part.solution if kind == "hole" else [part] if kind == "text" else []
    return "\n".join(lines) + "\n"


def student_holes(text):
    """What stands in each hole of a student's file: id -> (line number of the frame, lines)."""
    found, current = {}, None
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        if match := re.match(r"// ---- hole (\S+) ", stripped):
            current = found.setdefault(match[1], (number, []))
        elif re.match(r"// ---- end of (\S+)$", stripped):
            current = None
        elif current:
            current[1].append(line)
    return found
