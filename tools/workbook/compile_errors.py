"""The one compiler error that a student should read: the first that lies in a file of theirs."""

import os
import re
from dataclasses import asdict, dataclass
from pathlib import Path

from workbook import markers
from workbook.chapters import ROOT

# g++ and clang: "file:line:column: error: text". nvcc: "file(line): error: text".
ERROR = re.compile(r"^(?P<file>[^\s:(][^:(]*)[:(](?P<line>\d+)(?::(?P<column>\d+))?\)?: "
                   r"(?:fatal )?error:? (?:#\S+: )?(?P<text>.*)$")
# What leads from an error inside the engine back to the line that asked for it.
CAUSE = re.compile(r"^(?P<file>[^\s:(][^:(]*):(?P<line>\d+)(?::(?P<column>\d+))?:\s+"
                   r"(?:required (?:from|by)|in instantiation|note: in instantiation|"
                   r"note: required)")
NVCC_CAUSE = re.compile(r"at line (?P<line>\d+) of (?P<file>\S+)")
LINKER = re.compile(r"undefined reference to .*|multiple definition of .*")


@dataclass
class CompileError:
    text: str
    file: str = ""    # relative to the project's folder; empty for the linker's errors
    line: int = 0
    column: int = 0   # 0: not known
    inside: str = ""  # where in the engine the compiler stumbled, if not in the student's file
    log: str = ""     # where all of it stands

    def as_dict(self):
        return asdict(self)

    def lines(self):
        """For people: place and message, the source line, a caret."""
        if not self.file:
            return [self.text]
        place = f"{self.file}:{self.line}" + (f":{self.column}" if self.column else "")
        shown = [f"{place}: {self.text}"]
        source = (ROOT / self.file).read_text(errors="replace").splitlines()
        if 0 < self.line <= len(source):
            code = source[self.line - 1].expandtabs(1)
            shown.append(f"    {code}")
            if self.column:
                shown.append("    " + " " * (self.column - 1) + "^")
        if self.inside:
            shown.append(f"(the compiler stumbled in {self.inside}, because of this line)")
        return shown


def _relative(file):
    path = Path(file)
    if not path.is_absolute():
        # ccache may tell paths as seen from the build's folder, build/PRESET.
        start = ROOT / "build" / "PRESET" if path.parts[0] == ".." else ROOT
        path = Path(os.path.normpath(start / path))
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def _place(match):
    column = match.groupdict().get("column")
    return {"file": _relative(match["file"]), "line": int(match["line"]),
            "column": int(column or 0)}


def _cause(lines, ours):
    """The first place in a student's file that led to an error in the engine."""
    for line in lines:
        match = CAUSE.match(line) or NVCC_CAUSE.search(line)
        if match and _relative(match["file"]) in ours:
            return _place(match)
    return None


def _unmatched_brace(files, error, log):
    """A brace too many or too few shows far behind the student's file: then the hole is named."""
    for file in files:
        path = ROOT / file
        text = path.read_text(errors="replace") if path.exists() else ""
        for hole, (line, content) in markers.student_holes(text).items():
            opening, closing = (sum(row.count(brace) for row in content) for brace in "{}")
            if opening != closing:
                return CompileError(f"hole {hole} has {opening} of {{ and {closing} of }}", file,
                                    line, inside=f"{_relative(error['file'])}:{error['line']}",
                                    log=log)
    return None


def find(log, student_files):
    """The CompileError to show, or None if the log holds none. `student_files`: paths in the
    project; the log's other errors are the engine's, or echoes."""
    ours = {_relative(file) for file in student_files}
    lines = Path(log).read_text(errors="replace").splitlines()
    where = _relative(log)
    errors = [(number, match) for number, line in enumerate(lines) if (match := ERROR.match(line))]
    for _, match in errors:
        if _relative(match["file"]) in ours:
            return CompileError(match["text"], log=where, **_place(match))
    for index, (number, match) in enumerate(errors):
        # g++ tells what led to an error before it, clang and nvcc after it.
        first = errors[index - 1][0] + 1 if index else 0
        last = errors[index + 1][0] if index + 1 < len(errors) else len(lines)
        if cause := _cause(lines[first:last], ours):
            inside = f"{_relative(match['file'])}:{match['line']}"
            return CompileError(match["text"], inside=inside, log=where, **cause)
    if errors:
        return (_unmatched_brace(sorted(ours), errors[0][1], where)
                or CompileError(errors[0][1]["text"], log=where, **_place(errors[0][1])))
    for line in lines:
        if match := LINKER.search(line):
            return CompileError(match[0], log=where)
    return None
