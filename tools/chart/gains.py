"""By how much the plan beats the original loop: a table over charts' CSV files.

The loop is a curve, not a point: with more steps or rounds it gets slower and more accurate. So it is
asked twice: how wrong is it in the plan's time, and how slow once it is as accurate as the plan?
"""

import speed_chart

HEADER = ("scene", "tolerance", "loop: error", "ms", "plan: error", "ms", "loop in the plan's time: error",
          "loop as accurate as the plan: ms", "cheapest within tolerance: ms", "of method",
          "plan / cheapest: ms")


def figures(number):
    return "" if number is None else f"{number:.3g}"


def label(row):
    return f"{row['method']}, {speed_chart.short_label(row)}"


def loop_in_time(loop, plan):
    """The error of the most accurate setting of the loop that is as fast as the plan."""
    fast = [row["error"] for row in loop if row["ms_a_second"] <= plan["ms_a_second"]]
    return figures(min(fast)) if fast else "not so fast"


def loop_as_accurate(loop, plan):
    """ms of the fastest setting of the loop that is as accurate as the plan."""
    accurate = [row["ms_a_second"] for row in loop if row["error"] <= plan["error"]]
    return figures(min(accurate)) if accurate else "never"


def gain(path):
    """A chart's row of the table; None if it has no plan or no loop."""
    notes, rows = speed_chart.read(path)
    plans = [row for row in rows if row["method"] == "plan"]
    usual = [row for row in rows if row["label"] == "original loop"]
    if not plans or not usual:
        return None
    plan, original = plans[0], usual[0]
    cells = [notes["chart"], notes["tolerance"],
             figures(original["error"]) if speed_chart.is_good(original) else original["verdict"],
             figures(original["ms_a_second"])]
    if not speed_chart.is_good(plan):
        return cells + [plan["verdict"]] + [""] * 6
    loop = [row for row in rows if row["method"] == "mass-split" and speed_chart.is_good(row)]
    cells += [figures(plan["error"]), figures(plan["ms_a_second"]), loop_in_time(loop, plan),
              loop_as_accurate(loop, plan)]
    enough = [row for row in rows if row["engine"] == "ballpit" and speed_chart.is_good(row)
              and row["method"] not in ("racy", "atomic") and row["error"] <= row["tolerance"]]
    if not enough:
        return cells + ["none", "", ""]
    best = min(enough, key=lambda row: row["ms_a_second"])
    return cells + [figures(best["ms_a_second"]), label(best),
                    f"{plan['ms_a_second'] / best['ms_a_second']:.2f}"]


def markdown(paths):
    """The page of these charts: whose they are, and the table; ms: of one simulated second."""
    rows = [row for row in map(gain, paths) if row]
    table = [HEADER, ("---",) + ("--:",) * 8 + ("---", "--:"), *rows]
    measured = dict.fromkeys(speed_chart.read(path)[0][""][0] for path in paths)
    return "".join(["# The plan against the original loop\n\n",
                    *(f"{line}. Made by `./ballpit chart`; ms are of one simulated second.\n\n"
                      for line in measured),
                    *(f"| {' | '.join(cells)} |\n" for cells in table)])
