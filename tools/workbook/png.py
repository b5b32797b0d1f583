"""Reads PNG files (8-bit gray, RGB, RGBA; not interlaced) and says how far two pictures differ."""

import struct
import zlib
from dataclasses import dataclass

from workbook.errors import ToolError

SIGNATURE = b"\x89PNG\r\n\x1a\n"
CHANNELS = {0: 1, 2: 3, 6: 4}  # PNG's colour type: bytes a pixel

# OpenGL drivers round differently; more than this is another picture.
MEAN_DIFFERENCE = 2.0        # of 255, averaged over all channels
FAR_OFF = 32                 # of 255: a pixel with a channel farther off counts as wrong
FAR_OFF_SHARE = 0.01


@dataclass(frozen=True)
class Picture:
    width: int
    height: int
    channels: int
    samples: bytes  # row by row from the top


def chunks(data, name):
    """The (type, content) pairs of a PNG file, checked for completeness."""
    if not data.startswith(SIGNATURE):
        raise ToolError(f"{name} is not a PNG file")
    position = len(SIGNATURE)
    while position < len(data):
        if position + 12 > len(data):
            raise ToolError(f"{name} is cut off")
        length, kind = struct.unpack_from(">I4s", data, position)
        content = data[position + 8:position + 8 + length]
        end = position + 12 + length
        if end > len(data) or zlib.crc32(kind + content) != struct.unpack(
                ">I", data[end - 4:end])[0]:
            raise ToolError(f"{name} is cut off or damaged")
        yield kind, content
        position = end


def paeth(left, up, corner):
    """Whichever of the three neighbours is nearest to left + up - corner."""
    guess = left + up - corner
    distances = abs(guess - left), abs(guess - up), abs(guess - corner)
    return (left, up, corner)[distances.index(min(distances))]


def unfiltered(kind, row, above, step):
    """A row as it was before PNG's filter `kind`; `above` is the finished row before it."""
    if kind == 2:
        return bytearray((value + up) & 255 for value, up in zip(row, above))
    if kind == 0:
        return row
    if kind not in (1, 3, 4):
        raise ValueError(f"PNG knows no row filter {kind}")
    for i, value in enumerate(row):
        left = row[i - step] if i >= step else 0
        if kind == 1:
            row[i] = (value + left) & 255
        elif kind == 3:
            row[i] = (value + (left + above[i]) // 2) & 255
        else:
            row[i] = (value + paeth(left, above[i], above[i - step] if i >= step else 0)) & 255
    return row


def decode(data, name="the picture"):
    """The Picture in the bytes of a PNG file; ToolError if it is damaged or of another kind."""
    header, packed = None, b""
    for kind, content in chunks(data, name):
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", content)
        elif kind == b"IDAT":
            packed += content
    if not header or header[2] != 8 or header[3] not in CHANNELS or header[6] != 0:
        raise ToolError(f"{name} is not a plain PNG with 8 bits a channel")
    width, height, channels = header[0], header[1], CHANNELS[header[3]]
    stride = width * channels
    try:
        raw = zlib.decompress(packed)
        if len(raw) != height * (stride + 1):
            raise ValueError("its size is wrong")
        rows = [bytearray(stride)]
        for start in range(0, len(raw), stride + 1):
            row = bytearray(raw[start + 1:start + 1 + stride])
            rows.append(unfiltered(raw[start], row, rows[-1], channels))
    except (zlib.error, ValueError) as error:
        raise ToolError(f"{name} is damaged: {error}") from None
    return Picture(width, height, channels, b"".join(rows[1:]))


def load(path):
    return decode(path.read_bytes(), str(path.name))


def difference(first, second, exact):
    """What tells two pictures apart, in words; empty if they are equal, or near enough for two
    OpenGL drivers where `exact` is false."""
    if first == second:
        return ""
    shapes = [(picture.width, picture.height, picture.channels) for picture in (first, second)]
    if shapes[0] != shapes[1]:
        return "sizes differ: {}x{} of {} channels, and {}x{} of {}".format(*shapes[0], *shapes[1])
    offsets = [abs(a - b) for a, b in zip(first.samples, second.samples)]
    step = first.channels
    worst = [max(offsets[i:i + step]) for i in range(0, len(offsets), step)]
    if exact:
        return f"{sum(value > 0 for value in worst)} of {len(worst)} pixels differ"
    mean = sum(offsets) / len(offsets)
    far_off = sum(value > FAR_OFF for value in worst) / len(worst)
    if mean <= MEAN_DIFFERENCE and far_off <= FAR_OFF_SHARE:
        return ""
    return (f"mean difference {mean:.2f} of 255 (allowed {MEAN_DIFFERENCE:g}), "
            f"{far_off:.1%} of pixels off by more than {FAR_OFF} (allowed {FAR_OFF_SHARE:.0%})")
