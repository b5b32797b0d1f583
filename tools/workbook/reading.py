"""What students read: hint, explain, diff, solution. (And reset, which is in restoring.py.)"""

import difflib
import json
import re
import shutil
import textwrap

from workbook import holes, lessons, record, reference, restoring
from workbook.chapters import ROOT, all_chapters, find
from workbook.errors import InputError
from workbook.files import relative, write

HINTS_SEEN = ROOT / "build" / "hints.json"
LONGEST_LINE = 100
NARROWEST_COLUMN = 36  # below that, "yours | solution" is set one under the other


def register(commands):
    hint = commands.add_parser("hint", help="a question, an idea, pseudocode: one step at a time")
    hint.add_argument("chapter", metavar="NN")
    hint.add_argument("hole", nargs="?", help="default: the first hole that is still open")
    hint.add_argument("--more", action="store_true", help="one hint more than last time")
    hint.set_defaults(run=show_hint)
    explain = commands.add_parser("explain", help="what a check claims, and why it matters")
    explain.add_argument("check", metavar="CHECK", help="its id, as a verdict shows it")
    explain.set_defaults(run=explain_check)
    diff = commands.add_parser("diff", help="what a chapter adds to the one before")
    diff.add_argument("chapter", metavar="NN")
    diff.set_defaults(run=show_diff)
    solution = commands.add_parser("solution", help="your holes beside the finished ones")
    solution.add_argument("chapter", metavar="NN")
    solution.add_argument("--spoil", action="store_true", help="even before yours is CORRECT")
    solution.set_defaults(run=show_solution)
    restoring.register(commands)


def line_width():
    return min(shutil.get_terminal_size().columns, LONGEST_LINE)


# ---- hint ---------------------------------------------------------------------------------------

def show_hint(args):
    chapter = find(args.chapter)
    holes.require_any(chapter, "nothing to hint at")
    hole = holes.named(chapter, args.hole) if args.hole else holes.first_open(chapter)
    if not hole:
        print(f"Every hole of chapter {chapter.label} is filled. Name one for its hints: "
              + ", ".join(hole.id for hole in chapter.holes()))
        return 0
    hints = lessons.hints_of(chapter).get(hole.id, [])
    if not hints:
        raise InputError(f"chapter {chapter.label} has no hints for {hole.id} yet")
    level = next_level(hole.id, args.more, len(hints))
    print(f"{hole.id}: {hole.task}\n")
    for number, hint in enumerate(hints[:level], 1):
        print(textwrap.indent(hint, "   ").replace("   ", f"{number}. ", 1) + "\n")
    if level < len(hints):
        print(f"Still stuck? ./ballpit hint {chapter.label} {hole.id} --more")
    else:
        print(f"That was the last hint. ./ballpit solution {chapter.label} --spoil shows the code.")
    return 0


def next_level(hole, more, last):
    """How many hints to show: as many as last time, one at first, one more with --more."""
    try:
        seen = json.loads(HINTS_SEEN.read_text())
    except (OSError, ValueError):
        seen = {}
    level = min(max(seen.get(hole, 0) + more, 1), last)
    if level != seen.get(hole):
        write(HINTS_SEEN, json.dumps(seen | {hole: level}, indent=1) + "\n")
    return level


# ---- explain ------------------------------------------------------------------------------------

def ids_in_source(chapter):
    """Check ids, read from the source: no build is needed to find the chapter of a check."""
    files = sorted((ROOT / "tests" / "checks").glob(f"check_{chapter.label}*.cu*"))
    text = "".join(file.read_text() for file in files)
    return re.findall(r'\{\s*"([a-z0-9_]+\.[a-z0-9_]+)",', text)


