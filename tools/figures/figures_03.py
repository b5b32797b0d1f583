"""The pictures of chapter 03: eight keys through three passes, the counters of the first of them,
and a longer list as bars."""

from figure import BLUE, FAINT, INK, ORANGE, SKY, Figure

PICTURES = {"balls": ["--width", 960, "--height", 540]}

DIGITS = 3           # of the keys in both lists: 9 bits
YELLOW, VIOLET = (0xfc, 0xd1, 0x40), (0x4d, 0x14, 0x73)


def title_of(pass_number):
    return "before" if pass_number == 0 else f"after pass {pass_number}"


def digit_of(key, place):
    """`place` 0 is the last digit."""
    return key >> 4 * place & 15


def eight_keys(run):
    """A column for each pass; lines show where every ball's pair goes."""
    data = run("--count", 8, "--seed", 7)
    keys, slots = [[data[f"{name}_{n}"] for n in range(DIGITS + 1)] for name in ("keys", "slots")]
    twice = next(key for key in keys[0] if keys[0].count(key) == 2)
    width, row, column, top = 78, 36, 205, 74
    figure = Figure(24 + 3 * column + width + 24, top + 8 * row + 34,
                    "Eight keys before, between and after three sorting passes")
    left = [24 + n * column for n in range(DIGITS + 1)]
    middle = [top + k * row + 13 for k in range(8)]
    for n in range(DIGITS):
        for k, slot in enumerate(slots[n]):
            marked = keys[n][k] == twice
            figure.line(left[n] + width + 3, middle[k], left[n + 1] - 5,
                        middle[slots[n + 1].index(slot)], ORANGE if marked else FAINT,
                        2.5 if marked else 1.5)
    for n in range(DIGITS + 1):
        figure.text(left[n] + width / 2, 26, title_of(n), bold=True)
        what = ["last", "middle", "first"]
        name, color = (f"next: the {what[n]} digit", BLUE) if n < DIGITS else ("sorted", INK)
        figure.text(left[n] + width / 2, 48, name, 12, color)
        for k, key in enumerate(keys[n]):
            draw_pair(figure, left[n], top + k * row, width, key, slots[n][k],
                      n if n < DIGITS else None, key == twice)
    figure.text(24, top + 8 * row + 22, "Left of each key: the number of its ball. Orange: two "
                "balls of one cell. They never change their order.", 13, anchor="start")
    return figure.svg()


def draw_pair(figure, x, y, width, key, slot, place, marked):
    """A ball's number and its key, with the digit at `place` underlaid."""
    figure.rectangle(x, y, width, 26, "#ffffff", ORANGE if marked else FAINT)
    figure.text(x + 14, y + 18, slot, 12, ORANGE if marked else INK)
    for digit in range(DIGITS):
        at = x + 36 + 14 * (DIGITS - 1 - digit)
        chosen = digit == place
        if chosen:
            figure.rectangle(at - 6, y + 3, 13, 20, SKY, "none", 0.45)
        figure.text(at, y + 18, f"{digit_of(key, digit):x}", 16, BLUE if chosen else INK,
                    bold=chosen, code=True)


def counters(run):
    """The counters of the first pass over the eight keys, before and after the scan."""
    keys, tile = run("--count", 8, "--seed", 7)["keys_0"], 4
    digits = sorted({digit_of(key, 0) for key in keys})
    tiles = [keys[:tile], keys[tile:]]
    counts = [[sum(digit_of(key, 0) == digit for key in part) for part in tiles]
              for digit in digits]
    flat = [count for row in counts for count in row]
    starts = [[sum(flat[:2 * r + c]) for c in range(2)] for r in range(len(digits))]
    top, step = 66, 30
    figure = Figure(740, top + len(digits) * step + 56,
                    "Counters of two tiles, digit by digit, and what the scan makes of them")
    for n, part in enumerate(tiles):
        figure.text(63 + 100 * n, 52, f"tile {n}", 13)
        for k, key in enumerate(part):
            draw_pair(figure, 24 + 100 * n, top + k * 36, 78, key, n * tile + k, 0, False)
    figure.text(113, 26, "the list, in tiles of four", bold=True)
    for x, table, name in [(300, counts, "counts"), (560, starts, "starts")]:
        draw_table(figure, x, top, step, digits, table, name)
    figure.arrow(456, top + 71, 540, top + 71)
    figure.text(496, top + 61, "scan", 13)
    digit, place = digits[-2], starts[-2][1]
    figure.text(24, top + len(digits) * step + 22, f"{place} pairs are counted before tile 1's "
                f"first pair with digit {digit:x}, so it goes to place {place}.", 13,
                anchor="start")
    figure.text(24, top + len(digits) * step + 42,
                "Rows of digits that do not occur are left out.", 13, anchor="start")
    return figure.svg()


def draw_table(figure, x, top, step, digits, table, name):
    """A row for each digit, a column for each of two tiles; a line in reading order behind them."""
    figure.text(x + 70, 26, name, bold=True)
    for column in range(2):
        figure.text(x + 50 + 60 * column, 52, f"tile {column}", 13)
    for row, digit in enumerate(digits):
        y = top + row * step
        figure.text(x, y + 15, f"{digit:x}", 15, BLUE, bold=True, code=True)
        for column in range(2):
            figure.rectangle(x + 25 + 60 * column, y, 50, 22, "#ffffff", FAINT)
            figure.text(x + 50 + 60 * column, y + 16, table[row][column], 14)
        figure.arrow(x + 75, y + 11, x + 84, y + 11, INK, 1, 4)


def shade(share):
    """From yellow (0) to violet (1)."""
    return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in zip(YELLOW, VIOLET))


def bars(run):
    """Height: the key. Colour: the digit that the pass looked at."""
    data = run("--count", 64, "--seed", 7)
    bar, height, gap, top = 3, 150, 22, 40
    panel = 64 * bar
    figure = Figure(gap + (DIGITS + 1) * (panel + gap), top + height + 40,
                    "Sixty-four keys as bars: after each pass they are in order of one more digit")
    for n in range(DIGITS + 1):
        x, keys = gap + n * (panel + gap), data[f"keys_{n}"]
        place = max(n - 1, 0)
        most = max(digit_of(key, place) for key in keys)
        figure.text(x + panel / 2, 24, title_of(n), bold=True)
        for k, key in enumerate(keys):
            size = 4 + (height - 4) * key / 511
            figure.add("rect", x=x + k * bar, y=top + height - size, width=bar, height=size,
                       fill=shade(digit_of(key, place) / most))
        figure.line(x, top + height, x + panel, top + height)
        name = ["last", "middle", "first"][place]
        figure.text(x + panel / 2, top + height + 22, f"colour: {name} digit", 12)
    return figure.svg()


FIGURES = {"eight_keys": eight_keys, "counters": counters, "bars": bars}
