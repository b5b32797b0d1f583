"""demo, test, bench and run: builds a program, then becomes it."""

import os
import shutil
import sys

from workbook import build, chapters, checking, explaining, record, speed
from workbook.chapters import ROOT


def register(commands):
    for name, run, text in [
            ("demo", demo_command, "record 500 falling balls: videos/gravity_fall.mp4, --view"),
            ("test", test_command, "build and run all tests of the engine"),
            ("bench", bench_command, "time the engine's stages; `bench 02`: your piece and ours")]:
        # These pass all their options on, --help as well.
        commands.add_parser(name, help=text, add_help=False).set_defaults(run=run, passes_on=True)
    run = commands.add_parser("run", help="run a chapter's program with your pieces")
    run.add_argument("chapter", help="number or name, as 02 or grid_hash")
    run.add_argument("--reference", action="store_true", help="with our pieces instead")
    run.add_argument("--mine", metavar="LIST", default="",
                     help="chapters whose pieces are yours too, as 2,3 or all (up to this one)")
    run.add_argument("--video", nargs="?", const="", metavar="FILE",
                     help="record a video (build/NN_name.mp4)")
    run.add_argument("--png", nargs="?", const="", metavar="FILE",
                     help="save the last picture (build/NN_name.png)")
    run.epilog = "Further options go to the program: add `-- --help` to see them."
    run.set_defaults(run=run_command, passes_on=True)


def become(program, arguments, **environment):
    """Goes on as another program: it gets Ctrl-C, and its exit code is ours."""
    sys.stdout.flush()
    os.execve(str(program), [str(program), *arguments], {**os.environ, **environment})


def demo_command(args):
    build.build(["gravity_fall"])
    # A window has no end by itself: what it shows is recorded only if that is asked for.
    no_video = any(option in ("--help", "-h", "--view") or option.startswith("--out")
                   for option in args.further)
    out = [] if no_video else ["--out", str(ROOT / "videos" / "gravity_fall.mp4")]
    become(build.executable("gravity_fall"), [*out, *args.further])


def test_command(args):
    build.build(["all"])
    become(shutil.which("ctest"), ["--test-dir", str(build.folder()), "--output-on-failure",
                                   "--no-tests=error", *args.further])


def run_command(args):
    chapter = chapters.find(args.chapter)
    target = chapter.folder + ("_reference" if args.reference else "")
    build.require(chapter)
    if not args.reference:
        build.set_mine(chapter, checking.mine(chapter, args.mine))
    build.build([target])
    further = [option for option in args.further if option != "--"]
    if args.video is not None:
        further += ["--out", args.video or str(ROOT / "build" / f"{chapter.folder}.mp4")]
    if args.png is not None:
        further += ["--png", args.png or str(ROOT / "build" / f"{chapter.folder}.png")]
    become(build.executable(target), further)


def bench_command(args):
    if not args.further or args.further[0].startswith("-"):
        build.build(["ballpit_bench"])
        become(build.executable("ballpit_bench"), args.further, **speed.pinned())
    chapter = checking.find_checked(args.further[0])
    if not record.is_correct(chapter):
        code = checking.check_alone(chapter)
        if code != 0:
            return code
    print(explaining.speed(speed.measure(chapter, args.further[1:])))
    return 0
