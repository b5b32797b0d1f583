"""Figures of chapter 08: the orbit, a polygon's error, a ray that meets a sphere."""

import math

from figure import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, RED, Figure

GREY = "#52606d"


def orbit(run):
    """Where the eye stands, from above and from the side."""
    eyes = run("--count", 8)["eyes"]
    figure = Figure(760, 330, "Two views of an orbit: from above the yaw turns from z towards x, from "
                    "the side the pitch rises from the level of the target")
    scale = 100  # pixels a metre
    level, raised = eyes[0::2], eyes[1::2]  # at yaw 0, 30, 60, 90
    x0, y0 = 70, 70
    figure.text(x0 + 130, 30, "from above, pitch 0", bold=True)
    figure.arrow(x0, y0, x0 + 240, y0, FAINT)
    figure.arrow(x0, y0, x0, y0 + 240, FAINT)
    figure.text(x0 + 252, y0 + 5, "x")
    figure.text(x0, y0 + 258, "z")
    arc = [(x0 + scale * 2 * math.sin(math.radians(a)), y0 + scale * 2 * math.cos(math.radians(a)))
           for a in range(91)]
    figure.path(arc, FAINT)
    for yaw, (x, _, z) in zip((0, 30, 60, 90), level):
        figure.line(x0, y0, x0 + scale * x, y0 + scale * z, BLUE, 1)
        figure.circle(x0 + scale * x, y0 + scale * z, 6, fill=BLUE, stroke=BLUE)
        figure.text(x0 + scale * x * 1.06 + 9, y0 + scale * z * 1.06 + (22 if yaw == 90 else 14),
                    f"yaw {yaw}: x {abs(x):.2f}, z {abs(z):.2f}", 13, anchor="start")
    figure.circle(x0, y0, 6, fill=INK)
    x1, y1 = 490, 250
    figure.text(x1 + 110, 30, "from the side, yaw 0", bold=True)
    figure.arrow(x1, y1, x1 + 240, y1, FAINT)
    figure.arrow(x1, y1, x1, y1 - 190, FAINT)
    figure.text(x1 + 252, y1 + 5, "z")
    figure.text(x1, y1 - 198, "y")
    for pitch, (_, y, z) in ((0, level[0]), (30, raised[0])):
        figure.line(x1, y1, x1 + scale * z, y1 - scale * y, BLUE, 1)
        figure.circle(x1 + scale * z, y1 - scale * y, 6, fill=BLUE, stroke=BLUE)
        figure.text(x1 + scale * z - 4, y1 - scale * y + (24 if pitch == 0 else -14),
                    f"pitch {pitch}: y {y:.2f}, z {z:.2f}", 13)
    figure.circle(x1, y1, 6, fill=INK)
    figure.text(x1, y1 + 24, "target", 13)
    return figure.svg()


