"""Draws speed against accuracy from a chart's CSV (chart/run_chart.h): a curve a method, traced by
its knobs.

    python3 tools/figures/speed_chart.py chart_six_cubed.csv     # chart_six_cubed.svg and .png
"""

import csv
import io
import math
import sys
from pathlib import Path

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, RED, SKY

KEYS = ("chart", "error", "held against", "tolerance", "simulated", "balls")
NUMBERS = ("steps_a_frame", "dt", "passes", "error", "tolerance", "ms_a_second", "ms_low", "ms_high",
           "real_time_factor", "pair_visits_a_second", "runs")

# method: colour and marker. Told apart by either alone.
STYLES = {"small-steps": (BLUE, "o"), "warm": (ORANGE, "s"), "coloured": (GREEN, "^"),
          "mass-split": (RED, "D"), "jacobi": (PURPLE, "v"), "penalty": (SKY, "P"),
          "atomic": ("#8a7a00", "<"), "racy": (FAINT, ">"), "plan": (INK, "*")}
SPARE = (("#6b4226", "h"), (INK, "p"), ("#004d40", "8"), ("#7a0177", "d"), ("#5c5c5c", "H"))
LABELS_TRIED = ((7, 5), (7, -11), (-7, 5), (-7, -11), (0, 9), (0, -15))


class ChartError(Exception):
    """The file is no chart; the message says why."""


def value(text):
    """A number, or None where nothing was measured."""
    number = float(text)
    return number if math.isfinite(number) else None


def read(path):
    """The comments as a dictionary ("" holds those without a key), and the rows, with numbers."""
    notes, lines = {"": []}, []
    for line in Path(path).read_text().splitlines():
        if not line.startswith("# "):
            lines.append(line)
            continue
        key, colon, text = line[2:].partition(": ")
        if colon and key in KEYS:
            notes[key] = text
        else:
            notes[""].append(line[2:])
    rows = []
    try:
        for row in csv.DictReader(lines):
            rows.append(row | {name: value(row[name]) for name in NUMBERS})
    except (KeyError, TypeError, ValueError) as error:
        raise ChartError(f"{path}: not a chart's CSV ({error!r})") from None
    if not rows or "chart" not in notes:
        raise ChartError(f"{path}: not a chart's CSV (no points in it)")
    return notes, rows


def methods(rows):
    """The methods in order of appearance, each with its style."""
    names, spare, found = dict.fromkeys(row["method"] for row in rows), iter(SPARE * 9), {}
    for name in names:
        found[name] = STYLES.get(name) or next(spare)
    return found


def is_good(row):
    return row["verdict"] == "ok" and row["real_time_factor"] is not None


def curves(rows, method):
    """Its curves by the name of their knob, each a list of good rows along the knob. The usual
    setting is part of all."""
    own = [row for row in rows if row["method"] == method and is_good(row)]
    knobs = dict.fromkeys(row["curve"] for row in own if row["curve"] != "both") or {"dt": None}
    along = {"dt": lambda row: -row["dt"]}
    return {knob: sorted((row for row in own if row["curve"] in (knob, "both")),
                         key=along.get(knob, lambda row: row["passes"])) for knob in knobs}


def short_label(row):
    """The knob that is not as usual."""
    if row["curve"] == "dt":
        return f"{1000 * row['dt']:.3g} ms"
    if row["curve"] == "both":
        return row["label"] if not row["label"].startswith("dt ") else f"{row['passes']:.0f}×, usual"
    return f"{row['passes']:.0f}×"


def floor_of(rows):
    """Where an error of 0 is drawn: below all others."""
    errors = [row["error"] for row in rows if row["error"]]
    return min(errors, default=1e-6) / 3


