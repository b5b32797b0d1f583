"""maps: where each response holds and where it fails, as tables and pictures."""

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
    maps.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    maps.add_argument("--out", metavar="FOLDER", default=str(ROOT / "build" / "maps"),
                      help="folder for the files (build/maps; those of the docs: docs/results)")
    maps.set_defaults(run=maps_command)


def measured_with(device, words):
    """The lines at the head of a CSV: machine, commit, command."""
    return (f"{', '.join(measure_chapters.machine(device))}, "
            f"commit {measure_chapters.commit()}\n{shlex.join(['./ballpit', *words])}")


def stamp(args):
    return measured_with(args.device, ["maps", *args.names, *(["--coarse"] if args.coarse else []),
                                       "--device", args.device])


def out_folder(path):
    """The folder, made if it is missing."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {path}: no folder can be made there ({error.strerror})") from None
    return folder


def maps_command(args):
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
    code = processes.finish(child)
    if code < 0:
        raise ToolError(f"ballpit_maps was ended by signal {-code}")
    return code
