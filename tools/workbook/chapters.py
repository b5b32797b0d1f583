"""The chapters on disk: where each keeps its files, and which can be worked through."""

import re
from dataclasses import dataclass
from pathlib import Path

from workbook import markers
from workbook.errors import InputError

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Chapter:
    number: int
    folder: str  # "02_grid_hash"

    @property
    def label(self):
        """The two digits: "02"."""
        return f"{self.number:02d}"

    @property
    def path(self):
        return ROOT / "chapters" / self.folder

    @property
    def solutions(self):
        """The finished pieces with markers: what a student works on, or looks at (chapter 00)."""
        folder = ROOT / "solutions" / self.folder
        return [file for file in sorted(folder.glob("*.*h")) if "//@" in file.read_text()]

    def pieces(self):
        """The parsed solutions, in file order."""
        return [markers.parse(file.read_text(), str(file.relative_to(ROOT)))
                for file in self.solutions]

    def student_file(self, solution):
        """Where the student's version of a finished piece lies."""
        return self.path / Path(solution).name

    def holes(self):
        return [hole for piece in self.pieces() for hole in piece.holes]


def all_chapters():
    """Chapters with a lesson, in order."""
    found = []
    for folder in sorted((ROOT / "chapters").iterdir()):
        match = re.match(r"(\d\d)_\w+$", folder.name)
        if match and (folder / "README.md").exists():
            found.append(Chapter(int(match[1]), folder.name))
    return found


def find(word):
    """The chapter that a user means by "2", "02", "grid_hash", "02_grid_hash" or a path to it."""
    name = Path(word).name if not word.isdigit() else f"{int(word):02d}"
    for chapter in all_chapters():
        if name in (chapter.label, chapter.folder, chapter.folder[3:]):
            return chapter
    known = ", ".join(chapter.folder for chapter in all_chapters())
    raise InputError(f"unknown chapter '{word}': there are {known}")
