"""check and watch: builds a chapter's checks with the student's pieces and runs them."""

import argparse
import json
import tempfile
import time
from pathlib import Path

from workbook import build, chapters, compile_errors, explaining, processes, record, speed
from workbook.chapters import ROOT
from workbook.errors import InputError, ToolError
from workbook.terminal import note
from workbook.verdict import Verdict, how_it_ended

CRASHES_SEEN = 5             # after so many, the rest of the checks is not run
BYTES_PRINTED = 100_000_000  # more than this is a loop that prints
FLOOD = f"it printed more than {BYTES_PRINTED // 1_000_000} MB and was stopped"
TIME_LIMIT = 30.0            # seconds for one check


def register(commands):
    check = commands.add_parser("check", help="test your pieces of a chapter")
    add_options(check)
    check.add_argument("--json", action="store_true", help="the verdict as one line of JSON")
    check.add_argument("--reference", action="store_true", help="test the solution, not your files")
    check.add_argument("--no-speed", action="store_true", help="leave out the speed after CORRECT")
    check.set_defaults(run=check_command)
    watch = commands.add_parser("watch", help="check again at every save; Ctrl-C ends it")
    add_options(watch)
    watch.set_defaults(run=watch_command, json=False, reference=False, no_speed=True)


def add_options(parser):
    parser.add_argument("chapter", help="number or name, as 02 or grid_hash")
    parser.add_argument("--mine", metavar="LIST", default="",
                        help="chapters whose pieces are yours too, as 2,3 or all (up to this one)")
    parser.add_argument("--device", choices=["cpu", "cuda", "all"], default="all",
                        help="the backends to test on (default: all that are present)")
    parser.add_argument("--case", metavar="ID", help="only this check")
    parser.add_argument("--seed", type=int, metavar="N", help="seed of the random scenes")
    parser.add_argument("--time-limit", type=positive, default=TIME_LIMIT, metavar="S",
                        help="seconds that one check may take (default: %(default)g)")


def positive(text):
    value = float(text)
    if not 0 < value < 1e6:
        raise ValueError
    return value


def find_checked(word):
    """The chapter, which must have checks."""
    chapter = chapters.find(word)
    if not (ROOT / "tests" / "checks" / f"check_{chapter.label}.cu").exists():
        raise InputError(f"chapter {chapter.label} has no checks: see "
                         f"chapters/{chapter.folder}/README.md")
    return chapter


def mine(chapter, words):
    """The chapters whose pieces are the student's: this one, and those of "2,3", or with "all" all
    before it. (Chapter 10's system stands behind some checks of earlier ones: its holes are no
    matter of theirs.)"""
    if words == "all":
        return {other for other in chapters.all_chapters() if other.number <= chapter.number}
    return {chapter, *(chapters.find(word.strip()) for word in words.split(",") if word.strip())}


def tested_files(chapters_mine, reference):
    """The files a verdict is about."""
    files = []
    for chapter in sorted(chapters_mine, key=lambda chapter: chapter.number):
        # Given files are in the folder, too; a chapter without holes has nothing else.
        with_holes = [file for file in chapter.solutions if "//@hole " in file.read_text()]
        for solution in with_holes or chapter.solutions:
            files.append(solution if reference else chapter.student_file(solution))
    return files


def check_command(args):
    chapter = find_checked(args.chapter)
    content = record.content_hash(chapter)
    verdict, printed = check(chapter, args)
    if is_whole(args):
        record.remember(chapter, verdict.state, content, explaining.text(verdict))
    if not args.json:
        show_printed(printed)
        print(explaining.text(verdict), flush=True)
    # Last, since it takes a while: an interruption then costs the speed alone.
    if verdict.state == "CORRECT" and is_whole(args) and not args.no_speed:
        verdict.speed = measured_speed(chapter)
    if args.json:
        print(verdict.as_json())
    elif verdict.speed:
        print(explaining.speed(verdict.speed))
    return verdict.exit_code


def check_alone(chapter):
    """The plain `check NN --no-speed`: shows the verdict and returns its exit code."""
    parser = argparse.ArgumentParser()
    add_options(parser)
    args = parser.parse_args([chapter.label])
    args.json, args.reference, args.no_speed = False, False, True
    return check_command(args)


def measured_speed(chapter):
    """The speed is shown, and never spoils a verdict."""
    try:
        return speed.measure(chapter)
    except ToolError as error:
        note(f"no speed: {error}")
        return None


