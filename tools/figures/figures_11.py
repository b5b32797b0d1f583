"""Figures of chapter 11: a colouring in rounds, and two duels step by step."""

import math

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, RED, Figure

PLACES = [(0.0, 1.0), (1.1, 1.0), (2.2, 1.0), (0.55, 0.05), (1.65, 0.05)]  # of the five balls
COLOURS = (BLUE, ORANGE, GREEN, PURPLE, RED)
STONE = "#e3e8ed"


def colours(run):
    """Five balls, seven contacts: which of them take their colour in each round."""
    found = run("--scene", "pocket", "--device", "cpu")
    contacts = list(zip(found["example_contacts"][0::2], found["example_contacts"][1::2]))
    priorities, given = found["example_priorities"], found["example_colours"]
    rounds = found["example_rounds"]
    shown = max(rounds)
    width = 62 + 232 * shown
    figure = Figure(width, 236, f"Seven contacts of five balls get their colours in {shown} rounds; "
                    "in each round those whose priority is the smallest at both balls")
    for number in range(1, shown + 1):
        left = 46 + 232 * (number - 1)
        figure.text(left + 82, 28, f"round {number}", 16, bold=True)
        if number > 1:
            figure.line(left - 37, 16, left - 37, 222, FAINT, 1)
        for (a, b), priority, colour, at in zip(contacts, priorities, given, rounds):
            draw_contact(figure, left, PLACES[a], PLACES[b], priority, COLOURS[colour], at - number)
        for ball, place in enumerate(PLACES):
            x, y = pixel(left, place)
            figure.circle(x, y, 17, STONE, INK)
            figure.text(x, y + 5, ball, 14)
    return figure.svg()


def pixel(left, place):
    return left + 75 * place[0], 186 - 112 * place[1]


def draw_contact(figure, left, a, b, priority, colour, rounds_to_go):
    """A line with its priority: thick in the round of its colour, thin after, dashed before."""
    (xa, ya), (xb, yb) = pixel(left, a), pixel(left, b)
    if rounds_to_go > 0:
        figure.line(xa, ya, xb, yb, FAINT, 1.5, "4 4")
    else:
        figure.line(xa, ya, xb, yb, colour, 7 if rounds_to_go == 0 else 2.5)
    x, y = (xa + xb) / 2, (ya + yb) / 2
    figure.circle(x, y, 10, "#ffffff", colour if rounds_to_go <= 0 else FAINT)
    figure.text(x, y + 5, priority, 13, INK if rounds_to_go >= 0 else FAINT)


def duels(run):
    """The gas' energy and the column's overlap, step by step, each under two methods."""
    figure = Figure(800, 310, "Left, an elastic gas: its energy explodes with the plain sum and "
                    "stays with coloured pairs. Right, a column of ten: it sinks with coloured pairs "
                    "and stands with warm impulses.")
    gas = run("--scene", "gas", "--device", "cpu")
    curves = [(gas["gas,_jacobi:_track"], "jacobi", RED), (gas["gas,_coloured:_track"], "coloured", BLUE)]
    draw_chart(figure, 62, "elastic gas: energy / at start", curves, (0, 2))
    column = run("--scene", "column", "--device", "cpu")
    curves = [(column["column,_coloured:_track"], "coloured", BLUE),
              (column["column,_warm:_track"], "warm", GREEN)]
    draw_chart(figure, 462, "column of ten: deepest overlap / r", curves, (-4, 1))
    return figure.svg()


def draw_chart(figure, left, title, curves, powers):
    """Lines over the step, on a logarithmic axis from 10^powers[0] to 10^powers[1]."""
    width, top, bottom = 300, 54, 262
    low, high = powers

    def height(value):
        exponent = math.log10(max(value, 10 ** low))
        return bottom - (bottom - top) * (min(exponent, high) - low) / (high - low)

    figure.text(left + width / 2, 30, title, 15, bold=True)
    for power in range(low, high + 1):
        y = height(10 ** power)
        figure.line(left, y, left + width, y, FAINT, 0.75)
        figure.text(left - 8, y + 5, f"{10.0 ** power:g}", 12, anchor="end")
    figure.line(left, bottom, left + width, bottom)
    figure.line(left, top, left, bottom)
    last = max(len(values) for values, _, _ in curves)
    for values, name, color in curves:
        points = [(left + width * (step + 1) / last, height(value))
                  for step, value in enumerate(values)]
        figure.path(points, color, width=2.5)
        x, y = points[-1]
        figure.text(x - 4, y - 10, name, 14, color, "end", bold=True)
    figure.text(left, bottom + 20, "0", 12)
    figure.text(left + width, bottom + 20, f"{last} steps", 12, anchor="end")


FIGURES = {"colours": colours, "duels": duels}
PICTURES = {"pile": ["--scene", "pile", "--device", "cpu", "--pitch", 8,
                     "--width", 960, "--height", 540],
            "column": ["--scene", "column", "--device", "cpu", "--pitch", 5,
                       "--width", 960, "--height", 540]}
