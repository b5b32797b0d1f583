"""The holes of a chapter in the student's files: which is meant, what stands in it, is it open?"""

from workbook import markers
from workbook.errors import InputError


def named(chapter, name):
    """The hole that a user means by "hash.cell" or "cell"."""
    for hole in chapter.holes():
        if name in (hole.id, hole.id.split(".")[1]):
            return hole
    raise InputError(f"chapter {chapter.label} has no hole '{name}': there are "
                     + ", ".join(hole.id for hole in chapter.holes()))


def require_any(chapter, what):
    """Chapters to read and look at have no holes."""
    if not chapter.holes():
        raise InputError(f"chapter {chapter.label} has no holes, so there is {what}")


def student_texts(chapter):
    """What stands in each hole of the student's files: id -> lines."""
    contents = {}
    for solution in chapter.solutions:
        file = chapter.student_file(solution)
        if file.exists():
            found = markers.student_holes(file.read_text(errors="replace"))
            contents.update({hole: lines for hole, (_, lines) in found.items()})
    return contents


def is_open(hole, contents):
    """Whether the student's version of a hole still calls TODO_HOLE (in a comment it does not)."""
    code = [line.split("//")[0] for line in contents.get(hole.id, [])]
    return any(f'TODO_HOLE("{hole.id}")' in line for line in code)


def first_open(chapter):
    """The first hole that the student has not filled yet, or None."""
    contents = student_texts(chapter)
    return next((hole for hole in chapter.holes() if is_open(hole, contents)), None)


def with_starter(text, hole, name):
    """The student's text with the starter's lines in one hole; all else stays as it is. `name` is
    the file's, for errors."""
    lines = text.splitlines(keepends=True)
    first, inside = markers.student_holes(text).get(hole.id, (0, []))
    end = first + len(inside)
    closing = lines[end].strip() if end < len(lines) else ""
    # A frame that was copied or has lost its end must not take other lines with it.
    if not first or closing != f"// ---- end of {hole.id}":
        raise InputError(f"{name} has not one whole frame of {hole.id} (the comments around it): "
                         "reset the whole chapter, without a hole")
    return "".join([*lines[:first], *(line + "\n" for line in hole.starter), *lines[end:]])
