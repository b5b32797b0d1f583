"""Figures of chapter 12: the worked example, the front of 666, and each scene's way to the plan."""

import math

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, RED, SKY, Figure


class Chart:
    """Log-log axes. Errors fall upwards; `cheap_right`: costs fall to the right."""

    def __init__(self, figure, box, x_powers, y_powers, cheap_right=True):
        self.figure, self.box = figure, box
        self.x_powers, self.y_powers, self.cheap_right = x_powers, y_powers, cheap_right

    def x(self, value):
        left, _, width, _ = self.box
        share = self.share(value, self.x_powers)
        return left + width * (1 - share if self.cheap_right else share)

    def y(self, error):
        _, top, _, height = self.box
        return top + height * self.share(error, self.y_powers)

    @staticmethod
    def share(value, powers):
        low, high = powers
        exponent = math.log10(value) if value > 0 else low
        return (min(max(exponent, low), high) - low) / (high - low)

    def axes(self, x_words, y_words):
        figure, (left, top, width, height) = self.figure, self.box
        for power in range(self.x_powers[0], self.x_powers[1] + 1):
            x = self.x(10 ** power)
            figure.line(x, top, x, top + height, FAINT, 0.5)
            figure.text(x, top + height + 18, ten_to(power), 12)
        for power in range(self.y_powers[0], self.y_powers[1] + 1):
            y = self.y(10 ** power)
            figure.line(left, y, left + width, y, FAINT, 0.5)
            figure.text(left - 8, y + 4, ten_to(power), 12, anchor="end")
        figure.line(left, top + height, left + width, top + height)
        figure.line(left, top, left, top + height)
        figure.text(left + width / 2, top + height + 40, x_words, 14)
        figure.text(left, top - 12, y_words, 14, anchor="start")

    def stairs(self, points, stroke=GREEN):
        """The front through (x, error): what is below and to the left of it is beaten."""
        ordered = sorted((self.x(x), self.y(error)) for x, error in points)
        left, _, _, _ = self.box
        way = [(left, ordered[0][1])]
        for (x, y), (_, after) in zip(ordered, ordered[1:] + [(0, self.box[1] + self.box[3])]):
            way += [(x, y), (x, after)]
        self.figure.path(way, stroke, width=2.5)


def ten_to(power):
    """0.01, 1000, 1e6."""
    return f"{10.0 ** power:g}" if -5 < power < 5 else f"1e{power}"


def cross(figure, x, y, stroke=RED, size=5):
    for side in (-1, 1):
        figure.line(x - size, y - side * size, x + size, y + side * size, stroke, 2.5)


def example(run):
    """Eight runs with their numbers; the front as stairs; a failed run as a cross."""
    found = run("--scene", "two_bodies", "--device", "cpu")
    runs = list(zip("abcdefgh", found["example_speeds"], found["example_errors"],
                    found["example_failed"], found["example_on_front"]))
    figure = Figure(640, 380, "Eight runs a to h: a, c, e and f are on the front, b, d and g are "
                    "beaten, h has failed")
    chart = Chart(figure, (72, 44, 540, 270), (-1, 2), (-4, 0), cheap_right=False)
    chart.axes("speed: simulated seconds in one second", "error: up is better")
    chart.stairs([(speed, error) for _, speed, error, _, on_front in runs if on_front])
    for name, speed, error, failed, on_front in runs:
        x, y = chart.x(speed), chart.y(error)
        if name == "f":  # the same place as e
            continue
        shown = "e, f" if name == "e" else name
        if failed:
            cross(figure, x, y)
        else:
            figure.circle(x, y, 7, GREEN if on_front else "#ffffff", INK)
        below = 18 if name == "d" else -8
        figure.text(x + 12, y + below, f"{shown} ({speed:g}, {error:g})", 13, anchor="start",
                    bold=bool(on_front))
    return figure.svg()


CURVES = {"original loop": RED, "coloured": ORANGE, "warm": PURPLE, "small-steps": BLUE}


