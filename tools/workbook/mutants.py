"""Classic mistakes: reads tests/checks/mutants_NN.txt and puts one into a finished piece."""

from dataclasses import dataclass, field

from workbook import markers
from workbook.chapters import ROOT
from workbook.errors import ToolError


@dataclass
class Mutant:
    name: str
    where: str             # file:line of its first line
    caught_by: str = ""
    looks_like: str = ""
    state: str = "WRONG"
    picture: bool = False
    changes: list = field(default_factory=list)  # pairs: lines that go, lines that come

    @property
    def removed(self):
        return [line for old, _ in self.changes for line in old]


def mutants_of(chapter):
    """The chapter's mutants, in order. ToolError with the line of the first fault."""
    path = ROOT / "tests" / "checks" / f"mutants_{chapter.label}.txt"
    return parse(path.read_text(), str(path.relative_to(ROOT))) if path.exists() else []


def parse(text, path):
    found = []
    previous = ""
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{path}:{number}"
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("mutant "):
            found.append(Mutant(line[len("mutant "):].strip(), where))
            if [mutant.name for mutant in found].count(found[-1].name) > 1:
                raise ToolError(f"{where}: there are two mutants {found[-1].name}")
        elif not found:
            raise ToolError(f"{where}: expected `mutant NAME` first")
        else:
            _take(found[-1], line, previous, where)
        previous = line[0]
    for mutant in found:
        if not mutant.caught_by or not mutant.changes:
            raise ToolError(f"{mutant.where}: mutant {mutant.name} needs a line `caught by CHECK` "
                            "and a change")
    return found


def _take(mutant, line, previous, where):
    """One line of a mutant."""
    if line.startswith("-"):
        if previous != "-":
            mutant.changes.append(([], []))
        mutant.changes[-1][0].append(line[1:])
    elif line.startswith("+"):
        if not mutant.changes:
            raise ToolError(f"{where}: a `+` line without a `-` line before it")
        mutant.changes[-1][1].append(line[1:])
    elif line.startswith("caught by "):
        mutant.caught_by = line[len("caught by "):].strip()
    elif line.startswith("looks like "):
        mutant.looks_like = line[len("looks like "):].strip()
    elif line.startswith("state "):
        mutant.state = line[len("state "):].strip()
    elif line.strip() == "picture":
        mutant.picture = True
    else:
        raise ToolError(f"{where}: not understood: {line}")


def apply(mutant, chapter):
    """The chapter's finished pieces that have the mistake in: path -> text."""
    texts = {solution: markers.plain(piece)
             for solution, piece in zip(chapter.solutions, chapter.pieces())}
    changed = set()
    for old, new in mutant.changes:
        block = "\n" + "\n".join(old) + "\n"
        places = [(path, ("\n" + text).count(block)) for path, text in texts.items()]
        total = sum(count for _, count in places)
        if total != 1:
            raise ToolError(f"{mutant.where}: the `-` lines of {mutant.name} must occur once in "
                            f"the piece, not {total} times: {old[0].strip()}")
        path = next(path for path, count in places if count)
        replacement = "\n" + "".join(line + "\n" for line in new)
        texts[path] = ("\n" + texts[path]).replace(block, replacement)[1:]
        changed.add(path)
    return {path: texts[path] for path in texts if path in changed}
