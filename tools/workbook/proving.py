"""prove and mutants: the checks are checked. Starters must fail for the right reason, solutions
must pass, and every classic mistake must be caught by the check that is there for it."""

import json
from pathlib import Path

from workbook import (build, chapters, checking, compile_errors, explaining, markers, processes,
                      variants)
from workbook.errors import InputError, ToolError
from workbook.mutants import apply, mutants_of
from workbook.terminal import print_outcome, uncoloured
from workbook.verdict import EXIT_CODES, Verdict

RACE_TRIES = 6


def register(commands):
    prove = commands.add_parser("prove", help="for authors: starters fail rightly, solutions pass")
    prove.set_defaults(run=prove_command)
    mutants = commands.add_parser("mutants", help="for authors: every classic mistake is caught")
    mutants.add_argument("--keep-pictures", metavar="FOLDER", type=Path,
                         help="save the mutants' pictures as FOLDER/NN/bug_<mutant>.png")
    mutants.set_defaults(run=mutants_command)
    for command in (prove, mutants):
        command.add_argument("chapters", nargs="*", help="numbers or names (default: all)")
        command.add_argument("--json", action="store_true", help="as one line of JSON")
        command.add_argument("--time-limit", type=checking.positive, default=checking.TIME_LIMIT,
                             metavar="S", help="seconds that one check may take")


def run_all(args, jobs_of, jobs_of_all=()):
    """Runs `jobs_of(chapter)`: (name, function -> problem or ""), two at a time, and where no
    chapter is named `jobs_of_all`; prints a line for each and a summary. Exit code 1 if there was a
    problem."""
    wanted = [checking.find_checked(word) for word in args.chapters] or build.buildable(
        [chapter for chapter in chapters.all_chapters() if chapter.solutions])
    if not wanted:
        raise ToolError("there is no chapter with pieces, so nothing is shown")
    planned = [(chapter.label, name, job) for chapter in wanted for name, job in jobs_of(chapter)]
    if not args.chapters:
        planned += [("10", name, job) for name, job in jobs_of_all]
    outcomes = []
    for chapter in wanted:
        build.build([f"check_{chapter.label}_reference"])
        build.set_mine(chapter, {chapter})
    results = processes.results_of([job for _, _, job in planned])
    # strict: reads the results to their end. A generator left before it would end all children.
    for (label, name, _), problem in zip(planned, results, strict=True):
        outcomes.append({"chapter": label, "name": name, "problem": problem})
        if not args.json:
            print_outcome(f"{label} {name}", problem)
    failed = sum(bool(outcome["problem"]) for outcome in outcomes)
    if args.json:
        print(json.dumps({"ok": len(outcomes) - failed, "failed": failed, "outcomes": outcomes}))
    else:
        print(f"{len(outcomes) - failed} ok, {failed} failed")
    return 1 if failed else 0


def verdict_on(program, chapter, args, options=(), picture=None):
    verdict = Verdict(chapter.label)
    checking.run_checks(program, list(options), verdict, processes.Printed(), args.time_limit,
                        picture)
    return verdict


def compiled(target, label, name, texts):
    """(executable, "") or (None, why not). `texts`: a solution's path -> the changed text."""
    program, log = variants.compile_variant(target, label, name, {
        f"{solution.parent.name}/{solution.name}": text for solution, text in texts.items()})
    if program:
        return program, ""
    error = compile_errors.find(log, [])
    return None, f"does not build: {error.lines()[0] if error else log}"


# ---- prove ---------------------------------------------------------------------------------------

def prove_command(args):
    whole = ("the whole system from filled starters ends in the same state", whole_system)
    return run_all(args, lambda chapter: proofs(chapter, args), [whole])


def proofs(chapter, args):
    """The starter, each hole alone, the starter with every hole filled, the solution."""
    every = {hole.id for hole in chapter.holes()}
    if every:  # chapter 00 has none: there is a piece to look at
        yield "the starter is TODO with all its holes", lambda: proof(chapter, args, every)
    for hole in sorted(every):
        yield f"{hole} alone is TODO", lambda hole=hole: proof(chapter, args, {hole})
    yield "the starter with every hole filled is CORRECT", lambda: proof(chapter, args, set())
    yield "the solution is CORRECT", lambda: judge(
        verdict_on(build.executable(f"check_{chapter.label}_reference"), chapter, args), set())