def explain_check(args):
    chapters = {identifier: chapter for chapter in all_chapters()
                for identifier in ids_in_source(chapter)}
    named = [chapter for chapter in all_chapters()
             if args.check in (chapter.label, chapter.folder, chapter.folder[3:])]
    if named:
        print(f"The checks of chapter {named[0].folder}:\n")
        for check in reference.checks(named[0]):
            print(f"  {check['id']:<20} {check['claim']}")
        return 0
    if args.check not in chapters:
        near = difflib.get_close_matches(args.check, chapters, 3, 0.4) or list(chapters)[:3]
        raise InputError(f"unknown check '{args.check}': the nearest are {', '.join(near)}")
    chapter = chapters[args.check]
    check = next(check for check in reference.checks(chapter) if check["id"] == args.check)
    print(f"{args.check} (chapter {chapter.folder})\n")
    for title, words in (("claim", check["claim"]), ("why", check["why"])):
        print(textwrap.fill(words, line_width(), initial_indent=f"  {title + ':':<7}",
                            subsequent_indent=" " * 9))
    print(f"\n  run it alone: ./ballpit check {chapter.label} --case {args.check}")
    return 0


# ---- diff ---------------------------------------------------------------------------------------

def show_diff(args):
    chapter = find(args.chapter)
    earlier = [other for other in all_chapters() if other.number < chapter.number]
    print(f"{chapter.folder}" + (f", after {earlier[-1].folder}" if earlier else ""))
    for solution, piece in zip(chapter.solutions, chapter.pieces()):
        tasks = ", ".join(hole.id for hole in piece.holes)
        print(f"\nnew piece {solution.name}: {purpose(solution)}\n  to write: {tasks}")
    print("\nnew files")
    for file in files_of(chapter):
        print(f"  {relative(file)}")
    if not earlier:
        print("\nIt is the first chapter: there is nothing to compare with.")
        return 0
    mains = [other.path / "main.cu" for other in (earlier[-1], chapter)]
    texts = [main.read_text().splitlines() if main.exists() else [] for main in mains]
    print("\nmain.cu")
    print("\n".join(difflib.unified_diff(*texts, *map(relative, mains), lineterm="")))
    return 0


def purpose(file):
    """A file's first line says what it teaches."""
    first = file.read_text().split("\n")[0].lstrip("/ ")
    return re.sub(r"^Chapter \d+: ", "", first)


def files_of(chapter):
    """A chapter's own files, without its pictures."""
    folders = [ROOT / "solutions" / chapter.folder, chapter.path]
    files = [file for folder in folders for file in sorted(folder.glob("*")) if file.is_file()]
    checks = (ROOT / "tests" / "checks").glob(f"*_{chapter.label}.*")
    return files + sorted(checks)


# ---- solution -----------------------------------------------------------------------------------

def show_solution(args):
    chapter = find(args.chapter)
    holes.require_any(chapter, "no solution to show")
    if not args.spoil and not record.is_correct(chapter):
        raise InputError(f"the solution opens when ./ballpit check {chapter.label} says CORRECT "
                         "about your present files; --spoil shows it now")
    contents = holes.student_texts(chapter)
    for hole in chapter.holes():
        yours = contents.get(hole.id, ["(the frame of this hole is not in your file)"])
        print(f"---- {hole.id}: {hole.task}\n")
        print("\n".join(side_by_side(dedented(yours), dedented(hole.solution))) + "\n")
    return 0


def dedented(lines):
    return textwrap.dedent("\n".join(lines)).split("\n")


def side_by_side(yours, solution):
    """Both versions in two columns, or one under the other where the terminal is narrow."""
    column = (shutil.get_terminal_size().columns - 3) // 2
    if column < NARROWEST_COLUMN:
        return ["yours:", *yours, "", "solution:", *solution]
    left, right = ([part for line in lines for part in textwrap.wrap(
        line, column, drop_whitespace=False, subsequent_indent="    ") or [""]]
        for lines in (["yours", "-" * column, *yours], ["solution", "-" * column, *solution]))
    height = max(len(left), len(right))
    left += [""] * (height - len(left))
    right += [""] * (height - len(right))
    return [f"{a:<{column}} | {b}".rstrip() for a, b in zip(left, right)]