def front(run):
    """All loops of the sweep in 666, a curve a method, and the front."""
    found = run("--scene", "six_cubed", "--device", "cpu")
    points = {key.split(":_")[1].removesuffix(",_numbers").replace("_", " "): value
              for key, value in found.items()
              if key.startswith("six_cubed:_") and key.endswith(",_numbers")}
    figure = Figure(760, 460, "666: the original loop lies at the bottom, small steps and one warm "
                    "loop are on the front; coloured has lost balls and counts as failed")
    chart = Chart(figure, (72, 44, 650, 350), (4, 7), (-4, 1))
    chart.axes("pair visits a simulated second: right is cheaper", "rms overlap / r: up is better")
    tolerance = found["six_cubed,_plan,_numbers"][2]
    figure.line(72, chart.y(tolerance), 722, chart.y(tolerance), FAINT, 1.5, "6 4")
    figure.text(718, chart.y(tolerance) - 6, f"tolerance {tolerance:g}", 12, INK, "end")
    chart.stairs([value[:2] for value in points.values() if value[4]])
    for method, color in CURVES.items():
        draw_curve(chart, method, color, [(name, value) for name, value in points.items()
                                          if name.startswith(method)])
    visits, error = points["plan"][:2]
    figure.circle(chart.x(visits), chart.y(error), 12, "none", GREEN)
    figure.text(chart.x(visits) + 16, chart.y(error) + 14, "plan", 14, GREEN, "start", bold=True)
    return figure.svg()


def draw_curve(chart, method, color, points):
    figure = chart.figure
    places = [(chart.x(value[0]), chart.y(value[1])) for _, value in points if not value[3]]
    if places:
        figure.path(places, color, width=1.5)
    for name, value in points:
        x, y = chart.x(value[0]), chart.y(value[1])
        if value[3]:
            cross(figure, x, chart.box[1] + chart.box[3], color)
        else:
            figure.circle(x, y, 5, color, INK)
    name, value = points[0]
    x, y = chart.x(value[0]), chart.y(value[1])
    if value[3]:
        figure.text(x + 8, chart.box[1] + chart.box[3] - 10, f"{method}: lost", 14, color, "middle",
                    bold=True)
    else:
        figure.text(x + 10, y + 18, method, 14, color, "start", bold=True)


# Scenes whose balls meet each other; and where a name stands, from the arrow's tip.
ARROWS = {"elastic_gas": (10, 16), "cooling_gas": (8, 16), "pocket": (-10, 16), "hub": (10, 4),
          "column": (10, 12), "heavy_on_light": (10, 4), "two_bodies": (10, -2),
          "six_cubed": (0, -10), "six_cubed_elastic": (-8, -10), "deep_pile": (-6, -8),
          "mixed_radii": (12, 26), "bullet": (4, -8)}
HUES = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY)


def arrows(run):
    """For each scene an arrow from the original loop to the plan."""
    found = run("--scene", "every", "--device", "cpu")
    figure = Figure(900, 560, "Arrows from the original loop to the chosen plan, one a scene: nearly "
                    "all of them go up, most of them right as well")
    chart = Chart(figure, (72, 44, 800, 450), (0, 7), (-5, 3))
    chart.axes("pair visits a simulated second: right is cheaper",
               "error / tolerance: up is better")
    figure.line(72, chart.y(1), 872, chart.y(1), INK, 1.5, "6 4")
    figure.text(80, chart.y(1) - 6, "good enough", 13, INK, "start")
    for (scene, (aside, down)), color in zip(ARROWS.items(), HUES * 2):
        ends = [found[f"{scene},_{loop},_numbers"] for loop in ("original_loop", "plan")]
        (x1, y1), (x2, y2) = [(chart.x(visits), chart.y(error / tolerance))
                              for visits, error, tolerance, _ in ends]
        if ends[0][3]:
            y1 = chart.box[1] + chart.box[3]
            cross(figure, x1, y1, color)
        else:
            figure.circle(x1, y1, 4, color, color)
        figure.arrow(x1, y1, x2, y2, color, 2, 10)
        figure.text(x2 + aside, y2 + down, scene, 13, color, "end" if aside < 0 else "start",
                    bold=True)
    return figure.svg()


FIGURES = {"example": example, "front": front, "arrows": arrows}
PICTURES = {"heap": ["--scene", "six_cubed", "--device", "cpu", "--pitch", 8,
                     "--width", 960, "--height", 540]}
