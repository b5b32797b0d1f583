"""Figures of chapter 01: eight balls and the threads that compare them; time against count."""

import csv
import math
from pathlib import Path

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, RED, Figure

TIMES = Path(__file__).resolve().parents[2] / "docs" / "results" / "chapter_01.csv"
BLOCK = 3  # threads a block in the small example
BLOCK_COLORS = (BLUE, PURPLE, GREEN)


def squared_distance(balls, a, b):
    return sum((p - q) ** 2 for p, q in zip(balls["positions"][a], balls["positions"][b]))


def squared_reach(balls, a, b):
    return (balls["radii"][a] + balls["radii"][b]) ** 2


def eight_balls(run):
    """Left the balls from above, right what each thread compares."""
    balls = run("--count", 8, "--seed", 312)
    pairs = list(zip(balls["pairs"][0::2], balls["pairs"][1::2]))
    figure = Figure(760, 440, "Eight balls seen from above, and a triangle of 28 comparisons: thread "
                    "i compares ball i with the balls before it; three comparisons find a pair")
    draw_table(figure, balls, pairs)
    draw_triangle(figure, len(balls["radii"]), pairs)
    draw_numbers(figure, balls, pairs)
    return figure.svg()


def draw_table(figure, balls, pairs):
    left, top, size = 30, 56, 290
    positions, radii = balls["positions"], balls["radii"]
    lows = [min(p[axis] - r for p, r in zip(positions, radii)) for axis in (0, 2)]
    highs = [max(p[axis] + r for p, r in zip(positions, radii)) for axis in (0, 2)]
    scale = size / max(high - low for low, high in zip(lows, highs))
    places = [(left + (p[0] - lows[0]) * scale, top + (p[2] - lows[1]) * scale) for p in positions]
    touching = {ball for pair in pairs for ball in pair}
    figure.text(20, 24, "the balls, seen from above", anchor="start", bold=True)
    for ball, (x, y) in enumerate(places):
        color = RED if ball in touching else FAINT
        figure.circle(x, y, radii[ball] * scale, fill=color, stroke=color, opacity=0.3)
    for ball, (x, y) in enumerate(places):
        figure.text(x, y + 6, ball, 17, bold=True)


