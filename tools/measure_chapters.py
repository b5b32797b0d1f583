"""Measures the tables of the lessons on this machine and writes them to docs/results/chapter_NN.csv.

    python3 tools/measure_chapters.py [--cuda] [NN ...]

Needs the reference executables (`cmake --build build/cpu-release`, or cuda-release). Every time is
the median of three runs, each of them the median of many repeats. Rows of other machines stay.
"""

import argparse
import csv
import json
import os
import re
import statistics
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RUNS = 3

MILLION = 1_000_000
SIZES = {"cpu": [1000, 16384, 131072, MILLION], "cuda": [1000, 16384, 131072, MILLION, 8 * MILLION]}
DOUBLED = {"cpu": [1000 * 2 ** k for k in range(6)], "cuda": [1000 * 2 ** k for k in range(10)]}


def digits(value, count=3):
    """A number with so many significant digits, without an exponent."""
    text = f"{value:.{count}g}"
    return f"{float(text):.0f}" if "e" in text else text


# For each table: the program, the sizes, the columns after machine, threads and balls, and their
# values from what the program prints as JSON.

def hello(d):
    return [digits(d["milliseconds"]), digits(28e-6 * d["count"] / d["milliseconds"])]


def naive(d):
    return [d["comparisons"], digits(d["milliseconds"]),
            digits(1e-6 * d["comparisons"] / d["milliseconds"])]


def grid_hash(d):
    return [digits(d["milliseconds"]), digits(24e-6 * d["count"] / d["milliseconds"])]


def sort(d):
    yours, library = d["milliseconds"], d["library_milliseconds"]
    return [d["key_bits"], digits(yours), digits(library), digits(yours / library, 2)]


def reorder(d):
    plain, sorted_before = d["milliseconds"], d["milliseconds,_sorted_before"]
    as_they_came, by_cell = d["search_ms,_as_they_came"], d["search_ms,_by_cell"]
    moved = d["bytes_moved_for_a_ball"] * d["count"] * 1e-6  # MB
    held = 40e-6 * d["count"]  # MB: position, velocity, restitution, id
    return [digits(held), digits(plain), digits(moved / plain), digits(sorted_before),
            digits(moved / sorted_before), digits(as_they_came), digits(by_cell),
            digits(as_they_came / by_cell)]


def cell_bounds(d):
    cells, rows = d["search_ms,_cell_by_cell"], d["search_ms,_row_by_row"]
    return [d["cells"], f"{100 * d['occupied_cells'] / d['cells']:.0f} %",
            digits(d["milliseconds"]), digits(cells), digits(rows), digits(cells / rows)]


def broad_phase(d):
    naive_time = d.get("milliseconds,_naive")
    return [d["comparisons,_naive"], d["candidates,_grid"], d["touching_pairs"],
            digits(naive_time) if naive_time else "",
            digits(d["milliseconds"] + d["milliseconds_to_build_the_grid"])]


def whole_step(d):
    naive_time = d.get("milliseconds,_naive")
    return [d["touching_pairs"], digits(naive_time) if naive_time else "",
            digits(d["milliseconds"]),
            digits(naive_time / d["milliseconds"], 2) if naive_time else ""]


def response(d):
    return [digits(d[name]) for name in ("in_place:_milliseconds", "atomic:_milliseconds",
                                         "milliseconds")]


def recording(d):
    return [digits(d[name]) for name in (
        "draw,_ms_a_frame", "read_plainly,_ms_a_frame", "convert,_ms_a_frame",
        "encode,_ms_a_frame", "one_after_the_other,_ms_a_frame",
        "draw_and_read_plainly,_ms_a_frame", "draw_and_read_through_buffers,_ms_a_frame",
        "recorder,_ms_a_frame", "recorder,_frames_a_second")]


def rendering(d):
    """Nets are not drawn beyond 20 000 balls."""
    nets, by_size = (d.get(f"GLU_{kind}:_milliseconds") for kind in ("32_x_32", "by_size"))
    squares = d["milliseconds"]
    return [digits(nets) if nets else "", digits(by_size) if by_size else "", digits(squares),
            digits(d["points:_milliseconds"]), digits(d["points_in_place:_milliseconds"]),
            digits(nets / squares, 2) if nets else ""]


