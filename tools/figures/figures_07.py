"""Figures of chapter 07: two balls before and after their contact, and one ball in a pocket."""

import math

from figure import BLUE, FAINT, GREEN, INK, ORANGE, RED, Figure

RADIUS = 0.5  # m
STONE = "#b8c4d0"


def vector(values):
    """(1.08, -1.44): the first two components, at most two decimals."""
    return "(" + ", ".join(f"{value:.2f}".rstrip("0").rstrip(".") for value in values[:2]) + ")"


def two_balls(run):
    """The lesson's worked example: left before, right after."""
    found = run("--device", "cpu")
    figure = Figure(760, 330, "A ball of 1 kg meets one of 2 kg at rest, off centre. Only the speed "
                    "along the line of centres changes.")
    places = found["two_balls_positions"]
    for left, title, speeds in ((0, "before", found["two_balls_before"]),
                                (380, "after", found["gathered_two_balls"])):
        figure.text(left + 190, 30, title, 16, bold=True)
        draw_pair(figure, left, places, speeds)
    figure.line(380, 20, 380, 310, FAINT, 1)
    return figure.svg()


def draw_pair(figure, left, places, speeds):
    scale, reach = 120, 34  # pixels a metre, pixels a metre a second

    def pixel(place):
        return left + 130 + scale * place[0], 205 - scale * place[1]

    centres = [pixel(place) for place in places]
    for (x, y), color in zip(centres, (BLUE, ORANGE)):
        figure.circle(x, y, scale * RADIUS, color, color, 0.25)
    draw_normal(figure, *centres)
    for (x, y), speed, color in zip(centres, speeds, (BLUE, ORANGE)):
        figure.circle(x, y, 3, color, color)
        if math.hypot(*speed) > 0:
            figure.arrow(x, y, x + reach * speed[0], y - reach * speed[1], color, 3.5, 12)
    (xa, ya), (xb, yb) = centres
    figure.text(xa - 16, ya + 88, f"a, 1 kg: {vector(speeds[0])} m/s")
    figure.text(xb + 20, yb - 74, f"b, 2 kg: {vector(speeds[1])} m/s")


def draw_normal(figure, a, b):
    """The line of centres, drawn out to both sides."""
    along = [(q - p) / math.dist(a, b) for p, q in zip(a, b)]
    start, end = [(centre[0] + way * along[0], centre[1] + way * along[1])
                  for centre, way in ((a, -95), (b, 95))]
    figure.line(*start, *end, FAINT, 1.5, "5 4")
    figure.text(end[0] + 6, end[1] + 14, "n", 16, INK, anchor="start", bold=True)


def pocket(run):
    """One ball on three, seen from the side: before, plain sum, split masses."""
    found = run("--device", "cpu")
    figure = Figure(760, 300, "A ball comes down on three that touch each other. A plain sum of the "
                    "three impulses throws it back and triples the energy; split masses stop it.")
    energies = [0.5, found["atomic:_energy_of_the_pocket,_J"],
                found["gathered:_energy_of_the_pocket,_J"]]
    panels = (("before", found["pocket_before"], INK), ("plain sum", found["atomic_pocket"], RED),
              ("split masses", found["gathered_pocket"], GREEN))
    for index, ((title, speeds, color), energy) in enumerate(zip(panels, energies)):
        middle = 127 + 253 * index
        figure.text(middle, 28, title, 16, bold=True)
        draw_pocket(figure, middle, found["pocket_positions"], speeds, color)
        figure.text(middle, 284, f"energy {energy:g} J", 15, color, bold=index > 0)
        if index:
            figure.line(253 * index, 16, 253 * index, 290, FAINT, 1)
    return figure.svg()


def draw_pocket(figure, middle, places, speeds, color):
    """Seen along z; the farthest ball is drawn first."""
    scale, reach = 84, 66  # pixels a metre, pixels a metre a second
    drawn = sorted(enumerate(zip(places, speeds)), key=lambda entry: entry[1][0][2])
    for ball, ((x, y, _), _) in drawn:
        shade = ORANGE if ball == 3 else STONE
        figure.circle(middle + scale * x, 196 - scale * y, scale * RADIUS, shade, INK, 0.75)
    for _, ((x, y, _), (u, v, _)) in drawn:
        if math.hypot(u, v) > 0.01:
            x0, y0 = middle + scale * x, 196 - scale * y
            figure.arrow(x0, y0, x0 + reach * u, y0 - reach * v, color, 3.5, 11)


FIGURES = {"two_balls": two_balls, "pocket": pocket}
PICTURES = {"order": ["--device", "cpu", "--width", 960, "--height", 540]}
