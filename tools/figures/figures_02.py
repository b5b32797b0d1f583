"""Figures of chapter 02: the eight balls of the lesson in their numbered cells."""

import math

from figure import BLUE, FAINT, Figure, GREEN, INK, ORANGE, PURPLE, RED, SKY

LOWER, CELL, RESOLUTION = (-4, -3, -2), 2, (4, 3, 2)  # as in chapters/02_grid_hash/cells.cuh
SIDE = 92                                             # pixels of a cell
LEFT, TOP, GAP = 60, 58, 150
TINTS = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY)


def layer_left(layer):
    return LEFT + layer * (RESOLUTION[0] * SIDE + GAP)


def place(position, layer):
    """Where a position is drawn in the picture of a layer of cells."""
    x = layer_left(layer) + (position[0] - LOWER[0]) / CELL * SIDE
    y = TOP + (RESOLUTION[1] - (position[1] - LOWER[1]) / CELL) * SIDE
    return x, y


def draw_layer(figure, layer, hashes):
    columns, rows, _ = RESOLUTION
    left = layer_left(layer)
    for row in range(rows):
        for column in range(columns):
            number = (layer * rows + row) * columns + column
            x, y = left + column * SIDE, TOP + (rows - 1 - row) * SIDE
            if number in hashes:
                tint = TINTS[sorted(set(hashes)).index(number) % len(TINTS)]
                figure.rectangle(x, y, SIDE, SIDE, tint, "none", 0.18)
            figure.text(x + 8, y + SIDE - 9, number, 16, INK if number in hashes else FAINT,
                        "start", bold=number in hashes)
    figure.grid(left, TOP, SIDE, columns, rows)
    bottom = TOP + rows * SIDE
    for k in range(columns + 1):
        figure.text(left + k * SIDE, bottom + 20, LOWER[0] + k * CELL, 13, INK)
    for k in range(rows + 1):
        figure.text(left - 8, bottom - k * SIDE + 5, LOWER[1] + k * CELL, 13, INK, "end")
    figure.text(left + columns * SIDE / 2, bottom + 42, "x in m", 13)
    figure.text(left - 8, TOP - 20, "y in m", 13)
    low = LOWER[2] + layer * CELL
    figure.text(left + columns * SIDE / 2, TOP - 20,
                f"layer {layer}: z from {low} to {low + CELL} m", 15, bold=True)


def derivation(ball, position, number):
    """How the ball comes to its number, in one line."""
    in_cells = [(p - low) / CELL for p, low in zip(position, LOWER)]
    x, y, z = (math.floor(value) for value in in_cells)
    columns, rows, _ = RESOLUTION
    if (z * rows + y) * columns + x != number:
        raise ValueError(f"ball {ball} has number {number}, not that of its cell")
    steps = ", ".join(f"({p:g} + {-low}) / {CELL}" for p, low in zip(position, LOWER))
    values = ", ".join(f"{value:g}" for value in in_cells)
    return (f"ball {ball}: ({steps}) = ({values}), rounded down: cell ({x}, {y}, {z}), "
            f"number ({z} * {rows} + {y}) * {columns} + {x} = {number}")


def worked_example(run):
    found = run("--count", 8)
    positions, hashes = found["positions"], found["hashes"]
    columns, rows, layers = RESOLUTION
    if found["cells"] != columns * rows * layers:
        raise ValueError("cells.cuh has another grid than this figure")
    width = layer_left(layers - 1) + columns * SIDE + 40
    figure = Figure(width, TOP + rows * SIDE + 96,
                    "Two layers of 4 by 3 numbered cells with eight balls in them")
    for layer in range(layers):
        draw_layer(figure, layer, hashes)
    for ball, (position, number) in enumerate(zip(positions, hashes)):
        layer = number // (columns * rows)
        x, y = place(position, layer)
        if position[0] < LOWER[0]:
            figure.arrow(x + 17, y, layer_left(layer) + SIDE / 2, y)
            figure.text(x, y - 24, "outside", 13)
        figure.circle(x, y, 15, "#ffffff")
        figure.text(x, y + 5, ball, 15, bold=True)
    figure.text(width / 2, TOP + rows * SIDE + 78, derivation(5, positions[5], hashes[5]), 14)
    return figure.svg()


FIGURES = {"worked_example": worked_example}
PICTURES = {"cells": ["--width", 960, "--height", 540]}