class Chart:
    """One sheet: the curves, and beside them the runs that were wrong."""

    def __init__(self, notes, rows, pyplot):
        self.notes, self.rows = notes, rows
        self.styles, self.floor = methods(rows), floor_of(rows)
        self.figure, (self.failed, self.axes) = pyplot.subplots(
            1, 2, figsize=(12, 7.4), sharey=True, width_ratios=(1, 8))
        self.figure.subplots_adjust(left=0.075, right=0.80, top=0.94, bottom=0.135, wspace=0.02)

    def y(self, row):
        return max(row["error"], self.floor)

    def draw(self):
        self.draw_axes()
        for method in self.styles:
            self.draw_method(method)
        self.draw_front()
        self.draw_failures()
        self.axes.axhline(float(self.notes["tolerance"]), color=INK, linestyle=(0, (6, 4)),
                          linewidth=1.2, zorder=1)
        self.axes.annotate(f"tolerance {float(self.notes['tolerance']):g}",
                           (0.995, float(self.notes["tolerance"])), (0, 4), fontsize=9,
                           xycoords=("axes fraction", "data"), textcoords="offset points",
                           ha="right", color=INK)
        self.figure.legend(loc="upper left", bbox_to_anchor=(0.802, 0.955), fontsize=9,
                           frameon=False)
        self.figure.draw_without_rendering()
        self.draw_labels()
        return self.figure

    def draw_axes(self):
        notes, axes = self.notes, self.axes
        axes.set_xscale("log")
        axes.set_yscale("log")
        from matplotlib import ticker
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axes.xaxis.set_minor_formatter(ticker.NullFormatter())
        axes.set_xlabel("real-time factor: simulated seconds in a second (faster: right)")
        self.failed.set_ylabel(f"{notes['error']} (more accurate: up)")
        axes.grid(True, which="major", color="#e4e7eb", linewidth=0.8)
        axes.tick_params(labelleft=False)
        axes.set_title(f"{notes['chart']}: {notes['balls']} balls, {notes['simulated']}; "
                       f"error 0: {notes['held against']}", loc="left", fontsize=11)
        errors = [self.y(row) for row in self.rows if is_good(row)] + [float(notes["tolerance"])]
        axes.set_ylim(max(errors) * 2.2, min(errors) / 1.8)
        foot = "\n".join(notes[""])
        self.figure.text(0.01, 0.01, foot, fontsize=8, color="#52606d")

    def draw_method(self, method):
        color, marker = self.styles[method]
        for k, (knob, rows) in enumerate(curves(self.rows, method).items()):
            xs = [row["real_time_factor"] for row in rows]
            # The file's digits are few: a bar of no length may come out below 0.
            lows = [max(0, x - 1000 / row["ms_high"]) for x, row in zip(xs, rows)]
            highs = [max(0, 1000 / row["ms_low"] - x) for x, row in zip(xs, rows)]
            self.axes.errorbar(xs, [self.y(row) for row in rows], xerr=(lows, highs), color=color,
                               marker=marker, markersize=6, linewidth=1.5, elinewidth=1,
                               linestyle="-" if k == 0 else ":", zorder=3,
                               markerfacecolor=color if k == 0 else "white",
                               label=method if k == 0 and rows else None)

    def draw_front(self):
        front = sorted((row["real_time_factor"], self.y(row)) for row in self.rows
                       if row["on_front"] == "yes")
        if front:
            self.axes.plot(*zip(*front), color="#cbd2d9", linewidth=9, zorder=0, alpha=0.8,
                           solid_capstyle="round", label="Pareto front")
        for style, name in (("-", "dt varies"), (":", "passes (×) vary")):
            self.axes.plot([], [], style, color=INK, linewidth=1.2, label=name)

    def draw_failures(self):
        """A column for each method, since a wrong result has no time."""
        failed = self.failed
        names = list(self.styles)
        failed.set_xlim(-0.7, len(names) - 0.3)
        failed.set_xticks([])
        failed.set_xlabel("wrong:\nnot timed", fontsize=9)
        worst, best = failed.get_ylim()
        for k, method in enumerate(names):
            own = [row for row in self.rows if row["method"] == method and not is_good(row)]
            ys = [min(max(self.y(row) if row["error"] is not None else worst, best * 1.05),
                      worst / 1.05) for row in own]
            failed.plot([k] * len(own), ys, linestyle="none", marker="x", markersize=6,
                        markeredgewidth=1.6, color=self.styles[method][0], clip_on=False,
                        label=f"{method}: {len(own)} wrong" if own else None)

    def draw_labels(self):
        """As many as have room, the front's first."""
        renderer, taken = self.figure.canvas.get_renderer(), []
        to_pixels = self.axes.transData.transform
        good = [row for row in self.rows if is_good(row)]
        spots = [to_pixels((row["real_time_factor"], self.y(row))) for row in good]
        order = sorted(range(len(good)), key=lambda k: (good[k]["on_front"] != "yes",
                                                        good[k]["curve"] != "both", k))
        for k in order:
            row = good[k]
            for dx, dy in LABELS_TRIED:
                text = self.axes.annotate(
                    short_label(row), (row["real_time_factor"], self.y(row)), (dx, dy), fontsize=8,
                    textcoords="offset points", color=INK, zorder=5,
                    ha="left" if dx > 0 else "right" if dx < 0 else "center")
                box = text.get_window_extent(renderer).padded(1)
                inside = self.axes.bbox.x0 < box.x0 and box.x1 < self.axes.bbox.x1 and \
                    self.axes.bbox.y0 < box.y0 and box.y1 < self.axes.bbox.y1
                hits = any(box.overlaps(other) for other in taken) or \
                    any(box.padded(3).contains(*spot) for spot in spots)
                if inside and not hits:
                    taken.append(box)
                    break
                text.remove()


def draw(source):
    """The chart in the file `source` as (SVG text, PNG bytes)."""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "ballpit", "svg.fonttype": "none",
                            "font.family": "DejaVu Sans", "axes.edgecolor": "#7b8794"})
    from matplotlib import pyplot
    figure = Chart(*read(source), pyplot).draw()
    svg, png = io.BytesIO(), io.BytesIO()
    figure.savefig(svg, format="svg", metadata={"Date": None})
    figure.savefig(png, format="png", dpi=110, metadata={"Software": None})
    pyplot.close(figure)
    return svg.getvalue().decode(), png.getvalue()


if __name__ == "__main__":
    for name in sys.argv[1:]:
        drawn = draw(name)
        Path(name).with_suffix(".svg").write_text(drawn[0])
        Path(name).with_suffix(".png").write_bytes(drawn[1])
