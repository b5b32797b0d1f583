"""Figures of chapter 10: which copy of the bodies each stage of a step reads and writes."""

from figure import BLUE, FAINT, GREEN, INK, PAPER, RED, Figure

STAGES = ("integrate", "build grid", "round 1", "round 2")
LEFT, STEP, WIDTH = 176, 132, 66  # pixels: first column, column to column, a box
HEIGHT = 34


def free_copy(committed, in_use):
    """As otherWorkingCopy does it."""
    return (committed + 1) % 3 if in_use == committed else 3 - committed - in_use


def path_of(committed, moving):
    """The copy that holds the bodies before the step and after each of its stages."""
    now, path = committed, [committed]
    for stage in STAGES:
        if moving or stage == "build grid":
            now = free_copy(committed, now)
        path.append(now)
    return path


def flow(run):
    """Two groups of three copies; a step goes through them from left to right."""
    figure = Figure(800, 450, "A step from left to right: it reads the committed copy of the bodies "
                    "and goes to and fro between the two others; at the end, two numbers change")
    for column, name in enumerate(STAGES):
        figure.text(LEFT + (column + 0.5) * STEP + WIDTH / 2, 46, name, 15, bold=True)
    figure.text(LEFT + WIDTH / 2, 24, "state", 15, GREEN, bold=True)
    figure.text(LEFT + 4 * STEP + WIDTH / 2, 24, "new state", 15, GREEN, bold=True)
    draw_group(figure, 60, "positions,", "velocities", path_of(0, moving=True))
    draw_group(figure, 228, "restitutions,", "ids", path_of(0, moving=False))
    draw_repeat(figure, 402)
    return figure.svg()


def draw_group(figure, top, first, second, path):
    figure.text(16, top + 66, first, 14, anchor="start")
    figure.text(16, top + 84, second, 14, anchor="start")

    def corner(column, copy):
        return LEFT + column * STEP, top + 48 * copy

    for copy in range(3):
        x, y = corner(0, copy)
        figure.text(x - 12, y + 23, f"copy {copy}", 13, anchor="end")
        figure.line(x, y + HEIGHT / 2, LEFT + 4 * STEP + WIDTH, y + HEIGHT / 2, FAINT, 0.6, "2 5")
    x, y = corner(0, path[0])
    figure.rectangle(x, y, 4 * STEP + WIDTH, HEIGHT, GREEN, "none", 0.14)
    for column, (before, now) in enumerate(zip(path, path[1:]), 1):
        (xa, ya), (xb, yb) = corner(column - 1, before), corner(column, now)
        if before != now:
            figure.arrow(xa + WIDTH, ya + HEIGHT / 2, xb - 2, yb + HEIGHT / 2, INK, 2, 9)
    for column, copy in enumerate(path):
        x, y = corner(column, copy)
        color = GREEN if column in (0, len(path) - 1) else BLUE
        if column in (0, len(path) - 1) or copy != path[column - 1]:
            figure.rectangle(x, y, WIDTH, HEIGHT, PAPER, "none")
            figure.rectangle(x, y, WIDTH, HEIGHT, color, color, 0.35)
        elif copy != path[0]:
            figure.rectangle(x, y, WIDTH, HEIGHT, color, "none", 0.15)


def draw_repeat(figure, y):
    start, end = LEFT + WIDTH / 2, LEFT + 4 * STEP + WIDTH / 2
    figure.line(end, y - 18, end, y, RED, 2)
    figure.line(end, y, start, y, RED, 2, "7 5")
    figure.arrow(start, y, start, y - 18, RED, 2, 9)
    figure.text((start + end) / 2, y + 26, "list too short, or grid stale: once more from the state, "
                "which nobody has touched", 14, RED)


FIGURES = {"flow": flow}
PICTURES = {"gravity_fall": ["--plan", "original", "--frames", "130", "--width", "960",
                             "--height", "540"]}
