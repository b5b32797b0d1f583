"""A sheet for the lessons' figures: a few shapes in the house colours, given out as SVG text.

A chapter's script, figures_NN.py, holds

    FIGURES = {"cells": cells}                  # figures/cells.svg is what cells(run) returns;
                                                # run("--count", 8) gives the executable's JSON
    PICTURES = {"view": ["--count", "500"]}     # figures/view.png: the executable renders it
"""

import math
from xml.sax.saxutils import escape

INK, FAINT, PAPER = "#1f2933", "#9aa5b1", "#ffffff"
# Told apart by readers who see colours differently, too (Okabe and Ito, 2008).
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9")
PALETTE = (BLUE, ORANGE, GREEN, RED, PURPLE, SKY)


def number(value):
    """At most two decimals, the same text on every machine."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class Figure:
    """Coordinates are pixels: x to the right, y down. Later shapes lie on earlier ones."""

    def __init__(self, width, height, title):
        """`title` says in one sentence what is seen, for readers who cannot see it."""
        self.width, self.height, self.title = width, height, title
        self.shapes = []

    def add(self, tag, content="", **attributes):
        """Any SVG element; `stroke_width` becomes `stroke-width`, None leaves an attribute out."""
        words = [tag]
        for key, value in attributes.items():
            if value is not None:
                shown = number(value) if isinstance(value, (int, float)) else str(value)
                shown = escape(shown, {'"': "&quot;"})
                words.append(f'{key.rstrip("_").replace("_", "-")}="{shown}"')
        end = f">{content}</{tag}>" if content else "/>"
        self.shapes.append(f"<{' '.join(words)}{end}")

    def line(self, x1, y1, x2, y2, stroke=INK, width=1.5, dash=None):
        self.add("line", x1=x1, y1=y1, x2=x2, y2=y2, stroke=stroke, stroke_width=width,
                 stroke_dasharray=dash)

    def rectangle(self, x, y, width, height, fill="none", stroke=INK, opacity=None):
        self.add("rect", x=x, y=y, width=width, height=height, fill=fill, stroke=stroke,
                 stroke_width=1.5, fill_opacity=opacity)

    def circle(self, x, y, radius, fill="none", stroke=INK, opacity=None):
        self.add("circle", cx=x, cy=y, r=radius, fill=fill, stroke=stroke, stroke_width=1.5,
                 fill_opacity=opacity)

    def path(self, points, stroke=INK, fill="none", width=1.5, closed=False):
        """Straight lines from point to point."""
        steps = " L".join(f"{number(x)},{number(y)}" for x, y in points)
        self.add("path", d=f"M{steps}{' Z' if closed else ''}", stroke=stroke, fill=fill,
                 stroke_width=width, stroke_linejoin="round")

    def arrow(self, x1, y1, x2, y2, stroke=INK, width=1.5, head=7):
        """A line with a filled head at (x2, y2)."""
        angle = math.atan2(y2 - y1, x2 - x1)
        wings = [(x2 - head * math.cos(angle + side), y2 - head * math.sin(angle + side))
                 for side in (0.45, -0.45)]
        self.line(x1, y1, x2, y2, stroke, width)
        self.path([wings[0], (x2, y2), wings[1]], stroke, stroke, 1, closed=True)

    def text(self, x, y, words, size=14, fill=INK, anchor="middle", bold=False, code=False):
        """`anchor` is start, middle or end; y is the baseline."""
        self.add("text", escape(str(words)), x=x, y=y, font_size=size, fill=fill,
                 text_anchor=anchor, font_weight="bold" if bold else None,
                 font_family="monospace" if code else None)

    def grid(self, x, y, cell, columns, rows, stroke=FAINT):
        """The lines of a grid whose top-left corner is (x, y)."""
        for column in range(columns + 1):
            self.line(x + column * cell, y, x + column * cell, y + rows * cell, stroke, 1)
        for row in range(rows + 1):
            self.line(x, y + row * cell, x + columns * cell, y + row * cell, stroke, 1)

    def svg(self):
        """The finished picture, on white paper, readable on dark pages as well."""
        size = f'width="{number(self.width)}" height="{number(self.height)}"'
        box = f'viewBox="0 0 {number(self.width)} {number(self.height)}"'
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} {box} role="img" '
            f'font-family="sans-serif">',
            f"<title>{escape(self.title)}</title>",
            f'<rect {size} fill="{PAPER}"/>',
            *self.shapes, "</svg>"]) + "\n"
