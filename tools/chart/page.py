"""Makes chart.html: one page with the data of many charts inside, for any browser, without a
network."""

import json
from pathlib import Path

import speed_chart

TEMPLATE = Path(__file__).with_name("page.html")
PLACE = '"DATA"'


def scene(path):
    """One chart as the page wants it."""
    notes, rows = speed_chart.read(path)
    return {"name": notes["chart"], "error": notes["error"], "held": notes["held against"],
            "tolerance": float(notes["tolerance"]), "seconds": notes["simulated"],
            "balls": notes["balls"], "measured": notes[""], "floor": speed_chart.floor_of(rows),
            "methods": {name: {"color": color, "marker": marker} for name, (color, marker)
                        in speed_chart.methods(rows).items()},
            "rows": [row | {"short": speed_chart.short_label(row)} for row in rows]}


def page(paths):
    """The text of the page for these CSV files."""
    data = json.dumps([scene(path) for path in paths], indent=None, separators=(",", ":"))
    before, after = TEMPLATE.read_text().split(PLACE)
    return before + data.replace("</", "<\\/") + after
