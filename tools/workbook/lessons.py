"""What every lesson must hold, whatever its chapter: docs/authoring.md, "Lessons"."""

import re

from workbook import blocks, reference
from workbook.chapters import ROOT
from workbook.files import relative

SECTIONS = ["Before and after", "You will be able to", "The idea", "Invariants", "Predict first",
            "Files", "Tasks", "What you should see", "If it looks like this", "On the GPU",
            "Measure", "Check yourself", "Go further", "What changed since the last chapter",
            "Reading"]
WORDS = range(600, 1201)
HINTS = 3
COLUMNS = 110
LINK = re.compile(r"(?P<picture>!?)\[(?P<text>[^\]]*)\]\((?P<target>[^)\s]+)[^)]*\)")
MENTION = re.compile(r"(?<![\w./-])([a-z0-9_]+\.[a-z0-9_]+)(?![\w/(]|\.\w)")
COMMAND = re.compile(r"\./ballpit explain (\S+?)[`,.;:)]*(?:\s|$)|--case (\S+?)[`,.;:)]*(?:\s|$)")


def faults(chapter):
    """Everything wrong with a chapter's lesson and hints, one line each."""
    path = chapter.path / "README.md"
    name = relative(path)
    parts = blocks.split(path.read_text(), name)
    prose = own_lines(parts)
    found = [*section_faults(prose), *length_faults(prose), *link_faults(prose, path.parent),
             *task_faults(chapter, parts), *mention_faults(chapter, parts)]
    return [f"{name}{place}: {what}" for place, what in found] + hint_faults(chapter)


def own_lines(parts):
    """(line number, line) of what the author wrote as text: no generated blocks, no code."""
    lines, fence = [], False
    number = 0
    for part in parts:
        number += 1
        if not isinstance(part, str):
            number += len(part.content) + 1
        elif part.lstrip().startswith("```"):
            fence = not fence
        elif not fence:
            lines.append((number, part))
    return lines


def section_faults(prose):
    headings = [(number, line[3:].strip()) for number, line in prose if line.startswith("## ")]
    names = []
    for number, name in headings:
        if name not in SECTIONS:
            yield f":{number}", f"section '{name}' is not one of a lesson's sections"
        elif name in names:
            yield f":{number}", f"section '{name}' stands here twice"
        names.append(name)
    yield from (("", f"section '{name}' is missing") for name in SECTIONS if name not in names)
    known = [(number, name) for number, name in headings if name in SECTIONS]
    for (_, before), (number, name) in zip(known, known[1:]):
        if SECTIONS.index(name) < SECTIONS.index(before):
            yield f":{number}", f"section '{name}' belongs before '{before}'"


def length_faults(prose):
    text = " ".join(re.sub(r"<[^>]*>|\]\([^)]*\)", " ", line) for _, line in prose)
    count = sum(bool(re.search(r"\w", word)) for word in text.split())
    if count not in WORDS:
        yield "", f"{count} words outside code and blocks: {WORDS[0]} to {WORDS[-1]} are right"
    for number, line in prose:
        plain = LINK.sub(lambda link: link["text"], line)
        if len(plain) > COLUMNS and not line.lstrip().startswith("|"):
            yield f":{number}", f"{len(line)} columns: {COLUMNS} at most"


def link_faults(prose, folder):
    for number, line in prose:
        for link in LINK.finditer(line):
            target = link["target"].split("#")[0]
            if not target or re.match(r"[a-z]+:", target):
                continue
            if not (folder / target).exists():
                what = "picture" if link["picture"] else "link"
                yield f":{number}", f"{what} to {target}, which is not there"
            if link["picture"] and not link["text"]:
                yield f":{number}", f"picture {target} has no words for readers who cannot see it"


def task_faults(chapter, parts):
    """Every hole is named in Tasks: as a heading, or as a row of the generated table."""
    text = blocks.joined(parts)
    tasks = re.search(r"^## Tasks$(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    for hole in chapter.holes():
        if not tasks or f"`{hole.id}`" not in tasks[1]:
            yield "", f"hole {hole.id} has no task in section Tasks"


def mention_faults(chapter, parts):
    """Ids that the text names must exist. A dotted word counts as an id if it begins like one of
    the chapter's; what follows `explain` and `--case` always does."""
    known = {check["id"] for check in reference.checks(chapter)}
    known |= {hole.id for hole in chapter.holes()}
    topics = {identifier.split(".")[0] for identifier in known}
    for number, line in enumerate(blocks.joined(parts).splitlines(), 1):
        codes = " ".join(re.findall(r"`([^`]+)`", line))
        named = {word for word in MENTION.findall(codes) if word.split(".")[0] in topics}
        named |= {word for pair in COMMAND.findall(line) for word in pair
                  if word and not word.isupper()}
        yield from ((f":{number}", f"there is no check or hole '{word}'")
                    for word in sorted(named - known))


def hints_of(chapter):
    """The hints in hints.md: hole id -> list of texts."""
    path = chapter.path / "hints.md"
    if not path.exists():
        return {}
    hints, current = {}, None
    for line in path.read_text().splitlines():
        if line.startswith("## "):
            current = hints.setdefault(line[3:].strip().strip("`"), [])
        elif current is None:
            continue
        elif match := re.match(r"\d+\. +(.*)", line):
            current.append(match[1])
        elif current:
            current[-1] += "\n" + (line[3:] if line.startswith("   ") else line)
    return {identifier: [text.rstrip() for text in texts] for identifier, texts in hints.items()}


def hint_faults(chapter):
    hints = hints_of(chapter)
    name = relative(chapter.path / "hints.md")
    holes = {hole.id: hole for hole in chapter.holes()}
    found = []
    for identifier, hole in holes.items():
        count = len(hints.get(identifier, []))
        if count != HINTS:
            found.append(f"{name}: {identifier} has {count} hints: {HINTS} are right")
        told = "\n".join(hints.get(identifier, []))
        for line in hole.solution:
            if len(line.strip()) > 20 and line.strip() in told:
                found.append(f"{name}: {identifier} gives the code away: {line.strip()}")
    found += [f"{name}: there is no hole '{identifier}'"
              for identifier in hints if identifier not in holes]
    return found
