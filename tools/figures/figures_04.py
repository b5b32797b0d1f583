"""Figures of chapter 04: what the gather moves, and the line of memory through space."""

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, PURPLE, RED, Figure

COLORS = (BLUE, ORANGE, GREEN, PURPLE, RED)  # a cell each
SLICE = (5.5, 6.6)  # m along z: balls of about one layer of cells
FIRST, LAST = (0, 114, 178), (230, 159, 0)  # a line's colour from its first slot to its last


def gather(run):
    """Five balls, their order before and after, and from where each slot is filled."""
    found = run("--count", 5, "--seed", 7)
    ids, cells = found["ids"], found["cells"]
    cell_of = dict(zip(ids, cells))
    color_of = dict(zip(sorted(set(cells)), COLORS))
    left, width, top, bottom = 186, 108, 50, 200
    figure = Figure(760, 324, "Five slots of memory before and after: an arrow leads to each new "
                    "slot from the old slot that holds its ball; the cells rise from left to right")
    figure.text(20, top + 34, "from", anchor="start", code=True, bold=True, size=16)
    figure.text(20, bottom + 34, "to", anchor="start", code=True, bold=True, size=16)
    figure.text(20, bottom + 81, "sortedIndices", anchor="start", code=True, bold=True, size=14)
    for slot in range(len(ids)):
        x = left + width * slot
        figure.text(x + 46, top - 12, f"slot {slot}", fill=INK, size=13)
        figure.text(x + 46, bottom + 81, ids[slot], 18, color_of[cells[slot]], bold=True)
        figure.text(x + 46, bottom + 110, f"slot {slot}", fill=INK, size=13)
        source = ids[slot]  # as they came, ball k lies in slot k
        color = color_of[cell_of[source]]
        figure.arrow(left + width * source + 46, top + 58, x + 46, bottom - 4, color, 2.5, 10)
        for ball, y in ((slot, top), (source, bottom)):
            draw_ball(figure, x, y, ball, cell_of[ball], color_of[cell_of[ball]])
    return figure.svg()


def draw_ball(figure, x, y, ball, cell, color):
    figure.rectangle(x, y, 92, 54, PAPER, color)
    figure.rectangle(x, y, 92, 54, color, color, 0.16)
    figure.text(x + 46, y + 23, f"ball {ball}", bold=True)
    figure.text(x + 46, y + 43, f"cell {cell}", size=13)


def memory_line(run):
    """One slice of balls, joined slot by slot, before and after."""
    found = run("--count", 1000)
    positions = found["positions"]
    inside = [ball for ball, (_, _, z) in enumerate(positions) if SLICE[0] <= z < SLICE[1]]
    chosen = set(inside)
    orders = {"as they came": inside,
              "in cell order": [ball for ball in found["ids"] if ball in chosen]}
    figure = Figure(760, 440, f"The same {len(inside)} balls twice, joined in the order of memory: "
                    "as they came the line crosses the whole world at every step, in cell order it "
                    "sweeps the rows one after the other")
    for panel, (name, order) in enumerate(orders.items()):
        draw_line(figure, 24 + 376 * panel, 52, [positions[ball] for ball in order])
        figure.text(192 + 376 * panel, 34, name, size=17, bold=True)
    draw_scale(figure)
    return figure.svg()


def draw_line(figure, left, top, balls):
    side = 18.0  # m shown
    points = [(left + 336 * x / side, top + 336 * (1 - y / side)) for x, y, _ in balls]
    figure.rectangle(left, top, 336, 336, stroke=FAINT)
    for k in range(len(points) - 1):
        figure.line(*points[k], *points[k + 1], shade(k / len(points)), 2)
    for k, point in enumerate(points):
        figure.circle(*point, 4, shade(k / len(points)), PAPER)


def draw_scale(figure):
    for k in range(120):
        figure.line(262 + 2 * k, 415, 264 + 2 * k, 415, shade(k / 120), 8)
    figure.text(252, 420, "first slot", anchor="end")
    figure.text(512, 420, "last slot", anchor="start")


def shade(share):
    return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in zip(FIRST, LAST))


FIGURES = {"gather": gather, "memory_line": memory_line}
PICTURES = {"by_cell": ["--width", 960, "--height", 540]}
