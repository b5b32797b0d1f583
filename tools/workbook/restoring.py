"""`reset`: the starter again, for a whole chapter or one hole. What was there is kept."""

from workbook import holes, markers
from workbook.chapters import find
from workbook.errors import InputError
from workbook.files import back_up, relative, write


def register(commands):
    reset = commands.add_parser("reset", help="the starter again; your version is kept")
    reset.add_argument("chapter", metavar="NN")
    reset.add_argument("hole", nargs="?", metavar="HOLE", help="only this hole")
    reset.set_defaults(run=reset_files)


def reset_files(args):
    chapter = find(args.chapter)
    if not chapter.solutions:
        raise InputError(f"chapter {chapter.label} has no file of yours: there is nothing to reset")
    wanted = holes.named(chapter, args.hole).id if args.hole else None
    changed = 0
    for solution, piece in zip(chapter.solutions, chapter.pieces()):
        hole = next((hole for hole in piece.holes if hole.id == wanted), None)
        if hole or not wanted:
            changed += restore(chapter.student_file(solution), piece, hole)
    if not changed:
        print(f"Nothing to do: {wanted or f'chapter {chapter.label}'} is as it was at the start.")
    return 0


def restore(file, piece, hole):
    """Puts the starter, or one hole of it, into a student's file. True if that changed anything."""
    # As bytes and back: line ends and letters of any encoding stay as the student saved them.
    now = file.read_bytes().decode(errors="surrogateescape") if file.exists() else None
    if now is None and hole:
        raise InputError(f"{relative(file)} is missing: reset the whole chapter, without a hole")
    fresh = holes.with_starter(now, hole, relative(file)) if hole else markers.starter(piece)
    if now == fresh:
        return False
    if now is not None:
        print(f"kept your version: {relative(back_up(file))}")
    write(file, fresh.encode(errors="surrogateescape"))
    print(f"restored {f'{hole.id} in ' if hole else ''}{relative(file)}")
    return True
