"""chart: speed against accuracy for every method, as tables, pictures and a page to explore."""

import functools
import sys
from pathlib import Path

from workbook import build, files, processes
from workbook.chapters import ROOT
from workbook.errors import InputError, ToolError
from workbook.maps import measured_with, out_folder
from workbook.terminal import note

sys.path[:0] = [str(ROOT / "tools" / "figures"), str(ROOT / "tools" / "chart")]

import gains  # noqa: E402
import page  # noqa: E402
import speed_chart  # noqa: E402


def register(commands):
    chart = commands.add_parser(
        "chart", help="chart speed against accuracy, method by method",
        description="Measures error and speed of every method over its knobs: chart_SCENE.csv, .svg "
                    "and .png; chart.html to explore them; and plan_gains.md, the plan "
                    "against the original loop. A run that was stopped goes on when "
                    "the same command is given again.")
    chart.add_argument("--scene", action="append", default=[], metavar="S",
                       help="a scene to chart, 666 for six_cubed (default: all; may be repeated)")
    chart.add_argument("--method", action="append", default=[], metavar="M",
                       help="a method to chart (default: all; may be repeated)")
    chart.add_argument("--quick", action="store_true",
                       help="fewer settings, scenes and runs: under three minutes")
    chart.add_argument("--peers", action="store_true", help="Bullet and ODE as well, if installed")
    chart.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    chart.add_argument("--seed", type=int, default=1, help="of the scenes (1)")
    chart.add_argument("--steps", metavar="N", help="one point only, printed: steps a frame")
    chart.add_argument("--passes", metavar="N",
                       help="one point only, printed: iterations or substeps a step")
    chart.add_argument("--out", metavar="FOLDER", default=str(ROOT / "build" / "chart"),
                       help="folder for the files (build/chart; those of the docs: docs/results)")
    chart.add_argument("--redraw", metavar="CSV", nargs="+",
                       help="measure nothing: draw these files again, where they lie")
    chart.set_defaults(run=chart_command)


def asked_for(args):
    """The options that decide what is measured."""
    words = []
    for name in ("scene", "method"):
        for chosen in getattr(args, name):
            words += [f"--{name}", chosen]
    words += [flag for flag in ("--quick", "--peers") if getattr(args, flag[2:])]
    for name in ("steps", "passes"):
        if getattr(args, name) is not None:
            words += [f"--{name}", getattr(args, name)]
    return [*words, "--device", args.device, "--seed", str(args.seed)]


@functools.lru_cache(maxsize=None)
def drawing_python():
    """A Python with matplotlib: this one, or the system's, which has Debian's package. Or None."""
    for python in (sys.executable, "/usr/bin/python3"):
        if processes.output_of([python, "-c", "import matplotlib"]) is not None:
            return python
    return None


def draw(csv_file):
    """The pictures of one chart, beside it."""
    try:
        speed_chart.read(csv_file)
    except OSError as error:
        raise InputError(f"{csv_file}: cannot be read ({error.strerror})") from None
    except speed_chart.ChartError as error:
        raise InputError(str(error)) from None
    if drawing_python() is None:
        note(f"written: {files.relative(csv_file)}; no picture of it, which takes matplotlib: "
             "apt-get install python3-matplotlib")
        return
    build.require_writable()
    log = build.LOGS / "draw_chart.log"
    if not processes.run_logged([drawing_python(), speed_chart.__file__, str(csv_file)], log):
        build.fail(f"drawing {csv_file}", log)
    note(f"written: {files.relative(csv_file)}, .svg and .png")


def write_pages(folder):
    """Of all charts in the folder: the page, and the table of the plan's gains."""
    charts = sorted(folder.glob("chart_*.csv"))
    files.write(folder / "chart.html", page.page(charts))
    files.write(folder / "plan_gains.md", gains.markdown(charts))
    note(f"written: {files.relative(folder / 'chart.html')}: open it in a browser; plan_gains.md")


def redraw(names):
    charts = [Path(name).resolve() for name in names]
    for chart in charts:
        draw(chart)
    for folder in dict.fromkeys(chart.parent for chart in charts):
        write_pages(folder)
    return 0


def chart_command(args):
    if args.redraw:
        return redraw(args.redraw)
    folder = out_folder(args.out)
    build.build(["ballpit_chart"])
    asked = asked_for(args)
    stamp = measured_with(args.device, ["chart", *asked])
    child = processes.start([str(build.executable("ballpit_chart")), *asked, "--out", str(folder),
                             "--stamp", stamp], stdout=processes.subprocess.PIPE, text=True)
    one_point = args.steps is not None or args.passes is not None
    drawn = False
    # Each chart is drawn as soon as it is there: whoever stops half-way has the others.
    for line in child.stdout:
        if one_point:
            print(line, end="")
        else:
            draw(Path(line.strip()))
            drawn = True
    code = processes.finish(child)
    if code < 0:
        raise ToolError(f"ballpit_chart was ended by signal {-code}; the same command goes on")
    if drawn:
        write_pages(folder)
    return code
