"""How fast is a student's piece? Its program's times, beside those of the solution's program."""

import json
import os
import statistics
import subprocess

from workbook import build, processes
from workbook.errors import ToolError

TIME_LIMIT = 30  # seconds for one timed run
PAIRS = 5  # timed runs of yours and of the solution, in turn


def pinned():
    """Unpinned, two threads may share a core."""
    return {name: os.environ.get(name, value)
            for name, value in [("OMP_PROC_BIND", "close"), ("OMP_PLACES", "cores")]}


def measure(chapter, options=()):
    """Yours and the solution in turn, so that both meet the same machine: medians in ms."""
    build.set_mine(chapter, {chapter})
    targets = [chapter.folder, f"{chapter.folder}_reference"]
    build.build(targets)
    times, count = {target: [] for target in targets}, None
    for _ in range(PAIRS):
        for target in targets:
            command = [str(build.executable(target)), "--time", "--json", *options]
            try:
                output = processes.output_of(command, TIME_LIMIT,
                                             env={**os.environ, **pinned()})
                timing = json.loads(output or "")
                times[target].append(float(timing["milliseconds"]))
                count = timing["count"]
            except subprocess.TimeoutExpired:
                raise ToolError(f"{target} was stopped after {TIME_LIMIT} s: does each thread do "
                                "the work of all?") from None
            except (ValueError, KeyError):
                shown = " ".join([target, *command[1:]])
                raise ToolError(f"'{shown}' did not print one line of JSON with \"milliseconds\" "
                                'and "count"') from None
    yours, solution = (statistics.median(times[target]) for target in targets)
    return {"yours": yours, "solution": solution, "count": count, "pairs": PAIRS}