def is_whole(args):
    """Did this run say all about the chapter alone?"""
    return not (args.case or args.reference or args.mine) and args.device == "all"


def show_printed(printed):
    """What the student's own code printed."""
    if printed.line_count == 0:
        return
    for line in printed.lines:
        print(f"| {line}")
    if printed.line_count > len(printed.lines):
        print(f"| ... and {printed.line_count - len(printed.lines)} more lines")
    print()


def check(chapter, args):
    """Builds and runs the chapter's checks. Returns (Verdict, what the program printed)."""
    whose = {chapter} if args.reference else mine(chapter, args.mine)
    files = tested_files(whose, args.reference)
    verdict = Verdict(chapter.label, files=[str(file.relative_to(ROOT)) for file in files])
    verdict.options = repeated_options(args)
    printed = processes.Printed()
    for file in files:
        if not file.exists():
            raise InputError(f"{file.relative_to(ROOT)} is missing: ./ballpit reset "
                             f"{chapter.label} brings back the file you started with")
    target = f"check_{chapter.label}" + ("_reference" if args.reference else "")
    build.require(chapter)
    if not args.reference:
        build.set_mine(chapter, whose)
    if log := build.try_build(target):
        verdict.error = compile_errors.find(log, files)
        if not verdict.error:
            build.fail(f"building {target}", log)
        return verdict, printed
    program = build.executable(target)
    options = ["--device", args.device]
    options += ["--case", args.case] if args.case else []
    options += ["--seed", str(args.seed)] if args.seed is not None else []
    picture = ROOT / "build" / f"check_{chapter.label}.png"
    run_checks(program, options, verdict, printed, args.time_limit, picture)
    return verdict, printed


def repeated_options(args):
    """The options of this call that its repetition needs."""
    options = f" --mine {args.mine}" if args.mine else ""
    options += f" --device {args.device}" if args.device != "all" else ""
    return options + (" --reference" if args.reference else "")


def run_checks(program, options, verdict, printed, time_limit, picture=None):
    """Runs a check program to its end, beyond crashes, and puts all it reports into the verdict."""
    with tempfile.TemporaryDirectory(prefix="ballpit_") as folder:
        events = Path(folder) / "events"
        go_on = []
        while len(verdict.crashes) < CRASHES_SEEN:
            events.write_text("")
            command = [str(program), *options, *go_on, "--events", str(events)]
            if picture and not verdict.pictures:
                command += ["--picture", str(picture)]
            code, stopped = processes.run_watched(command, events, time_limit, BYTES_PRINTED,
                                                  printed)
            verdict.ended = False
            for event in read_events(events):
                verdict.take(event)
            if not events.stat().st_size:
                refuse_start(code, printed)
            if stopped == "time":
                verdict.take_timeout(time_limit)
            if stopped == "time" or (verdict.ended and code >= 0):
                break
            verdict.take_crash(FLOOD if stopped else how_it_ended(code),
                               printed.take_out_of_bounds())
            crashed = verdict.crashes[-1]["id"]
            if verdict.ended or not crashed:
                break
            go_on = ["--after", crashed]
        else:
            verdict.gave_up = True
    if not (verdict.results or verdict.crashes or verdict.timeout):
        raise ToolError(f"{program.name} reported no check at all")


def read_events(file):
    """The complete lines; a crash may have cut the last one."""
    for line in file.read_text(errors="replace").splitlines():
        try:
            yield json.loads(line)
        except ValueError:
            return


def refuse_start(code, printed):
    """The program ended before its first event: it was called wrongly, or it is broken."""
    for line in printed.lines:
        if line.startswith("error: "):
            raise (InputError if code == 2 else ToolError)(line[len("error: "):])
    raise ToolError(f"the checks did not start: {how_it_ended(code)}")


def watch_command(args):
    """Checks now and after every save. A save during a check leads to another check."""
    chapter = find_checked(args.chapter)
    files = tested_files(mine(chapter, args.mine), reference=False)
    try:
        while True:
            stamps = [stamp(file) for file in files]
            check_command(args)
            note(f"watching {', '.join(str(file.relative_to(ROOT)) for file in files)}: save to "
                 "check again, Ctrl-C to end")
            while stamps == [stamp(file) for file in files]:
                time.sleep(0.3)
            print(flush=True)
    except KeyboardInterrupt:
        note("stopped watching")
        return 0


def stamp(file):
    """Changes when the file is saved. An editor may replace the file: for a moment it is gone."""
    try:
        status = file.stat()
    except FileNotFoundError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
