"""Asks the GPU's counters for the profiler's tables of the lessons: docs/results/chapter_NN_profile.csv.

    python3 tools/profile_chapters.py [--keep FOLDER] [--read FOLDER] [NN ...]

Needs Nsight Compute (`ncu`) with the right to read the counters, and the reference executables of
the cuda-release build. Caches are emptied before each kernel (ncu's habit), so what it reads comes
from memory. --keep saves what ncu prints; --read makes the tables from that, without a GPU.
"""

import argparse
import csv
import re
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import NamedTuple

from measure_chapters import MILLION, ROOT, commit, digits, machine

BUS = "dram__throughput.avg.pct_of_peak_sustained_elapsed"
SECTORS_A_REQUEST = "l1tex__average_t_sectors_per_request_pipe_lsu_mem_global_op_ld.ratio"
WAITING = "smsp__average_warps_issue_stalled_long_scoreboard_per_issue_active.ratio"
L2_HITS = "lts__t_sector_hit_rate.pct"
BYTES = "dram__bytes.sum"
REQUESTS = "l1tex__t_requests_pipe_lsu_mem_global_op_ld.sum"  # one for the 32 threads of a warp
SECTORS = "l1tex__t_sectors_pipe_lsu_mem_global_op_ld.sum"


def percent(value, _):
    return f"{digits(value, 2)} %"


def plain(value, _):
    return digits(value)


def for_each_ball(value, count):
    return digits(value / count)


def for_each_thread(value, count):
    return digits(32 * value / count)


class Row(NamedTuple):
    """A kernel of a table: what stands before the numbers, its function, and which launch of it.

    Of a function's launches only the largest count (chapter 07 resolves small scenes as well).
    """
    cells: list
    function: str
    launch: int = -1
    template: str = ""  # mangled, where the function is one


class Profile(NamedTuple):
    program: str
    arguments: str  # besides --device and --count
    count: int
    columns: list
    metrics: dict  # ncu's name: how to write it
    rows: list
    suffix: str = "_reference"  # of the program's file

    @property
    def executable(self):
        return self.program + self.suffix


def kernel(name, launch=-1):
    return Row([f"`{name}`"], name, launch)


# A chapter may need several runs: the library's sort is only launched to be timed.
PROFILES = {
    "01": [Profile("01_naive_collision", "", 64000, ["kernel", "balls", "memory bus in use"],
                   {BUS: percent}, [Row(["`findPairsNaiveKernel`", "64000"],
                                        "findPairsNaiveKernel")])],
    "02": [Profile("02_grid_hash", "", 8 * MILLION, ["kernel", "balls", "memory bus in use"],
                   {BUS: percent}, [Row(["`computeGridHash`", "8000000"], "computeGridHash")])],
    "03": [Profile("03_sort", arguments, 8 * MILLION,
                   ["kernel", "sectors a read request", "bytes a pair", "memory bus in use"],
                   {SECTORS_A_REQUEST: plain, BYTES: for_each_ball, BUS: percent}, rows)
           for arguments, rows in [
               ("", [kernel("countDigits", 0), kernel("scatterByDigit", 0)]),
               ("--time", [Row(["the library's pass"], "DeviceRadixSortOnesweepKernel", 0)])]],
    "04": [Profile("04_reorder", "--time", 8 * MILLION,
                   ["kernel", "balls lie", "sectors a read request", "bytes a ball",
                    "memory bus in use"],
                   {SECTORS_A_REQUEST: plain, BYTES: for_each_ball, BUS: percent},
                   [Row(["gather", "as they came"], "reorderData", 0),
                    Row(["gather", "in cell order"], "reorderData"),
                    # The first two searches are one of each order, before those to be timed.
                    Row(["search", "as they came"], "countTouching", 2),
                    Row(["search", "in cell order"], "countTouching")])],
    "05": [Profile("05_cell_bounds", "", 8 * MILLION, ["kernel", "loads a ball", "sectors a ball"],
                   {REQUESTS: for_each_thread, SECTORS: for_each_ball},
                   [kernel("findCellStart"),
                    Row(["search, cell by cell"], "countAround", template="ILb0E"),
                    Row(["search, row by row"], "countAround", template="ILb1E")])],
    "06": [Profile("06_broad_phase", "", 8 * MILLION,
                   ["kernel", "cycles waiting for memory, per instruction",
                    "hits in the L2 cache", "memory bus in use"],
                   {WAITING: plain, L2_HITS: percent, BUS: percent},
                   [kernel("broadPhaseCollision"), kernel("writePairs")])],
    "07": [Profile("07_impulse_response", "", MILLION,
                   ["kernel", "balls", "cycles waiting for memory, per instruction",
                    "memory bus in use"], {WAITING: plain, BUS: percent},
                   [Row([f"`{name}`", "1000000"], name)
                    for name in ["collisionResponseRacy", "collisionResponseAtomic", "linkAndCount",
                                 "computePairImpulse", "collisionResponse"]])],
    "10": [Profile("10_full_system", "--time", MILLION, ["kernel", "balls", "memory bus in use"],
                   {BUS: percent}, [Row([f"`{name}`", "1000000"], name)
                                    for name in ["integrateAndHash", "reorderAndFindCells"]])],
    # Of the colours the first is the largest, of the rounds the first has most pairs to colour.
    "11": [Profile("gravity_fall", "--scene pile --response small-steps --frames 2", MILLION,
                   ["kernel", "balls", "sectors a read request",
                    "cycles waiting for memory, per instruction", "memory bus in use"],
                   {SECTORS_A_REQUEST: plain, WAITING: plain, BUS: percent},
                   [Row(["`pushApart`, the first colour", "1000000"], "pushApart", 0),
                    Row(["`bidForColour`, the first round", "1000000"], "bidForColour", 0),
                    Row(["`velocityFromPositions`", "1000000"], "velocityFromPositions", 0)],
                   suffix="")],
}