TABLES = {
    "00": ("00_hello_spheres", SIZES, ["ms", "GB/s written"], hello),
    "01": ("01_naive_collision", DOUBLED, ["comparisons", "ms", "comparisons a nanosecond"], naive),
    "02": ("02_grid_hash", SIZES, ["ms", "GB/s"], grid_hash),
    "03": ("03_sort", SIZES, ["key bits", "yours, ms", "library, ms", "ratio"], sort),
    "04": ("04_reorder", SIZES, ["MB", "gather, ms", "GB/s", "sorted before, ms", "GB/s",
                                 "search as they came, ms", "search by cell, ms", "gain"], reorder),
    "05": ("05_cell_bounds", SIZES, ["cells", "occupied", "clear and bounds, ms",
                                     "search cell by cell, ms", "search row by row, ms", "gain"],
           cell_bounds),
    "06": ("06_broad_phase", {"cpu": [100, 1000, 10000, 30000, 100000, MILLION],
                              "cuda": [100, 1000, 10000, 30000, 100000, MILLION, 8 * MILLION]},
           ["comparisons, naive", "comparisons, grid", "pairs", "naive, ms",
            "grid and search, ms"], broad_phase),
    "07": ("07_impulse_response", {"cpu": [1000, 100000], "cuda": [1000, 100000, MILLION]},
           ["in place, ms", "atomic, ms", "gathered, ms"], response),
    "08": ("08_sphere_rendering", {"cpu": [100, 500, 2000, 10000, 100000],
                                   "cuda": [500, 10000, 100000, MILLION]},
           ["GLU 32 x 32, ms", "GLU by size, ms", "squares, ms", "points, ms",
            "points in place, ms", "GLU 32 x 32 / squares"], rendering),
    "09": ("09_video_recording", {"cpu": [500, 10000], "cuda": []},
           ["draw, ms", "read, ms", "convert, ms", "encode, ms", "one after the other, ms",
            "draw and read, ms", "through buffers, ms", "recorder, ms", "frames a second"],
           recording),
    "10": ("10_full_system", {"cpu": [100, 1000, 3000, 10000, 100000, MILLION],
                              "cuda": [100, 1000, 3000, 10000, 100000, MILLION, 8 * MILLION]},
           ["pairs", "naive step, ms", "step with the grid, ms", "ratio"], whole_step),
}


def measured(program, device, count, threads):
    """What the program prints, with the median of the runs in each time."""
    environment = dict(os.environ)
    if program.parent / "09_video_recording_reference" != program:  # its encoder wants all cores
        environment |= {"OMP_PROC_BIND": "close", "OMP_PLACES": "cores"}
    if threads:
        environment["OMP_NUM_THREADS"] = str(threads)
        environment["LP_NUM_THREADS"] = str(threads)  # of Mesa, where it draws on the CPU
    command = [str(program), "--device", device, "--count", str(count), "--time", "--json"]
    runs = [json.loads(subprocess.run(command, env=environment, capture_output=True, text=True,
                                      check=True).stdout) for _ in range(RUNS)]
    return {name: statistics.median(run[name] for run in runs)
            if isinstance(value, (int, float)) else value for name, value in runs[0].items()}


def output_of(command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def machine(device):
    """(name in the first column, description)."""
    if device == "cuda":
        said = output_of(["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"])
        name, driver = (said.splitlines() or ["no GPU, none"])[0].split(", ")
        return name, f"driver {driver}"
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    compiler = output_of(["c++", "-dumpfullversion"])
    return "CPU", f"{model[1]}, {os.cpu_count()} cores, c++ {compiler}"


def commit():
    """Of this tree; BALLPIT_COMMIT says it where a copy came without its history."""
    return (os.environ.get("BALLPIT_COMMIT") or
            output_of(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]) or "unknown")


