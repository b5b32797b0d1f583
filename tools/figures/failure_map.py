"""Draws a failure map from its CSV (stability/map_file.h): a panel a method, a colour and a letter
a verdict, predictions as lines.

    python3 tools/figures/failure_map.py map_gas.csv map_gas.svg
"""

import csv
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

from figure import FAINT, INK, ORANGE, PAPER, PURPLE, RED, SKY, Figure

# verdict: colour, letter, meaning
VERDICTS = {"ok": (SKY, "", "ok"),
            "inaccurate": (ORANGE, "i", "inaccurate"),
            "energy": (RED, "E", "energy from nowhere"),
            "lost": (PURPLE, "L", "ball lost or unseen"),
            "overflow": (FAINT, "O", "too many pairs"),
            "not finite": (INK, "N", "not a number")}
DASHES = (None, "7 4", "2 3")

CELL_HEIGHT, PANEL_WIDTH, MARGIN = 24, 250, 84
MOST_COLUMNS, HEAD, GAP = 4, 118, 78


@dataclass
class Panel:
    """One plane: cells by (x, y), and lines by their label."""
    name: str
    x_label: str = ""
    y_label: str = ""
    cells: dict = field(default_factory=dict)
    lines: dict = field(default_factory=dict)

    def xs(self):
        return sorted({x for x, _ in self.cells})

    def ys(self):
        return sorted({y for _, y in self.cells})


def read(path):
    """The comments as a dictionary ("" holds those without a key), and the panels in order."""
    notes, panels, rows = {"": []}, {}, []
    for line in Path(path).read_text().splitlines():
        if not line.startswith("# "):
            rows.append(line)
            continue
        key, colon, text = line[2:].partition(": ")
        if colon and key in ("map", "title", "ok", "value"):
            notes[key] = text
        else:
            notes[""].append(line[2:])
    for row in csv.DictReader(rows):
        panel = panels.setdefault(row["panel"], Panel(row["panel"]))
        if row["kind"] == "axes":
            panel.x_label, panel.y_label = row["x"], row["y"]
        elif row["kind"] == "cell":
            panel.cells[float(row["x"]), float(row["y"])] = row["verdict"]
        else:
            panel.lines.setdefault(row["label"], []).append((float(row["x"]), float(row["y"])))
    return notes, list(panels.values())


def place(value, values):
    """Where a value lies among the cells: 0 in the middle of the first, 1 of the second. In
    between by ratio, or by difference where a value is 0. None beyond the outer cells."""
    if len(values) == 1:
        return 0.0 if value == values[0] else None
    k = max(0, min(len(values) - 2, sum(v <= value for v in values) - 1))
    low, high = values[k], values[k + 1]
    if low > 0 and value > 0:
        share = math.log(value / low) / math.log(high / low)
    else:
        share = (value - low) / (high - low)
    at = k + share
    return at if -0.5 <= at <= len(values) - 0.5 else None


def shown(value):
    """A tick's label."""
    text = f"{value:g}" if 1e-4 < value < 1e4 or value == 0 else f"{value:.0e}"
    return text.replace("e+0", "e").replace("e-0", "e-")


