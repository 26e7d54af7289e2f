# SPDX-License-Identifier: BSD-3-Clause
"""Fields of cylinders by a cellular automaton, after Perille, Truong, Xiao, Stone, "Benchmarking metric ground
navigation", SSRR 2020: cells are filled at random; in each smoothing step a cell with many filled neighbours is filled
and one with few is emptied. A field is kept if a disc of a given radius fits through. The same numbers give the same
fields anywhere: the generator's random numbers are its own.
"""
import heapq
import math
import re

CELL_M, RADIUS_M = 0.15, 0.075
COLUMNS, ROWS = 30, 66           # 4.5 m across, as far as the start of the goal's side
FILLS, SMOOTHINGS = (0.15, 0.20, 0.25, 0.30), (2, 3, 4)


class Random:
    """SplitMix64."""

    def __init__(self, seed):
        self.state = seed

    def uniform(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & (2**64 - 1)
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & (2**64 - 1)
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & (2**64 - 1)
        return ((z ^ (z >> 31)) >> 11) / 2.0**53


def cells_of(seed, fill, smoothing):
    random = Random(seed)
    filled = [[random.uniform() < fill for _ in range(COLUMNS)] for _ in range(ROWS)]
    for _ in range(smoothing):
        def neighbours(row, column):
            return sum(filled[r][c] for r in range(max(0, row - 1), min(ROWS, row + 2))
                       for c in range(max(0, column - 1), min(COLUMNS, column + 2)) if (r, c) != (row, column))
        counts = [[neighbours(r, c) for c in range(COLUMNS)] for r in range(ROWS)]
        filled = [[counts[r][c] >= 5 or (filled[r][c] and counts[r][c] > 1) for c in range(COLUMNS)]
                  for r in range(ROWS)]
    return filled


def cylinders_of(seed, fill, smoothing):
    """The walls on both sides and behind the start are as in the benchmark; clear rows at start and goal."""
    filled = cells_of(seed, fill, smoothing)
    centres = [(-4.5 + (c + 0.5) * CELL_M, (r + 0.5) * CELL_M) for r in range(ROWS) for c in range(COLUMNS)
               if (filled[r][c] and 4.2 < r * CELL_M < 9.6) or c in (0, COLUMNS - 1)]
    return centres + [(-4.5 + (c + 0.5) * CELL_M, 0.5 * CELL_M) for c in range(1, COLUMNS - 1)]


def read_field(file):
    """The centres of the cylinders of a world."""
    with open(file, encoding="utf-8") as text:
        models = text.read().split("<state", 1)[0]
    poses = re.findall(r"<model name='unit_cylinder[^']*'>\s*<pose[^>]*>\s*(\S+)\s+(\S+)", models)
    return [(float(x), float(y)) for x, y in poses]


def write_field(file, centres):
    with open(file, "w", encoding="utf-8") as out:
        out.write("<sdf version='1.6'>\n<world name='field'>\n")
        for number, (x, y) in enumerate(centres):
            out.write(f"<model name='unit_cylinder_{number}'><pose>{x:.6f} {y:.6f} 0 0 0 0</pose><static>1</static>"
                      f"<link name='link'><pose>0 0 0.5 0 0 0</pose><collision name='c'><geometry><cylinder>"
                      f"<radius>{RADIUS_M}</radius><length>1</length></cylinder></geometry></collision></link></model>\n")
        out.write("</world>\n</sdf>\n")


def write_fields(folder, count, start, goal, fits_m):
    files, seed = [], 0
    while len(files) < count:
        seed += 1
        fill, smoothing = FILLS[seed % len(FILLS)], SMOOTHINGS[seed // len(FILLS) % len(SMOOTHINGS)]
        centres = cylinders_of(seed, fill, smoothing)
        if math.isinf(shortest_path_m(centres, start, goal, fits_m)):
            continue
        files.append(folder / f"field_{seed}.world")
        write_field(files[-1], centres)
    return files


STEPS = [(x, y) for x in range(-2, 3) for y in range(-2, 3) if math.gcd(x, y) == 1]


def shortest_path_m(centres, start, goal, radius_m=0.21, step_m=0.05):
    """Of a disc's centre, over steps to 16 neighbours; infinite if it does not fit through."""
    low = (-4.5 - 1, -1.0)
    width, height = round(6.5 / step_m), round(16 / step_m)
    reach = radius_m + RADIUS_M
    closed = [[False] * width for _ in range(height)]
    for x, y in centres:
        for row in range(math.ceil((y - reach - low[1]) / step_m), math.floor((y + reach - low[1]) / step_m) + 1):
            span = math.sqrt(max(0.0, reach * reach - (low[1] + row * step_m - y) ** 2))
            first, last = math.ceil((x - span - low[0]) / step_m), math.floor((x + span - low[0]) / step_m)
            for column in range(max(0, first), min(width - 1, last) + 1):
                if 0 <= row < height:
                    closed[row][column] = True
    cell = lambda p: (round((p[0] - low[0]) / step_m), round((p[1] - low[1]) / step_m))
    (sx, sy), (gx, gy) = cell(start), cell(goal)
    best = {(sx, sy): 0.0}
    heap = [(math.hypot(gx - sx, gy - sy), sx, sy)]
    while heap:
        _, x, y = heapq.heappop(heap)
        if (x, y) == (gx, gy):
            return best[x, y] * step_m
        for dx, dy in STEPS:
            to = (x + dx, y + dy)
            if not (0 <= to[0] < width and 0 <= to[1] < height) or closed[to[1]][to[0]]:
                continue
            cost = best[x, y] + math.hypot(dx, dy)
            if cost < best.get(to, math.inf) - 1e-9:
                best[to] = cost
                heapq.heappush(heap, (cost + math.hypot(gx - to[0], gy - to[1]), *to))
    return math.inf
