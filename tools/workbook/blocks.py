"""The generated blocks of a lesson: finds them, and makes their text from the code."""

import csv
import re
import shlex
import textwrap
from dataclasses import dataclass

from workbook import markers, mutants, reference
from workbook.chapters import ROOT
from workbook.errors import InputError, ToolError

OPENING = re.compile(r"<!-- gen (?P<kind>\w+)(?: +(?P<arguments>.*?))? *-->$")
CLOSING = "<!-- /gen -->"


@dataclass
class Block:
    """One generated block and where its opening comment stands."""
    kind: str
    arguments: list
    line: int
    opening: str
    content: list

    @property
    def name(self):
        return " ".join(["gen", self.kind, *self.arguments])


def split(text, path):
    """A lesson's parts in order: lines (str) and Blocks. ToolError if a comment does not match."""
    parts, block = [], None
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.strip()
        if match := OPENING.match(stripped):
            if block:
                raise ToolError(f"{path}:{number}: a block inside the block of line {block.line}")
            try:
                arguments = shlex.split(match["arguments"] or "")
            except ValueError as error:
                raise ToolError(f"{path}:{number}: {error}") from None
            block = Block(match["kind"], arguments, number, line, [])
            parts.append(block)
        elif stripped == CLOSING:
            if not block:
                raise ToolError(f"{path}:{number}: {CLOSING} without a block")
            block = None
        elif stripped.startswith(("<!-- gen", "<!-- /gen")):
            raise ToolError(f"{path}:{number}: not a block's comment: {stripped}")
        else:
            (block.content if block else parts).append(line)
    if block:
        raise ToolError(f"{path}:{block.line}: a block without {CLOSING}")
    return parts


def joined(parts):
    """The lesson's text again."""
    lines = []
    for part in parts:
        lines += [part] if isinstance(part, str) else [part.opening, *part.content, CLOSING]
    return "\n".join(lines) + "\n"


def table(header, rows, right=()):
    """A Markdown table; columns whose numbers are in `right` are set flush right."""
    rules = ["--:" if column in right else "---" for column in range(len(header))]
    cells = [[str(cell).replace("|", "\\|") for cell in row] for row in [header, *rows]]
    lines = ["| " + " | ".join(row) + " |" for row in cells]
    return [lines[0], "|" + "|".join(rules) + "|", *lines[1:]]


def holes_block(chapter, arguments):
    rows = [(f"`{hole.id}`", hole.lines, hole.task) for hole in chapter.holes()]
    return table(["hole", "lines", "task"], rows, right={1}) if rows else ["No holes."]


def checks_block(chapter, arguments):
    known = {check["id"]: check["claim"] for check in reference.checks(chapter)}
    for identifier in arguments:
        if identifier not in known:
            raise ToolError(f"there is no check '{identifier}': known are {', '.join(known)}")
    return [f"{number}. `{identifier}`: {known[identifier]}"
            for number, identifier in enumerate(arguments or known, 1)]


def code_block(chapter, arguments):
    if len(arguments) != 2:
        raise ToolError("expected: gen code FILE NAME")
    path, name = ROOT / arguments[0], arguments[1]
    if not path.is_file():
        raise ToolError(f"there is no file {arguments[0]}: paths start at the project's folder")
    shown = markers.parse(path.read_text(), arguments[0]).shown
    if name not in shown:
        known = ", ".join(shown) or "none"
        raise ToolError(f"{arguments[0]} has no //@show {name}: there are {known}")
    lines = textwrap.dedent("\n".join(shown[name])).split("\n")
    return ["```cpp", *lines, "```"]


def run_block(chapter, arguments):
    command = " ".join(["./ballpit run", chapter.label, *map(shlex.quote, arguments)])
    output = reference.run(chapter, arguments).rstrip("\n").split("\n")
    return ["```console", f"$ {command}", *(line.rstrip() for line in output), "```"]


def summary_block(chapter, arguments):
    """A run of the whole system, without what differs from machine to machine."""
    opening, command, *lines, closing = run_block(chapter, arguments)
    lines = [re.sub(r" on \w+ \(.*\)$", "", line) for line in lines
             if not line.startswith(("  time per frame", "  planning"))]
    return [opening, command, *lines, closing]


def csv_block(chapter, arguments):
    path = ROOT / "docs" / "results" / (arguments[0] if len(arguments) == 1 else "")
    if not path.is_file():
        raise ToolError("expected: gen csv FILE, with a file in docs/results")
    lines = path.read_text().splitlines()
    notes = [line.lstrip("# ") for line in lines if line.startswith("#")]
    header, *rows = csv.reader(line for line in lines if line and not line.startswith("#"))
    numeric = {column for column in range(len(header))
               if all(re.fullmatch(r"[-+\d.eE]+", row[column]) for row in rows)}
    caption = [f"<sub>{' '.join(notes)}</sub>"] if notes else []
    return [*table(header, rows, numeric), *([""] if caption else []), *caption]


def bugs_block(chapter, arguments):
    rows = []
    for mutant in pictured_mutants(chapter):
        words = mutant.name.replace("_", " ")
        where = [f"`{hole}`" for hole in changed_holes(chapter, mutant)]
        where.append(f"`./ballpit explain {mutant.caught_by}`")
        rows.append((f"![{words}](figures/bug_{mutant.name}.png)", mutant.looks_like or words,
                     ", ".join(where)))
    return table(["picture", "what it looks like", "where to look"], rows) if rows else []


def pictured_mutants(chapter):
    """The chapter's classic mistakes that have a picture."""
    return [mutant for mutant in mutants.mutants_of(chapter) if mutant.picture]


def changed_holes(chapter, mutant):
    """The holes of the student's file in which the mistake lies."""
    return [hole.id for hole in chapter.holes()
            if any(line in hole.solution for line in mutant.removed)]


def clip_block(chapter, arguments):
    from workbook import videos  # it needs this module
    if len(arguments) > 1:
        raise ToolError("expected: gen clip NAME, or gen clip for the chapter's own")
    try:
        recipe = videos.recipe_named(arguments[0] if arguments else chapter.folder)
    except InputError as error:
        raise ToolError(str(error)) from None
    return videos.embedded(recipe, "../../videos/")


KINDS = {"holes": holes_block, "checks": checks_block, "code": code_block, "run": run_block,
         "summary": summary_block, "csv": csv_block, "bugs": bugs_block, "clip": clip_block}


def fresh_content(chapter, block, path):
    """The lines that belong into a block now."""
    if block.kind not in KINDS:
        known = ", ".join(KINDS)
        raise ToolError(f"{path}:{block.line}: unknown block '{block.kind}': there are {known}")
    try:
        return KINDS[block.kind](chapter, block.arguments)
    except ToolError as error:
        raise ToolError(f"{path}:{block.line}: {block.name}: {error}") from None
