"""A verdict in words: what was tested, what is wrong, and what to type next."""

from pathlib import Path

from workbook import chapters, files, markers
from workbook.terminal import paint, plural

COLOURS = {"CORRECT": "green", "TODO": "yellow", "RACY": "magenta"}
ELEMENTS_SHOWN = 3
FAILURES_IN_FULL = 3


def text(verdict):
    """The whole text, without the speed."""
    lines = header(verdict)
    if verdict.error:
        lines += ["", *verdict.error.lines(), "", f"all of it: {verdict.error.log}"]
        return "\n".join(lines)
    lines += holes(verdict)
    # Behind an open hole, a wrong answer says nothing.
    shown = verdict.wrong_already if verdict.holes else verdict.failed
    for result in shown[:FAILURES_IN_FULL]:
        lines += ["", *failure(result)]
    if len(shown) > FAILURES_IN_FULL:
        lines += ["", "also wrong, perhaps for the same reason:"]
        lines += [f"  {in_one_line(result)}" for result in shown[FAILURES_IN_FULL:]]
    for crash in verdict.crashes:
        lines += ["", *crashed(crash)]
    if verdict.gave_up:
        lines += ["", "the checks behind the fifth crash did not run"]
    if verdict.timeout:
        lines += ["", *timed_out(verdict.timeout)]
    lines += ["", counts(verdict)]
    if verdict.state == "CORRECT":
        return "\n".join(lines + [f"measured: {answer}" for answer in verdict.measured])
    if verdict.state != "TODO":
        lines += [f"picture: {files.relative(Path(path))} (yours | reference | errors in red)"
                  for path in verdict.pictures]
    return "\n".join(lines + next_steps(verdict))


def header(verdict):
    state = paint(verdict.state, COLOURS.get(verdict.state, "red"))
    lines = [f"{state}  {', '.join(verdict.files)}"]
    if verdict.devices:
        lines.append(f"  tested on {', '.join(verdict.devices)}, seed {verdict.seed}")
    return lines + [f"  not tested on {skipped['device']}: {skipped['why']}"
                    for skipped in verdict.skipped]


def holes(verdict):
    """The open holes that were reached, each with its place and task."""
    if not verdict.holes:
        return []
    places = hole_places(verdict.chapter)
    lines = ["", f"{plural(len(verdict.holes), 'open hole')}:"]
    for hole in verdict.holes:
        where, task = places.get(hole, ("", ""))
        lines.append(f"  {where}  {hole}: {task}" if where else f"  {hole}")
    return lines


def hole_places(label):
    """id -> ("file:line", task) for the holes of a chapter's student's files."""
    chapter, places = chapters.find(label), {}
    tasks = {hole.id: hole.task for hole in chapter.holes()}
    for solution in chapter.solutions:
        file = chapter.student_file(solution)
        if file.exists():
            for hole, (line, _) in markers.student_holes(file.read_text(errors="replace")).items():
                places[hole] = f"{file.relative_to(chapters.ROOT)}:{line}", tasks.get(hole, "")
    return places


def failure(result):
    """One failing check: its claim, the first wrong elements, a guess."""
    word = {"racy": "racy", "cuda error": "CUDA error"}.get(result["state"], "wrong")
    lines = [paint(f"{word}: {result['id']} ({result['device']})", "bold")]
    if result.get("claim"):
        lines.append(f"  should hold: {result['claim']}")
    elements = result.get("failures", [])[:ELEMENTS_SHOWN]
    lines += [f"  {one['what']}: got {one['got']}, expected {one['expected']}" for one in elements]
    more = result.get("failure_count", len(elements)) - len(elements)
    if more > 0:
        lines.append(f"  ... and {more} more")
    if result.get("message"):
        lines.append(f"  {result['message']}")
    if result.get("looks_like"):
        lines.append(f"  looks like: {result['looks_like']}")
    return lines


def in_one_line(result):
    """A failing check in brief: its first wrong element."""
    first = next(iter(result.get("failures", [])), None)
    words = (f"{first['what']}: got {first['got']}, expected {first['expected']}" if first
             else result.get("message", ""))
    return f"{result['id']} ({result['device']})  {words}"


def _check_name(report):
    if not report["id"]:
        return "before the first check"
    return report["id"] + (f" ({report['device']})" if report["device"] else "")


def crashed(crash):
    return [paint(f"crashed: {_check_name(crash)}", "bold"),
            f"  {crash['out_of_bounds'] or crash['how']}"]


def timed_out(timeout):
    return [paint(f"did not end: {_check_name(timeout)}", "bold"),
            f"  it was stopped after {timeout['limit']:g} s; the checks behind it did not run"]


def counts(verdict):
    total = len(verdict.results) + len(verdict.crashes) + (1 if verdict.timeout else 0)
    already = " already" if verdict.holes else ""
    return f"{verdict.passed_count} of {plural(total, 'check')} passed{already}"


def speed(timing):
    """What speed.measure() gave, in one line."""
    yours, solution = timing["yours"], timing["solution"]
    return (f"speed: yours {yours:.3g} ms, the solution's {solution:.3g} ms, ratio "
            f"{yours / solution:.2f} ({timing['count']} balls, medians of {timing['pairs']})")


def next_steps(verdict):
    """The exact commands that help now."""
    if verdict.holes and not verdict.wrong_already:
        return [f"hint:  ./ballpit hint {verdict.chapter} {verdict.holes[0]}"]
    reports = verdict.wrong_already or verdict.failed + verdict.crashes + ([verdict.timeout] if verdict.timeout else [])
    check = reports[0]["id"]
    if not check:
        return help_with(verdict.chapter)
    seed = f" --seed {verdict.seed}" if verdict.seed is not None else ""
    return [f"again: ./ballpit check {verdict.chapter} --case {check}{seed}{verdict.options}",
            f"why:   ./ballpit explain {check}", *help_with(verdict.chapter, check)]


def help_with(label, check=""):
    """Hints are there for holes, and many a check is named like the hole it looks at. A chapter
    without holes can only be as it was at the start."""
    ids = [hole.id for hole in chapters.find(label).holes()]
    if not ids:
        return [f"back:  ./ballpit reset {label}"]
    return [f"hint:  ./ballpit hint {label} {check if check in ids else 'HOLE'}"
            + ("" if check in ids else f"  (HOLE: {', '.join(ids)})")]