def draw_triangle(figure, count, pairs):
    left, top, cell = 540, 72, 30
    threads = math.ceil(count / BLOCK) * BLOCK
    figure.text(left - 160, 24, "thread i compares ball i with those before it", anchor="start",
                bold=True)
    for other in range(count - 1):
        figure.text(left + (other + 0.5) * cell, top - 8, other, 13)
    figure.text(left - 34, top - 8, "thread", 13)
    for thread in range(threads):
        y = top + thread * cell
        color = BLOCK_COLORS[thread // BLOCK]
        figure.text(left - 28, y + 20, thread, 14, fill=color, bold=True)
        for other in range(thread if thread < count else 0):
            hit = (other, thread) in pairs
            figure.rectangle(left + other * cell + 2, y + 2, cell - 4, cell - 4,
                             fill=RED if hit else "none", stroke=RED if hit else FAINT)
        if thread >= count:
            figure.text(left + 2, y + 20, "no ball: the guard ends it", 13, anchor="start")
    for block in range(threads // BLOCK):
        y = top + block * BLOCK * cell
        color = BLOCK_COLORS[block]
        figure.rectangle(left - 160, y + 2, 100, BLOCK * cell - 4, fill=color, stroke=color,
                         opacity=0.12)
        figure.text(left - 110, y + BLOCK * cell / 2 + 5, f"block {block}", 14, fill=color)


def draw_numbers(figure, balls, pairs):
    """The numbers of the closest hit and of the closest miss."""
    def gap(pair):
        return squared_distance(balls, *pair) - squared_reach(balls, *pair)

    count = len(balls["radii"])
    others = [(a, b) for b in range(count) for a in range(b) if (a, b) not in pairs]
    for row, (pair, sign, verdict) in enumerate(((max(pairs, key=gap), "<", "they touch"),
                                                 (min(others, key=gap), ">", "they do not"))):
        a, b = pair
        figure.text(20, 395 + 26 * row, f"balls {a} and {b}: squared distance "
                    f"{squared_distance(balls, a, b):.2f} {sign} "
                    f"({balls['radii'][a]:.2f} + {balls['radii'][b]:.2f})² = "
                    f"{squared_reach(balls, a, b):.2f}: {verdict}", 14, anchor="start")


def growth(run):
    """Time against count on logarithmic axes, from the measured table."""
    series = {}  # label: [(balls, ms)]
    lines = [line for line in TIMES.read_text().splitlines() if line and line[0] != "#"]
    for row in csv.DictReader(lines):
        threads = row["threads"]
        label = row["machine"] + (f", {threads} thread{'s' * (threads != '1')}" if threads else "")
        series.setdefault(label, []).append((int(row["balls"]), float(row["ms"])))
    figure = Figure(640, 420, "Time of the search against the number of balls on logarithmic axes, "
                    "and beside the lines one of slope 2")
    counts, times = zip(*(point for points in series.values() for point in points))
    plot = LogPlot(figure, 90, 30, 380, 320, counts, times)
    plot.axes("balls", "ms")
    for place, (name, measured) in enumerate(series.items()):
        color = (BLUE, ORANGE, GREEN, RED)[place % 4]
        points = [plot.point(count, time) for count, time in measured]
        figure.path(points, stroke=color, width=2.5)
        for x, y in points:
            figure.circle(x, y, 3.5, fill=color, stroke=color)
        plot.label(name, points[-1][1], color)
    first = next(iter(series.values()))
    plot.slope_two([count for count, _ in first], first[-1][1] * 4)
    return figure.svg()


def grouped(value):
    """1000000 as 1 000 000."""
    return f"{value:,.0f}".replace(",", " ") if value >= 1 else f"{value:g}"


class LogPlot:
    """Two logarithmic axes over whole powers of ten."""

    def __init__(self, figure, left, top, width, height, counts, times):
        self.figure, self.left, self.top = figure, left, top
        self.width, self.height = width, height
        self.x = (math.floor(math.log10(min(counts))), math.ceil(math.log10(max(counts))))
        self.y = (math.floor(math.log10(min(times))), math.ceil(math.log10(max(times) * 4)))
        self.label_places = []
        self.ends_at = self.point(max(counts), 1)[0]

    def point(self, count, time):
        across = (math.log10(count) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(time) - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * self.width, self.top + (1 - up) * self.height

    def axes(self, x_name, y_name):
        for power in range(self.x[0], self.x[1] + 1):
            x, _ = self.point(10 ** power, 10 ** self.y[0])
            self.figure.line(x, self.top, x, self.top + self.height, FAINT, 0.7)
            self.figure.text(x, self.top + self.height + 20, grouped(10 ** power))
        for power in range(self.y[0], self.y[1] + 1):
            _, y = self.point(10 ** self.x[0], 10.0 ** power)
            self.figure.line(self.left, y, self.left + self.width, y, FAINT, 0.7)
            self.figure.text(self.left - 8, y + 5, grouped(10.0 ** power), anchor="end")
        self.figure.text(self.left + self.width / 2, self.top + self.height + 46, x_name)
        self.figure.text(self.left - 62, self.top + self.height / 2, y_name)

    def slope_two(self, counts, last_time):
        """What a time that grows with the square of the count looks like."""
        ends = [self.point(count, last_time * (count / counts[-1]) ** 2)
                for count in (counts[0], counts[-1])]
        self.figure.line(*ends[0], *ends[1], stroke=INK, width=1.2, dash="6 4")
        self.label("slope 2: twice the", ends[1][1] - 9, INK)
        self.label("balls, four times as long", ends[1][1] + 9, INK)

    def label(self, words, y, color):
        """Words behind the end of a line, moved down if others stand there already."""
        while any(abs(y - other) < 17 for other in self.label_places):
            y += 1
        self.label_places.append(y)
        self.figure.text(self.ends_at + 10, y + 5, words, 13, fill=color, anchor="start")


FIGURES = {"eight_balls": eight_balls, "growth": growth}
PICTURES = {"table": ["--count", "120", "--width", "960", "--height", "540"]}