def proof(chapter, args, opened):
    """What is wrong when exactly the holes of `opened` are open? "" if nothing is."""
    solved = {hole.id for hole in chapter.holes()} - opened
    texts = starters(chapter, solved)
    if len(opened) == 1:  # "every hole filled" shows that the other starters are right
        texts = {path: text for path, text in texts.items() if opened <= holes_in(path)}
    name = f"open_{'_'.join(sorted(opened))}" if len(opened) == 1 else f"open_{len(opened)}"
    program, problem = compiled(f"check_{chapter.label}", chapter.label, name, texts)
    return problem or judge(verdict_on(program, chapter, args), opened)


def starters(chapter, solved):
    """Each piece's starter with the holes `solved` filled."""
    return {solution: markers.starter(piece, solved)
            for solution, piece in zip(chapter.solutions, chapter.pieces())}


def holes_in(solution):
    return {hole.id for hole in markers.parse(solution.read_text(), str(solution)).holes}


def whole_system():
    """gravity_fall from every chapter's starter with all holes filled, against the solutions'."""
    build.build(["gravity_fall"])
    texts = {}
    for chapter in chapters.all_chapters():
        texts |= starters(chapter, {hole.id for hole in chapter.holes()})
    program, problem = compiled("10_full_system", "10", "all_filled", texts)
    if problem:
        return problem
    hashes = []
    for executable in (program, build.executable("gravity_fall")):
        command = [str(executable), "--frames", "200", "--device", "cpu", "--json"]
        hashes.append(json.loads(processes.output_of(command) or "{}").get("state_hash"))
    return "" if hashes[0] and hashes[0] == hashes[1] else f"the hashes are {hashes}"


def judge(verdict, opened):
    """Exactly the holes of `opened` must be reported, and nothing may crash or hang."""
    if set(verdict.holes) != opened:
        return f"open are {words(opened)}, reported were {words(verdict.holes)}"
    if verdict.crashes:
        return one_line(explaining.crashed(verdict.crashes[0]))
    if verdict.timeout:
        return one_line(explaining.timed_out(verdict.timeout))
    if not opened and verdict.state != "CORRECT":
        return f"{verdict.state}: {words(result['id'] for result in verdict.failed)}"
    return ""


def one_line(lines):
    return uncoloured("; ".join(line.strip() for line in lines))


def words(ids):
    return ", ".join(sorted(ids)) or "none"


# ---- mutants -------------------------------------------------------------------------------------

def mutants_command(args):
    if args.keep_pictures:
        args.keep_pictures = args.keep_pictures.absolute()
    return run_all(args, lambda chapter: hunts(chapter, args))


def hunts(chapter, args):
    found = mutants_of(chapter)
    if not found and chapter.holes():
        yield "has mutants", lambda: f"write tests/checks/mutants_{chapter.label}.txt"
    for mutant in found:
        if mutant.state not in EXIT_CODES:
            raise ToolError(f"{mutant.where}: unknown state '{mutant.state}'")
        texts = apply(mutant, chapter)
        yield (f"{mutant.name} is caught by {mutant.caught_by}",
               lambda mutant=mutant, texts=texts: hunt(chapter, mutant, texts, args))


def hunt(chapter, mutant, texts, args):
    """Why the mutant was not rejected as it must be; "" if it was."""
    program, problem = compiled(f"check_{chapter.label}", chapter.label,
                                f"mutant_{mutant.name}", texts)
    if problem:
        return problem
    # On a busy machine the threads of a race may hardly meet: then it shows in part, or not at all.
    for _ in range(RACE_TRIES if mutant.state == "RACY" else 1):
        problem = not_rejected(mutant, verdict_on(program, chapter, args))
        if not problem:
            break
    return problem or (save_picture(chapter, mutant, program, args) if mutant.picture else "")


def not_rejected(mutant, verdict):
    """What this verdict on a mutant lacks; "" if nothing."""
    reports = verdict.rejects(mutant.caught_by)
    if verdict.state != mutant.state:
        return f"the verdict is {verdict.state}, not {mutant.state}"
    if not reports:
        others = words({report["id"] for report in verdict.failed + verdict.crashes})
        return f"that check did not fail, but {others}"
    guesses = [report.get("looks_like", "") for report in reports]
    if not any(mutant.looks_like in guess for guess in guesses):
        return f"no guess says '{mutant.looks_like}': {words(filter(None, guesses))}"
    return ""


def save_picture(chapter, mutant, program, args):
    """The named check's picture, for the lesson."""
    if not args.keep_pictures:
        return ""
    picture = args.keep_pictures / chapter.label / f"bug_{mutant.name}.png"
    try:
        picture.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{picture.parent} cannot be written: {error.strerror}") from None
    verdict_on(program, chapter, args, ["--case", mutant.caught_by], picture)
    return "" if picture.exists() else f"{mutant.caught_by} drew no picture"
