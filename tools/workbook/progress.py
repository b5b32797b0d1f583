"""status: which chapters are done, and what to do next."""

import json

from workbook import chapters, holes, markers, record
from workbook.terminal import paint, plural

BAR_WIDTH = 30


def register(commands):
    status = commands.add_parser("status",
                                 help="what is done, and what comes next (also: no command)")
    status.add_argument("--json", action="store_true", help="as one line of JSON")
    status.set_defaults(run=status_command)


def state_of(chapter):
    """A chapter's state in words: the last verdict, and whether it is still about these files."""
    if not chapter.solutions:
        return "to read"
    state, edited = record.last_state(chapter)
    if state:
        return f"{state}, edited since" if edited else state
    return "not checked yet" if is_begun(chapter) else "not started"


def is_begun(chapter):
    """Has a student's file changed from its starter?"""
    for solution, piece in zip(chapter.solutions, chapter.pieces()):
        file = chapter.student_file(solution)
        if file.exists() and file.read_text(errors="replace") != markers.starter(piece):
            return True
    return False


def next_step(chapter, state):
    """The exact command or file with which to go on."""
    check = f"./ballpit check {chapter.label}"
    if state == "not started":
        return f"read chapters/{chapter.folder}/README.md, then {check}"
    if state in ("TODO", "not checked yet") and (hole := holes.first_open(chapter)):
        return f"fill {hole.id} (./ballpit hint {chapter.label} {hole.id}), then {check}"
    return check


def status_command(args):
    every = chapters.all_chapters()
    states = {chapter: state_of(chapter) for chapter in every}
    work = [chapter for chapter in every if states[chapter] != "to read"]
    done = [chapter for chapter in work if states[chapter] == "CORRECT"]
    pending = [chapter for chapter in work if chapter not in done]
    step = next_step(pending[0], states[pending[0]]) if pending else "./ballpit demo"
    if args.json:
        print(json.dumps({"chapters": {chapter.folder: states[chapter] for chapter in every},
                          "done": len(done), "of": len(work), "next": step}))
        return 0
    for chapter in every:
        print(f"  {chapter.folder:<24} {describe(chapter, states[chapter])}")
    filled = BAR_WIDTH * len(done) // max(len(work), 1)
    print(f"\n  [{'#' * filled}{'.' * (BAR_WIDTH - filled)}] {len(done)} of "
          f"{plural(len(work), 'chapter')} done\n  next: {step}\n  all commands: ./ballpit help")
    return 0


def describe(chapter, state):
    if state == "CORRECT":
        return paint(state, "green")
    contents, every = holes.student_texts(chapter), chapter.holes()
    count = sum(holes.is_open(hole, contents) for hole in every)
    return state + (f" ({count} of {plural(len(every), 'hole')} open)" if count else "")
