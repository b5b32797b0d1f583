"""Figure of chapter 05: sorted slots, and the starts and ends of the cells they lie in."""

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, PURPLE, RED, Figure

COLORS = (BLUE, ORANGE, GREEN, PURPLE, RED, INK)  # a cell each
SLOTS = 8
LEFT, CELL = 96, 50
CELLS_TOP = 190


def cells(run):
    """The first eight slots of a run, and all cells from the first to the last of them."""
    found = run("--count", 16, "--seed", 77)
    hashes = found["hashes"][:SLOTS]
    first, last = hashes[0], hashes[-1]
    colors = dict(zip(sorted(set(hashes)), COLORS))
    figure = Figure(760, 400, "Eight sorted slots and thirteen cells: each occupied cell knows its "
                    "first slot and one past its last; up to two empty cells beside it know as well")
    figure.text(16, 74, "slots", anchor="start", bold=True)
    figure.text(16, CELLS_TOP + 26, "cells", anchor="start", bold=True)
    figure.text(16, CELLS_TOP + 66, "start", anchor="start", code=True)
    figure.text(16, CELLS_TOP + 98, "end", anchor="start", code=True)
    for slot, cell in enumerate(hashes):
        draw_slot(figure, slot, cell, first, colors[cell])
    for cell in range(first, last + 1):
        draw_cell(figure, cell, first, found, colors.get(cell))
    draw_example(figure, first, found, first + 2)
    return figure.svg()


def slot_x(slot):
    return LEFT + 61 + 68 * slot


def cell_x(cell, first):
    return LEFT + CELL * (cell - first)


def draw_slot(figure, slot, cell, first, color):
    x = slot_x(slot)
    figure.text(x + 23, 32, slot, fill=INK, size=13)
    figure.line(x + 23, 90, cell_x(cell, first) + 23, CELLS_TOP, color, 2)
    figure.rectangle(x, 42, 46, 48, color, color)
    figure.text(x + 23, 72, cell, 16, PAPER, bold=True)


def draw_cell(figure, cell, first, found, color):
    x = cell_x(cell, first)
    figure.rectangle(x, CELLS_TOP, 46, 40, color or PAPER, color or FAINT)
    figure.text(x + 23, CELLS_TOP + 26, cell, 15, PAPER if color else INK, bold=bool(color))
    start, end = found["starts"][cell], found["ends"][cell]
    none = start >= len(found["hashes"])
    for y, words, cleared in ((66, "none" if none else start, none), (98, end, end == 0)):
        figure.text(x + 23, CELLS_TOP + y, words, 15, FAINT if cleared else INK,
                    bold=bool(color))


def draw_example(figure, first, found, left):
    """A search that reads three cells: two loads, one run."""
    right = left + 2
    x1, x2 = cell_x(left, first) - 2, cell_x(right, first) + 48
    y = CELLS_TOP + 112
    figure.path([(x1, y), (x1, y + 12), (x2, y + 12), (x2, y)], RED, width=2.5)
    begin, end = found["starts"][left], found["ends"][right]
    figure.text(x1, y + 36, f"cells {left} to {right}: start of {left} is {begin}, end of {right} "
                f"is {end}, so slots {begin} to {end - 1}", fill=RED, anchor="start")
    for x, words, bold, fill in ((16, "bold: occupied", True, INK),
                                 (160, "plain: empty, an occupied cell answers for it", False, INK),
                                 (480, "grey: as it was cleared", False, FAINT)):
        figure.text(x, y + 72, words, size=13, fill=fill, anchor="start", bold=bold)


FIGURES = {"cells": cells}
PICTURES = {"around": ["--width", 960, "--height", 540]}
