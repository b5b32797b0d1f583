"""Chapter 00: eight threads place eight balls, seen as arrays and from above."""

import math

from figure import FAINT, INK, PAPER, Figure

SCALE = 46  # pixels a metre
MIDDLE = (530, 242)
WIDTH, HEIGHT = 760, 484


def css(color):
    """A colour of three numbers between 0 and 1, as a browser wants it."""
    return "#" + "".join(f"{round(255 * part):02x}" for part in color)


def ink_on(color):
    """Dark letters on a light colour, white ones on a dark one."""
    red, green, blue = (int(color[k:k + 2], 16) for k in (1, 3, 5))
    return INK if 0.3 * red + 0.59 * green + 0.11 * blue > 125 else PAPER


def eight(run):
    found = run("--count", 8)
    colors = [css(color) for color in found["colors"]]
    figure = Figure(WIDTH, HEIGHT, "Eight threads each write one element of an array; on the right "
                    "the eight balls from above, each a golden turn further round than the last.")
    draw_threads(figure, colors)
    draw_hill(figure, found, colors)
    return figure.svg()


def draw_threads(figure, colors):
    figure.text(100, 40, "one call an index", bold=True)
    figure.text(252, 40, "positions", bold=True)
    for index, color in enumerate(colors):
        y = 62 + 48 * index
        figure.text(100, y + 23, f"placeBall({index}, ...)", code=True)
        figure.arrow(178, y + 18, 228, y + 18, FAINT)
        figure.rectangle(234, y, 36, 36, color)
        figure.text(252, y + 23, index, fill=ink_on(color), bold=True)


def draw_hill(figure, found, colors):
    x0, y0 = MIDDLE
    figure.text(x0, 26, "the hill from above", bold=True)
    places = [(SCALE * x, SCALE * z) for x, _, z in found["positions"]]
    for x, z in places:
        figure.circle(x0, y0, math.hypot(x, z), stroke=FAINT)
    radii = [SCALE * found["radius_of_the_first_ball"]] * len(places)
    for index, ((x, z), radius, color) in enumerate(zip(places, radii, colors)):
        figure.circle(x0 + x, y0 + z, radius, color)
        figure.text(x0 + x, y0 + z + 6, index, 18, ink_on(color), bold=True)
    draw_turn(figure, places)
    figure.text(x0, HEIGHT - 14, "ring of ball i: √(2i + 1) m; from ball to ball 0.618 of a turn")


def draw_turn(figure, places):
    """The golden turn from ball 0 to ball 1, as an arc around the middle."""
    x0, y0 = MIDDLE
    turn = math.atan2(places[1][1], places[1][0]) % (2 * math.pi)
    points = [(x0 + 16 * math.cos(turn * k / 40), y0 + 16 * math.sin(turn * k / 40))
              for k in range(41)]
    figure.path(points[:-1], INK, width=2)
    figure.arrow(*points[-3], *points[-1], INK, 2)


FIGURES = {"eight": eight}
PICTURES = {"hello": ["--width", 960, "--height", 540]}