def mangled(row):
    """How the function stands in a mangled name. Its length is a part of that: no other matches."""
    return f"{len(row.function)}{row.function}{row.template}"


def command(profile):
    functions = sorted({mangled(row) for row in profile.rows})
    program = ROOT / "build" / "cuda-release" / "bin" / profile.executable
    return ["ncu", "--csv", "--page", "raw", "--print-units", "base", "--clock-control", "none",
            "--kernel-name-base", "mangled", "--print-kernel-base", "mangled",
            "--kernel-name", f"regex:{'|'.join(functions)}", "--metrics", ",".join(profile.metrics),
            str(program), "--device", "cuda", "--count", str(profile.count),
            *profile.arguments.split()]


def launches(text):
    """What ncu tells of each launch: a dictionary by column. Its second line holds the units, and
    what the program itself prints stands between."""
    table = list(csv.reader(line for line in text.splitlines() if line.startswith('"')))
    if len(table) < 3:
        raise ValueError(f"ncu profiled no kernel; it says:\n{text[-2000:]}")
    return [dict(zip(table[0], row)) for row in table[2:]]


def size_of(launch):
    """Blocks of the launch, from "(31250, 1, 1)"."""
    return int(re.search(r"\d+", launch["Grid Size"])[0])


def launch_of(row, found):
    """The launch that the row speaks of."""
    name = re.compile(rf"(?<!\d){mangled(row)}")
    of_function = [launch for launch in found if name.search(launch["Kernel Name"])]
    if not of_function:
        raise ValueError(f"no launch of {row.function} was profiled")
    largest = max(size_of(launch) for launch in of_function)
    return [launch for launch in of_function if size_of(launch) == largest][row.launch]


def cells_of(row, profile, found):
    launch = launch_of(row, found)
    values = {name: float(launch[name].replace(",", "")) for name in profile.metrics}
    return [*row.cells, *(write(values[name], profile.count)
                          for name, write in profile.metrics.items())]


def output_of_ncu(profile):
    result = subprocess.run(command(profile), capture_output=True, text=True, check=False)
    return result.stdout + result.stderr


def kept(name, kept_in, read_from, say):
    """What say() says, kept in one folder or read from another."""
    if read_from:
        return (read_from / name).read_text().rstrip("\n")
    said = say()
    if kept_in:
        kept_in.mkdir(parents=True, exist_ok=True)
        (kept_in / name).write_text(said)
    return said


def write_table(chapter, where, rows):
    profile = PROFILES[chapter][0]
    with open(ROOT / "docs" / "results" / f"chapter_{chapter}_profile.csv", "w", newline="") as out:
        out.write(f"# {where}. python3 tools/profile_chapters.py {chapter}: "
                  f"ncu --metrics {','.join(profile.metrics)} {profile.executable} "
                  f"--device cuda --count {profile.count}\n")
        csv.writer(out, lineterminator="\n").writerows([profile.columns, *rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("chapters", nargs="*", help="as 02 05 (default: all that have a table)")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="saves what ncu prints there")
    parser.add_argument("--read", type=Path, metavar="FOLDER", help="takes it from there")
    args = parser.parse_args()
    for tool, owner in {"nvidia-smi": "NVIDIA's driver", "ncu": "Nsight Compute"}.items():
        if not args.read and not shutil.which(tool):
            print(f"error: '{tool}' was not found: install {owner} or put it on the PATH, or read "
                  "what was kept elsewhere (--read)", file=sys.stderr)
            return 2
    where = kept("machine.txt", args.keep, args.read,
                 lambda: f"{', '.join(machine('cuda'))}, commit {commit()}")
    failed = False
    for chapter in args.chapters or PROFILES:
        if chapter not in PROFILES:
            parser.error(f"no profile for '{chapter}': there are {', '.join(PROFILES)}")
        try:
            rows = []
            for profile in PROFILES[chapter]:
                name = f"{profile.program}{profile.arguments}.txt"
                text = kept(name, args.keep, args.read, partial(output_of_ncu, profile))
                rows += [cells_of(row, profile, launches(text)) for row in profile.rows]
            write_table(chapter, where, rows)
            print(*rows, sep="\n", flush=True)
        except (OSError, ValueError, KeyError) as problem:
            print(f"error: chapter {chapter}: {problem}", file=sys.stderr)
            failed = True
    return 2 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
