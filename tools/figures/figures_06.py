"""Figures of chapter 06: what one ball searches, in space and in memory; time against count."""

import csv
import math
from pathlib import Path

from figure import BLUE, FAINT, GREEN, INK, PAPER, PURPLE, RED, SKY, Figure

TIMES = Path(__file__).resolve().parents[2] / "docs" / "results" / "chapter_06.csv"
YELLOW = "#f0c800"  # no orange: red is for balls that touch
RUNS = (("rest of its own row", YELLOW), ("next row, own layer", GREEN),
        ("row before, next layer", SKY), ("same row, next layer", BLUE),
        ("row after, next layer", PURPLE))
SIDE = 3  # cells along each axis of the small world
CELL = 54  # pixels


class EightBalls:
    """What the executable says of eight balls, the ball in the middle cell searching."""

    def __init__(self, run):
        said = run("--count", 8, "--seed", 397286)
        self.places, self.hashes, self.seeker = said["positions"], said["hashes"], said["seeker"]
        self.cells = [(h % SIDE, h // SIDE % SIDE, h // SIDE ** 2) for h in self.hashes]
        self.runs = list(zip(said["runs"][0::2], said["runs"][1::2]))
        pairs = zip(said["pairs"][0::2], said["pairs"][1::2])
        self.partners = [b for a, b in pairs if a == self.seeker]

    def run_of_slot(self, slot):
        return next((k for k, (begin, end) in enumerate(self.runs) if begin <= slot < end), None)

    def run_of_cell(self, x, y, z):
        """Which run covers a cell, counted from the searching ball's own."""
        own = self.cells[self.seeker]
        dx, dy, dz = (a - b for a, b in zip((x, y, z), own))
        if (dy, dz) == (0, 0):
            return 0 if dx in (0, 1) else None
        return {(1, 0): 1, (-1, 1): 2, (0, 1): 3, (1, 1): 4}.get((dy, dz))

    def place_in_cell(self, slot):
        """Pixels from the cell's upper left corner; near a border a little farther in, so that the
        whole ball is seen in its cell."""
        x, y = (place + SIDE / 2 - cell for place, cell in
                zip(self.places[slot], self.cells[slot][:2]))
        return tuple(min(max(at, 13), CELL - 13) for at in (x * CELL, (1 - y) * CELL))

    def distance(self, slot):
        return math.dist(self.places[slot], self.places[self.seeker])


def runs(run):
    """The 27 cells as three layers and as a block, and the same five runs in memory."""
    balls = EightBalls(run)
    figure = Figure(800, 486, "27 cells in three layers; the ball in the middle searches 14 of "
                    "them, which lie in memory as five runs of slots behind its own")
    for layer in range(SIDE):
        draw_layer(figure, balls, layer, 22 + 190 * layer, 52)
    draw_block(figure, balls, 588, 206)
    draw_memory(figure, balls, 118, 262)
    draw_legend(figure, balls, 22, 366)
    return figure.svg()


def draw_layer(figure, balls, layer, left, top):
    cell = CELL
    words = ("layer 0: not searched", "layer 1: its own", "layer 2: the next")[layer]
    figure.text(left + 1.5 * cell, top - 14, words, 14, bold=layer == 1)
    for y in range(SIDE):
        for x in range(SIDE):
            corner = left + x * cell, top + (SIDE - 1 - y) * cell
            found = balls.run_of_cell(x, y, layer)
            if found is not None:
                figure.rectangle(*corner, cell, cell, fill=RUNS[found][1], stroke="none",
                                 opacity=0.35)
            inside = [balls.place_in_cell(slot) for slot, place in enumerate(balls.cells)
                      if place == (x, y, layer)]
            draw_number(figure, corner, inside, (layer * SIDE + y) * SIDE + x)
    figure.grid(left, top, cell, SIDE, SIDE)
    for slot, (x, y, z) in enumerate(balls.cells):
        if z == layer:
            across, down = balls.place_in_cell(slot)
            draw_ball(figure, balls, slot, left + x * cell + across,
                      top + (SIDE - 1 - y) * cell + down)


def draw_number(figure, corner, balls, number):
    """A cell's number, in the corner that lies farthest from the balls in the cell."""
    corners = [(12, 11), (CELL - 12, 11), (12, CELL - 11), (CELL - 12, CELL - 11)]
    across, down = max(corners, key=lambda at: min((math.dist(at, b) for b in balls), default=0))
    figure.text(corner[0] + across, corner[1] + down + 4, number, 12, fill="#52606d")


def draw_ball(figure, balls, slot, x, y):
    if slot == balls.seeker:
        figure.circle(x, y, 11, fill=INK)
    elif slot in balls.partners:
        figure.circle(x, y, 11, fill=RED, stroke=RED)
    else:
        figure.circle(x, y, 11, fill=PAPER)
    dark = slot == balls.seeker or slot in balls.partners
    figure.text(x, y + 5, slot, 14, fill=PAPER if dark else INK, bold=True)


def draw_block(figure, balls, left, bottom):
    """The searched cells as cubes: x to the right, y up, z away; a gap between the layers."""
    size = 30

    def corner(x, y, z):
        away = z + 1.5 * (z >= 2)
        return left + size * (x + 0.42 * away), bottom - size * (y + 0.36 * away)

    figure.text(left + 90, 38, "14 of 27 cells", 14)
    for z in reversed(range(SIDE)):
        for y in range(SIDE):
            for x in range(SIDE):
                found = balls.run_of_cell(x, y, z)
                if found is not None:
                    draw_cube(figure, corner, (x, y, z), RUNS[found][1])


def draw_cube(figure, corner, cell, color):
    x, y, z = cell

    def at(dx, dy, dz):
        # The far side of a cube lies one step away, also where a gap follows.
        near, far = corner(x + dx, y + dy, z), corner(x + dx, y + dy, 1)
        step = corner(x + dx, y + dy, 0)
        return near if not dz else (near[0] + far[0] - step[0], near[1] + far[1] - step[1])

    for face in ([at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)],
                 [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)],
                 [at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)]):
        figure.path(face, stroke=PAPER, fill=color, width=1.2, closed=True)