def update(chapter, device, build, thread_counts):
    """Measures one table and writes it, with the other machines' rows as they were."""
    program, sizes, columns, values = TABLES[chapter]
    file = ROOT / "docs" / "results" / f"chapter_{chapter}.csv"
    label, description = machine(device)
    header = ["machine", "threads", "balls", *columns]
    rows = []
    for count in sizes[device]:
        for threads in thread_counts:
            found = measured(build / "bin" / f"{program}_reference", device, count, threads)
            rows.append([label, threads or "", count, *values(found)])
            print(chapter, *rows[-1], flush=True)
    old = file.read_text().splitlines() if file.exists() else []
    notes = [line for line in old if line.startswith("# ") and " commit " in line
             and not line.startswith(f"# {label}: ")]
    table = list(csv.reader(line for line in old if not line.startswith("#")))
    # Rows of a table with other columns would say something else here.
    others = [row for row in table[1:] if table[0] == header and row[0] != label]
    with open(file, "w", newline="") as out:
        out.write(f"# {program}_reference --device DEVICE --count BALLS --time; medians of {RUNS} "
                  "runs, each the median of its repeats (tools/measure_chapters.py).\n")
        out.writelines(f"{note}\n" for note in
                       sorted([*notes, f"# {label}: {description}, commit {commit()}."]))
        csv.writer(out, lineterminator="\n").writerows(
            [header, *sorted(rows + others, key=lambda row: row[0] != "CPU")])


METHODS = ["jacobi", "mass-split", "coloured", "warm", "small-steps", "penalty"]


def compare_methods(build):
    """Chapter 11's table: errors and work, the same on every machine, so one run and no times."""
    program = "11_stability_reference"
    command = [str(build / "bin" / program), "--scene", "methods", "--device", "cpu", "--json"]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    with open(ROOT / "docs" / "results" / "chapter_11.csv", "w", newline="") as out:
        out.write(f"# {program} --scene methods --device cpu (tools/measure_chapters.py 11): the "
                  f"same on every machine. Commit {commit()}.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["method", "gas: energy gained", "column: overlap / r", "pile: overlap / r",
                        "crowd: fastest ball, m/s", "passes a step", "pair visits a ball and step"])
        for method in METHODS:
            gained, column, pile, crowd, passes, pairs = (
                found[f"{method}:_{name}"] for name in (
                    "gas,_energy_gained", "column,_overlap_/_r", "pile,_overlap_/_r",
                    "crowd,_fastest_m/s", "passes_a_step", "pile,_listed_pairs_a_ball"))
            gained = 100 * gained
            table.writerow([method, f"{gained:+.0f} %" if abs(gained) > 0.01 else "0 %",
                            digits(column), digits(pile), digits(crowd), passes,
                            digits(passes * pairs)])


def compare_plans(build):
    """Chapter 12's table: errors over what is asked for, and visits, the same on every machine."""
    program = "12_speed_and_accuracy_reference"
    command = [str(build / "bin" / program), "--scene", "every", "--device", "cpu", "--json"]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    scenes = [key.removesuffix("_asks_for") for key in found if key.endswith("_asks_for")]
    with open(ROOT / "docs" / "results" / "chapter_12.csv", "w", newline="") as out:
        out.write(f"# {program} --scene every --device cpu (tools/measure_chapters.py 12): the same "
                  f"on every machine. Commit {commit()}.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["scene", "original loop: error / tolerance", "visits a second",
                        "plan: error / tolerance", "visits a second", "the plan's loop"])
        for scene in scenes:
            row = [scene]
            for loop in ("original_loop", "plan"):
                visits, error, tolerance, failed = found[f"{scene},_{loop},_numbers"]
                row += ["failed" if failed else f"{error / tolerance:.2g}", round(visits)]
            table.writerow([*row, found[f"{scene},_plan_chose"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("chapters", nargs="*", help="as 02 05 (default: all)")
    parser.add_argument("--cuda", action="store_true", help="on the GPU")
    args = parser.parse_args()
    device = "cuda" if args.cuda else "cpu"
    build = ROOT / "build" / f"{device}-release"
    compared = {"11": compare_methods, "12": compare_plans}
    known = [*TABLES, *compared]
    for chapter in args.chapters or known:
        if chapter not in known:
            parser.error(f"unknown chapter '{chapter}': known are {', '.join(known)}")
        if chapter in compared:
            compared[chapter](build)
            continue
        one_way = args.cuda or chapter == "09"  # its threads are not OpenMP's
        update(chapter, device, build, [""] if one_way else [1, 2])


if __name__ == "__main__":
    main()