class Sheet:
    """Lays the panels out, and draws them."""

    def __init__(self, notes, panels):
        self.notes, self.panels = notes, panels
        self.columns = min(MOST_COLUMNS, len(panels))
        if len(panels) in (5, 6, 9):
            self.columns = 3
        rows = -(-len(panels) // self.columns)
        self.height = CELL_HEIGHT * max(len(panel.ys()) for panel in panels)
        self.labels = list(dict.fromkeys(label for panel in panels for label in panel.lines))
        self.head = HEAD + 20 * len(self.labels)
        width = max(self.columns * (PANEL_WIDTH + MARGIN) + 16, 900)
        self.figure = Figure(width, self.head + rows * (self.height + GAP) + 26,
                             f"{notes['title']} Each cell is one run; the letters are: "
                             + ", ".join(f"{letter or 'none'} {meaning}"
                                         for _, letter, meaning in VERDICTS.values()) + ".")

    def svg(self):
        self.draw_head()
        for number, panel in enumerate(self.panels):
            row, column = divmod(number, self.columns)
            self.draw_panel(panel, MARGIN + column * (PANEL_WIDTH + MARGIN),
                            self.head + row * (self.height + GAP))
        self.figure.text(16, self.figure.height - 10, " · ".join(self.notes[""]), 11, anchor="start")
        return self.figure.svg()

    def draw_head(self):
        figure = self.figure
        figure.text(16, 28, self.notes["title"], 18, anchor="start", bold=True)
        figure.text(16, 50, f"ok: {self.notes['ok']}", 13, anchor="start")
        left = 16
        found = {verdict for panel in self.panels for verdict in panel.cells.values()}
        for verdict, (color, letter, meaning) in VERDICTS.items():
            if verdict not in found:
                continue
            self.draw_cell(left, 62, 22, 18, color, letter)
            figure.text(left + 28, 76, meaning, 13, anchor="start")
            left += 50 + 7.4 * len(meaning)
        for number, label in enumerate(self.labels):
            y = 96 + 20 * number
            figure.line(16, y, 52, y, INK, 2, DASHES[number % len(DASHES)])
            figure.text(60, y + 4, f"line: {label}", 13, anchor="start")

    def draw_cell(self, x, y, width, height, color, letter):
        self.figure.add("rect", x=x, y=y, width=width, height=height, fill=color, stroke=PAPER,
                        stroke_width=1)
        if letter:
            ink = PAPER if color in (INK, RED) else INK
            self.figure.text(x + width / 2, y + height / 2 + 4, letter, 11, ink)

    def draw_panel(self, panel, left, top):
        xs, ys = panel.xs(), panel.ys()
        width, height = PANEL_WIDTH / len(xs), CELL_HEIGHT
        bottom = top + height * len(ys)
        self.figure.text(left + PANEL_WIDTH / 2, top - 8, panel.name, 14, bold=True)
        for (x, y), verdict in panel.cells.items():
            color, letter, _ = VERDICTS[verdict]
            self.draw_cell(left + xs.index(x) * width, bottom - (ys.index(y) + 1) * height, width,
                           height, color, letter)
        for label, points in panel.lines.items():
            self.draw_line(label, [(place(x, xs), place(y, ys)) for x, y in points],
                           lambda at: (left + (at[0] + 0.5) * width, bottom - (at[1] + 0.5) * height))
        every = math.ceil((7 * max(len(shown(x)) for x in xs) + 4) / width)  # those with room
        for k, x in enumerate(xs):
            if k % every == 0:
                self.figure.text(left + (k + 0.5) * width, bottom + 15, shown(x), 11)
        for k, y in enumerate(ys):
            self.figure.text(left - 5, bottom - (k + 0.5) * height + 4, shown(y), 11, anchor="end")
        self.figure.text(left + PANEL_WIDTH / 2, bottom + 33, panel.x_label, 12)
        self.upright(left - 58, (top + bottom) / 2, panel.y_label)

    def upright(self, x, y, words):
        self.figure.add("text", words, x=0, y=0, font_size=12, fill=INK, text_anchor="middle",
                        transform=f"translate({x:g},{y:g}) rotate(-90)")

    def draw_line(self, label, places, pixel):
        """In pieces, where it leaves the panel; on a paler line, to be seen on every colour."""
        dash = DASHES[self.labels.index(label) % len(DASHES)]
        piece = []
        for at in places + [(None, None)]:
            if None not in at:
                piece.append(pixel(at))
                continue
            if len(piece) > 1:
                steps = " L".join(f"{x:.1f},{y:.1f}" for x, y in piece)
                for color, width, style in ((PAPER, 5, None), (INK, 2, dash)):
                    self.figure.add("path", d=f"M{steps}", fill="none", stroke=color,
                                    stroke_width=width, stroke_dasharray=style)
            piece = []


def draw(source):
    """The SVG of the map in the file `source`."""
    return Sheet(*read(source)).svg()


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(draw(sys.argv[1]))
