"""Figures of chapter 09: two pixel buffers in turn, a picture walked backwards, 4:2:0, the clip."""

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, RED, Figure

BUFFERS = (BLUE, ORANGE)  # buffer 0, buffer 1
FRAMES = 5


def buffers(run):
    """Frame k is drawn, copied while k + 1 is drawn, and fetched then."""
    figure = Figure(800, 310, "Time line of five frames: while frame k + 1 is drawn, frame k is "
                    "copied into pixel buffer k modulo 2; then it is fetched and handed on")
    left, width = 120, 108
    rows = (("draw", 70), ("buffer 0", 120), ("buffer 1", 170), ("hand on", 230))
    for words, y in rows:
        figure.text(16, y + 6, words, 14, anchor="start", bold=words == "draw")
    for k in range(FRAMES):
        draw_frame(figure, k, left, width, rows)
    for edge in range(FRAMES + 1):
        x = left + edge * width
        figure.line(x, 40, x, 256, FAINT, 1, dash="3 4")
    figure.arrow(left, 284, left + 6 * width - 14, 284)
    figure.text(left, 302, "time", 13, anchor="start")
    figure.text(left + FRAMES * width + 46, 30, "release", 13)
    return figure.svg()


def draw_frame(figure, k, left, width, rows):
    """One frame's way through all rows."""
    color = BUFFERS[k % 2]
    x = left + k * width
    figure.rectangle(x + 4, rows[0][1] - 16, width - 8, 32, fill=INK, stroke=INK)
    figure.text(x + width / 2, rows[0][1] + 6, f"frame {k}", 14, PAPER)
    y = rows[1 + k % 2][1]
    there = x + width
    figure.rectangle(there + 4, y - 16, width - 8, 32, fill=color, stroke=color, opacity=0.85)
    figure.text(there + width / 2, y + 6, f"frame {k}", 14, PAPER, bold=True)
    figure.line(there, rows[0][1] + 16, there + 6, y - 16, color, 1.5)
    end = there + width - 12 if k < FRAMES - 1 else there + width - 40
    figure.arrow(end, y + 16, end, rows[3][1] - 14, color, 1.8)
    figure.text(end, rows[3][1] + 6, f"{k}", 14, color, bold=True)


def flip(run):
    """Rows of a picture in memory, the bottom one first; the walk from the top one down."""
    top, step = (int(value) for value in run("--count", 1)["rows,_top_and_step"])
    rows = top // -step + 1
    figure = Figure(760, 270, f"Four rows in memory, the bottom row first: the walk begins at byte "
                    f"{top} and goes {step} bytes to the row below")
    left, cell, height, high = 150, 92, 40, 60
    figure.text(left, 32, f"memory: rows of {-step} bytes", 14, anchor="start", bold=True)
    for row in range(rows):
        y = high + row * height
        fill = (RED, ORANGE, GREEN, BLUE)[row]
        figure.rectangle(left, y, 2 * cell, height, fill=fill, opacity=0.3)
        figure.text(left - 12, y + 25, f"byte {-step * row}", 13, anchor="end", code=True)
        figure.text(left + cell, y + 25, name_of_row(rows - 1 - row, rows), 14)
    x = left + 2 * cell + 18
    for row in range(rows - 1, 0, -1):
        y = high + row * height
        figure.arrow(x, y + height / 2 - 4, x, y - height / 2 + 4, INK, 1.8)
        figure.text(x + 12, y + 5, step, 13, anchor="start", code=True)
    figure.text(x + 12, high + rows * height - 12, f"top = {top}", 13, anchor="start", code=True)
    there = 540
    figure.text(there, 32, "what the converter sees", 14, anchor="start", bold=True)
    for row in range(rows):
        fill = (BLUE, GREEN, ORANGE, RED)[row]
        y = high + row * height
        figure.rectangle(there, y, 2 * cell, height, fill=fill, opacity=0.3)
        figure.text(there + cell, y + 25, name_of_row(row, rows), 14)
    figure.arrow(x + 74, high + 2 * height, there - 20, high + 2 * height, INK, 2.2, head=10)
    return figure.svg()


def name_of_row(row, rows):
    """Rows are counted from the top."""
    return {0: "top row", rows - 1: "bottom row"}.get(row, f"row {row}")


def yuv(run):
    """A block of four by four pixels, and what 4:2:0 keeps of it."""
    said = run("--count", 1)
    colors = [tuple(int(value) for value in said["block,_rgb"][3 * k:3 * k + 3]) for k in range(16)]
    figure = Figure(800, 268, "Sixteen pixels, their sixteen brightnesses, and four values each of "
                    "u and v: one for two by two pixels")
    cell, top = 46, 52
    for left, words in ((20, "16 pixels: 48 bytes"), (240, "y: 16 bytes"), (460, "u: 4 bytes"),
                        (620, "v: 4 bytes")):
        figure.text(left, 34, words, 14, anchor="start", bold=True)
    for k in range(16):
        x, y = k % 4 * cell, top + k // 4 * cell
        red, green, blue = colors[k]
        figure.rectangle(20 + x, y, cell, cell, fill=f"rgb({red},{green},{blue})", stroke=PAPER)
        bright = int(said["block,_y"][k])
        figure.rectangle(240 + x, y, cell, cell, fill=f"rgb({bright},{bright},{bright})",
                         stroke=PAPER)
        figure.text(240 + x + cell / 2, y + 29, bright, 14, PAPER if bright < 120 else INK)
    for left, name in ((460, "block,_u"), (620, "block,_v")):
        for k in range(4):
            draw_chroma(figure, left + k % 2 * 66, top + 26 + k // 2 * 66, int(said[name][k]), name)
    return figure.svg()


def draw_chroma(figure, x, y, value, name):
    """One u or v, tinted by what it says: bluer or redder than grey, or less so."""
    away = value - 128
    tint = (BLUE if away > 0 else ORANGE) if name.endswith("u") else (RED if away > 0 else GREEN)
    figure.rectangle(x, y, 66, 66, fill=tint, stroke=PAPER, opacity=min(1, abs(away) / 90 + 0.1))
    figure.text(x + 33, y + 39, value, 16)


FIGURES = {"buffers": buffers, "flip": flip, "yuv": yuv}
PICTURES = {"sheet": []}
MISTAKES_ARE_RENDERED = True  # and encoded: other encoders give slightly other pixels
