"""`gen`: starters, the generated blocks of lessons, and pictures, all made from the code."""

import dataclasses
import difflib
import subprocess

from workbook import blocks, build, lessons, markers, pictures
from workbook.chapters import ROOT, all_chapters, find
from workbook.errors import FAILED
from workbook.files import back_up, relative, write
from workbook.terminal import plural

SHOWN_LINES = 12


def register(commands):
    parser = commands.add_parser("gen", help="make starters, lessons' blocks and pictures afresh")
    parser.add_argument("chapters", nargs="*", metavar="NN", help="default: all chapters")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; say what is stale or wrong, and exit with 1")
    parser.add_argument("--text-only", action="store_true", help="leave out PNG pictures")
    parser.set_defaults(run=generate)


def generate(args):
    chosen = [find(word) for word in args.chapters] or build.buildable(all_chapters())
    workshop = Checker() if args.check else Writer()
    for chapter in chosen:
        make_starters(chapter, workshop)
        make_lesson(chapter, workshop)
        make_pictures(chapter, workshop, args.text_only)
        if args.check:
            workshop.faults += lessons.faults(chapter)
    return workshop.finish()


def short_diff(old, new):
    """The lines that differ, at most SHOWN_LINES of them, indented."""
    lines = list(difflib.unified_diff(old, new, "now", "fresh", n=1, lineterm=""))[2:]
    shown = [f"    {line}" for line in lines[:SHOWN_LINES]]
    hidden = len(lines) - SHOWN_LINES
    return "\n".join(shown + ([f"    ... and {hidden} more lines"] if hidden > 0 else []))


class Checker:
    """Compares, and writes nothing."""

    def __init__(self):
        self.faults, self.compared = [], 0

    def text(self, path, fresh):
        self.compared += 1
        if not path.exists():
            self.faults.append(f"{relative(path)} is missing")
        elif (old := path.read_text()) != fresh:
            difference = short_diff(old.split("\n"), fresh.split("\n"))
            self.faults.append(f"{relative(path)} is stale\n{difference}")

    starter = text

    def lesson(self, path, stale, fresh):
        self.compared += 1
        for block, new in stale:
            self.faults.append(f"{relative(path)}:{block.line}: block '{block.name}' is stale\n"
                               + short_diff(block.content, new.content))

    def picture(self, path, fresh, exact):
        self.compared += 1
        if not path.exists():
            self.faults.append(f"{relative(path)} is missing")
        elif difference := pictures.difference(path.read_bytes(), fresh, exact):
            self.faults.append(f"{relative(path)} is stale: {difference}")

    def stray(self, path):
        self.faults.append(f"{relative(path)}: nothing makes this picture; delete it")

    def finish(self):
        for fault in self.faults:
            print(fault)
        if self.faults:
            print(f"gen --check: {plural(len(self.faults), 'fault')}; `./ballpit gen` "
                  "mends what is stale")
            return FAILED
        print(f"gen --check: {plural(self.compared, 'file')} compared, all fresh")
        return 0


class Writer:
    """Writes what changed, and says so."""

    def __init__(self):
        self.written, self.kept = 0, 0

    def text(self, path, fresh):
        if path.exists() and path.read_text() == fresh:
            self.kept += 1
        else:
            self.put(path, fresh)

    def starter(self, path, fresh):
        """A student's own work is copied before a starter takes its place."""
        if path.exists() and path.read_text() not in (fresh, committed(path)):
            print(f"kept your version of {relative(path)}: {relative(back_up(path))}")
        self.text(path, fresh)

    def lesson(self, path, stale, fresh):
        self.text(path, fresh)

    def picture(self, path, fresh, exact):
        if path.exists() and not pictures.difference(path.read_bytes(), fresh, exact):
            self.kept += 1
        else:
            self.put(path, fresh)

    def stray(self, path):
        print(f"note: nothing makes {relative(path)}; delete it")

    def put(self, path, fresh):
        write(path, fresh)
        print(f"wrote {relative(path)}")
        self.written += 1

    def finish(self):
        print(f"gen: {plural(self.written, 'file')} written, {self.kept} fresh already")
        return 0


def committed(path):
    """The file's text in git's HEAD, or None."""
    command = ["git", "show", f"HEAD:{relative(path)}"]
    try:
        result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    except OSError:
        return None
    return result.stdout if result.returncode == 0 else None


def make_starters(chapter, workshop):
    for solution in chapter.solutions:
        piece = markers.parse(solution.read_text(), relative(solution))
        workshop.starter(chapter.student_file(solution), markers.starter(piece))


def make_lesson(chapter, workshop):
    path = chapter.path / "README.md"
    name = relative(path)
    now = blocks.split(path.read_text(), name)
    fresh = [part if isinstance(part, str)
             else dataclasses.replace(part, content=blocks.fresh_content(chapter, part, name))
             for part in now]
    stale = [(old, new) for old, new in zip(now, fresh) if old != new]
    workshop.lesson(path, stale, blocks.joined(fresh))


def make_pictures(chapter, workshop, text_only):
    folder = chapter.path / "figures"
    for name, svg in pictures.drawn(chapter):
        workshop.text(folder / name, svg)
    if not text_only:
        wanted = blocks.pictured_mutants(chapter)
        exact = not pictures.mistakes_are_rendered(chapter)
        put_pictures(chapter, workshop, wanted, pictures.of_mistakes, exact)
        wanted = pictures.photographs(chapter)
        put_pictures(chapter, workshop, wanted, pictures.rendered, exact=False)
    expected = pictures.expected_names(chapter)
    for path in sorted(folder.glob("*")):
        if path.name not in expected:
            workshop.stray(path)


def put_pictures(chapter, workshop, wanted, make, exact):
    """PNGs: our own canvas draws the same pixels everywhere, OpenGL's drivers only nearly so."""
    if not wanted:
        return
    if why := pictures.why_skipped(rendering=not exact):
        print(f"skipped: PNG pictures of chapter {chapter.label}: {why}")
        return
    for name, content in make(chapter):
        workshop.picture(chapter.path / "figures" / name, content, exact)