def outline(run):
    """A circle and its polygon; how many slices a radius needs."""
    found = run("--count", 8)
    figure = Figure(760, 320, "An octagon in a circle misses it most in the middle of its edges; the "
                    "slices that keep the error below half a pixel grow with the root of the radius")
    x, y, radius, slices = 150, 165, 115, 8
    corners = [(x + radius * math.cos(2 * math.pi * k / slices),
                y + radius * math.sin(2 * math.pi * k / slices)) for k in range(slices)]
    figure.circle(x, y, radius, fill="#eef4fa", stroke=FAINT)
    figure.path(corners, BLUE, PAPER, 2, closed=True)
    middle = math.pi / slices
    inner = radius * math.cos(middle)
    at = [(x + r * math.cos(middle), y - r * math.sin(middle)) for r in (inner, radius)]
    figure.line(x, y, *at[0], GREY, 1)
    figure.line(*at[0], *at[1], RED, 4)
    figure.line(x, y, x + radius, y, GREY, 1)
    figure.text(x + 52, y + 18, "R", 14)
    figure.text(x + 34, y - 34, "R cos(π/8)", 12)
    figure.text(x, 306, "8 slices: the red part is the error", 13)
    left, bottom, width, height = 400, 250, 300, 200
    radii, needed = found["radii"], found["slices"]

    def place(pixels, count):
        return left + width * math.log2(pixels) / 8, bottom - height * count / 60

    for pixels in radii:
        across, _ = place(pixels, 0)
        figure.line(across, bottom, across, bottom - height, FAINT, 0.6)
        figure.text(across, bottom + 20, f"{pixels:g}", 12)
    for count in (0, 20, 40, 60):
        _, up = place(1, count)
        figure.line(left, up, left + width, up, FAINT, 0.6)
        figure.text(left - 10, up + 5, count, 12, anchor="end")
    figure.path([place(*pair) for pair in zip(radii, needed)], BLUE, width=2)
    for pixels, count in zip(radii, needed):
        across, up = place(pixels, count)
        figure.circle(across, up, 4, fill=BLUE, stroke=BLUE)
        figure.text(across - 6, up - 10, f"{count:g}", 12)
    figure.text(left + width / 2, bottom + 44, "radius in pixels", 13)
    figure.text(left + width / 2, 30, "slices for half a pixel of error", bold=True)
    return figure.svg()


def ray(run):
    """The worked example: a ball of radius 1 m whose centre the ray passes at 0.6 m."""
    figure = Figure(760, 290, "A ray from the eye passes a sphere's centre at 0.6 m: half the chord is "
                    "0.8 m, so it meets the sphere 0.8 m before its nearest point")
    scale = 100
    eye = (60, 120)
    nearest = (eye[0] + 5 * scale, eye[1])
    center = (nearest[0], nearest[1] + 0.6 * scale)
    hit = (nearest[0] - 0.8 * scale, eye[1])
    figure.circle(*center, scale, fill="#eef4fa", stroke=BLUE)
    figure.line(*eye, eye[0] + 680, eye[1], FAINT)
    figure.arrow(*eye, eye[0] + scale, eye[1], INK, 2.5)
    figure.line(*center, *nearest, ORANGE, 2.5)
    figure.line(*hit, *nearest, GREEN, 3)
    figure.line(*center, *hit, GREY, 1, dash="4 3")
    normal = ((hit[0] - center[0]) / scale, (hit[1] - center[1]) / scale)
    figure.arrow(*hit, hit[0] + 70 * normal[0], hit[1] + 70 * normal[1], RED, 2.5)
    for at, color in ((eye, INK), (nearest, ORANGE), (center, INK), (hit, RED)):
        figure.circle(*at, 4.5, fill=color, stroke=color)
    figure.text(eye[0], eye[1] + 24, "eye (0, 0, 0)", 13)
    figure.text(eye[0] + 62, eye[1] - 12, "ray (0, 0, -1)", 13)
    figure.text(hit[0] - 14, hit[1] + 26, "hit (0, 0, -4.2)", 13, anchor="end", fill=RED)
    figure.text(hit[0] - 64, hit[1] - 52, "normal (-0.6, 0, 0.8)", 13, anchor="end", fill=RED)
    figure.text(nearest[0] + 8, nearest[1] - 10, "nearest (0, 0, -5)", 13, anchor="start")
    figure.text(nearest[0] - 40, nearest[1] - 8, "0.8", 13, fill=GREEN)
    figure.text(nearest[0] + 8, nearest[1] + 36, "offset 0.6", 13, anchor="start", fill=ORANGE)
    figure.text(center[0] + 8, center[1] + 22, "centre (0.6, 0, -5)", 13, anchor="start")
    figure.text(center[0] - 48, center[1] - 16, "1", 13, fill=GREY)
    figure.text(200, 260, "seen from above, x down the page", 12, fill=GREY)
    return figure.svg()


MISTAKES_ARE_RENDERED = True
FIGURES = {"orbit": orbit, "outline": outline, "ray": ray}
PICTURES = {"side_by_side": ["--count", "8", "--width", "1440", "--height", "360"]}
