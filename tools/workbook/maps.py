"""maps: where each response holds and where it fails, as tables and pictures; and the table of all
metrics."""

import shlex
import sys
from pathlib import Path

from workbook import build, files, processes
from workbook.chapters import ROOT
from workbook.errors import InputError, ToolError
from workbook.terminal import note

sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools" / "figures")]

import failure_map  # noqa: E402
import measure_chapters  # noqa: E402


def register(commands):
    maps = commands.add_parser("maps", help="draw where each response holds and where it fails",
                               description="Runs each response over planes of two knobs and draws "
                                           "how it ends: map_NAME.csv and map_NAME.svg.")
    maps.add_argument("names", nargs="*", metavar="NAME",
                      help="gas, column, heavy, tunnelling, hub, penalty, overlap, precision "
                           "(default: all)")
    maps.add_argument("--coarse", action="store_true",
                      help="few cells, small scenes: under a minute")
    maps.add_argument("--table", action="store_true",
                      help="no maps: run scenes (names; default: all) under each response and write "
                           "every metric of docs/stability.md: stability_table_DEVICE.csv and .md, "
                           "some minutes")
    maps.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    maps.add_argument("--out", metavar="FOLDER", default=str(ROOT / "build" / "maps"),
                      help="folder for the files (build/maps; those of the docs: docs/results)")
    maps.set_defaults(run=maps_command)


def measured_with(device, words):
    """The lines at the head of a CSV: machine, commit, command."""
    return (f"{', '.join(measure_chapters.machine(device))}, "
            f"commit {measure_chapters.commit()}\n{shlex.join(['./ballpit', *words])}")


def stamp(args):
    flags = [f"--{flag}" for flag in ("table", "coarse") if getattr(args, flag)]
    return measured_with(args.device, ["maps", *args.names, *flags, "--device", args.device])


def out_folder(path):
    """The folder, made if it is missing."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {path}: no folder can be made there ({error.strerror})") from None
    return folder


def table_command(args):
    if args.coarse:
        raise InputError("--coarse is of maps; a smaller table has fewer scenes: name them")
    folder = out_folder(args.out)
    build.build(["ballpit_table"])
    child = processes.start([str(build.executable("ballpit_table")), *args.names, "--device",
                             args.device, "--out", str(folder), "--stamp", stamp(args)],
                            stdout=processes.subprocess.PIPE, text=True)
    for line in child.stdout:
        note(f"written: {files.relative(Path(line.strip()))}")
    return ended("ballpit_table", child)


def ended(program, child):
    """The program's exit code."""
    code = processes.finish(child)
    if code < 0:
        raise ToolError(f"{program} was ended by signal {-code}")
    return code


def maps_command(args):
    if args.table:
        return table_command(args)
    folder = out_folder(args.out)
    build.build(["ballpit_maps"])
    command = [str(build.executable("ballpit_maps")), *args.names, "--device", args.device,
               "--out", str(folder), "--stamp", stamp(args)]
    child = processes.start(command + (["--coarse"] if args.coarse else []),
                            stdout=processes.subprocess.PIPE, text=True)
    # Each map is drawn as soon as it is there: whoever stops half-way has the others.
    for line in child.stdout:
        csv_file = Path(line.strip())
        picture = csv_file.with_suffix(".svg")
        files.write(picture, failure_map.draw(csv_file))
        note(f"written: {files.relative(csv_file)}, {files.relative(picture)}")
    return ended("ballpit_maps", child)