def draw_memory(figure, balls, left, top):
    width, height = 62, 34
    for row, (word, y) in enumerate((("slot", top + 23), ("cell", top + 54))):
        figure.text(left - 14, y, word, 14, anchor="end", bold=row == 0)
    for slot, hash_ in enumerate(balls.hashes):
        x = left + slot * width
        found = balls.run_of_slot(slot)
        if found is not None:
            figure.rectangle(x, top, width, height, fill=RUNS[found][1], stroke="none",
                             opacity=0.35)
        figure.rectangle(x, top, width, height)
        draw_ball(figure, balls, slot, x + width / 2, top + height / 2)
        figure.text(x + width / 2, top + 54, hash_, 14)
    figure.text(left - 96, top - 12, "the same eight balls in memory, in cell order", 14,
                anchor="start")


def draw_legend(figure, balls, left, top):
    for k, ((words, color), (begin, end)) in enumerate(zip(RUNS, balls.runs)):
        y = top + 20 * k
        figure.rectangle(left, y - 12, 16, 14, fill=color, stroke="none", opacity=0.6)
        slots = "empty" if begin >= end else f"begin {begin}, end {end}"
        figure.text(left + 26, y, f"{words}: {slots}", 13, anchor="start")
    seeker = balls.seeker
    figure.text(400, top, f"ball {seeker} compares itself with", 13, anchor="start")
    slots = [slot for begin, end in balls.runs for slot in range(begin, end)]
    for k, slot in enumerate(slots):
        touches = slot in balls.partners
        figure.text(416, top + 20 * (k + 1) - 1, f"ball {slot}, {balls.distance(slot):.2f} m away"
                    + (": they touch" if touches else ""), 13, anchor="start",
                    fill=RED if touches else INK, bold=touches)


def rows():
    lines = [line for line in TIMES.read_text().splitlines() if line and line[0] != "#"]
    return [row for row in csv.DictReader(lines) if row["machine"] == "CPU" and
            row["threads"] == "1"]


def growth(run):
    """Both searches on one CPU thread, on logarithmic axes."""
    figure = Figure(700, 430, "Time against the number of balls on logarithmic axes: the naive "
                    "search rises with slope 2, the grid with slope 1")
    left, top, width, height = 90, 24, 400, 330
    powers_x, powers_y = (1, 6), (-4, 4)

    def place(count, ms):
        across = (math.log10(count) - powers_x[0]) / (powers_x[1] - powers_x[0])
        up = (math.log10(ms) - powers_y[0]) / (powers_y[1] - powers_y[0])
        return left + across * width, top + (1 - up) * height

    for power in range(powers_x[0], powers_x[1] + 1):
        x, _ = place(10 ** power, 1)
        figure.line(x, top, x, top + height, FAINT, 0.7)
        figure.text(x, top + height + 20, f"{10 ** power:,}".replace(",", " "))
    for power in range(powers_y[0], powers_y[1] + 1):
        _, y = place(10, 10.0 ** power)
        figure.line(left, y, left + width, y, FAINT, 0.7)
        figure.text(left - 8, y + 5, f"{10.0 ** power:g}", anchor="end")
    figure.text(left + width / 2, top + height + 46, "balls")
    figure.text(30, top + height / 2, "ms")
    for column, words, color in (("naive, ms", "every ball with every other", RED),
                                 ("grid and search, ms", "grid built and searched", BLUE)):
        points = [place(int(row["balls"]), float(row[column])) for row in rows() if row[column]]
        figure.path(points, stroke=color, width=2.5)
        for x, y in points:
            figure.circle(x, y, 3.5, fill=color, stroke=color)
        figure.text(points[-1][0] + 10, points[-1][1] + 5, words, 13, fill=color, anchor="start")
    return figure.svg()


FIGURES = {"runs": runs, "growth": growth}
PICTURES = {"seen": ["--count", "1000"]}
