# SPDX-License-Identifier: BSD-3-Clause
"""Floor plans of Stage's worlds as maps of map_server: the bitmap, drawn at the size that the world gives it, with square cells.

As in Stage, what is darker than half is occupied, and the border of a plan is closed.
"""

import struct
import zlib

CELL_M = 0.05
# Name: bitmap, its size in metres by the worlds that use it, and what is taken of it: x and y from the lower left corner. The
# largest connected space of the whole hospital is the open ground about it, of which a laser sees nothing.
PLANS = {"cave": ("cave.png", 16.0, 16.0, (0, 0, 16, 16)), "hospital_section": ("hospital.png", 140.0, 60.0, (5, 5, 65, 23.5))}


def grey_png(file):
    """Width, height and rows of an 8-bit greyscale PNG that is not interlaced."""
    data = file.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert (depth, colour, interlace) == (8, 0, 0), file
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, rows, above = zlib.decompress(packed), [], bytearray(width)
    for r in range(height):
        start = r * (width + 1)
        row = bytearray(raw[start + 1:start + 1 + width])
        unfilter(raw[start], row, above)
        rows.append(row)
        above = row
    return width, height, rows


def unfilter(kind, row, above):
    for i in range(len(row) if kind else 0):
        left, up, corner = (row[i - 1], above[i], above[i - 1]) if i else (0, above[0], 0)
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:
            off = [abs(left + up - corner - each) for each in (left, up, corner)]
            guess = (left, up, corner)[off.index(min(off))]
        row[i] = (row[i] + guess) & 255


def write_map(name, data, folder):
    """The YAML file, or the bitmap that is not there."""
    bitmap, width_m, height_m, (left, low, right, high) = PLANS[name]
    source = data / "stage" / "bitmaps" / bitmap
    if not source.exists():
        return source
    width, height, rows = grey_png(source)
    across, down = round((right - left) / CELL_M), round((high - low) / CELL_M)
    columns = [int((left + (c + 0.5) * CELL_M) * width / width_m) for c in range(across)]
    cells = bytearray()
    for r in range(down):
        row = rows[int((height_m - high + (r + 0.5) * CELL_M) * height / height_m)]
        inner = bytes(0 if row[c] < 128 else 255 for c in columns)
        cells += bytes(across) if r in (0, down - 1) else b"\0" + inner[1:-1] + b"\0"
    (folder / f"{name}.pgm").write_bytes(b"P5\n%d %d\n255\n" % (across, down) + cells)
    file = folder / f"{name}.yaml"
    file.write_text(f"image: {name}.pgm\nresolution: {CELL_M}\norigin: [{left - width_m / 2}, {low - height_m / 2}, 0]\n"
                    "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
    return file
