# SPDX-License-Identifier: BSD-3-Clause
"""Rounds of a robot on maps from outside the project: maps.py BUILD [--map NAME] [--seeds 1..10] [--localisation locate|segloc].

Each seed draws a start and six goals among the cells that are connected and farther from obstacles than the robot's hull and
5 cm. A round passes if all goals are reached without a collision and the position is always within 0.1 m of the truth.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import stage_maps

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAPS = ("depot", "tb3_sandbox", "warehouse", "willow-full-0.05", *stage_maps.PLANS)
CLEARANCE_M = 0.26 + 0.05
GOALS = 6
ERROR_M = 0.1


class Map:
    """The cells of a map_server map, with the origin of its frame unturned."""

    def __init__(self, file):
        text = file.read_text()
        value = lambda key: re.search(rf"(?m)^{key}:\s*(.*\S)", text)[1]
        self.resolution = float(value("resolution"))
        self.x, self.y = (float(word) for word in value("origin").strip("[]").split(",")[:2])
        free = re.search(r"(?m)^free_thresh:\s*(\S+)", text)
        occupied = re.search(r"(?m)^occupied_thresh:\s*(\S+)", text)
        self.width, self.height, pixels = self.pgm(file.parent / value("image"))
        self.cells = pixels
        self.is_free = [(255 - v) / 255 < (float(free[1]) if free else 0.196) for v in range(256)]
        self.is_occupied = [(255 - v) / 255 > (float(occupied[1]) if occupied else 0.65) for v in range(256)]

    @staticmethod
    def pgm(file):
        data = file.read_bytes()
        words, at = [], 0
        while len(words) < 4:
            match = re.compile(rb"\s*(?:#[^\n]*\n\s*)*(\S+)").match(data, at)
            words.append(match[1])
            at = match.end()
        width, height = int(words[1]), int(words[2])
        return width, height, data[at + 1:at + 1 + width * height]

    def open_region(self):
        """The largest connected set of free cells with clearance, in order."""
        width, height = self.width, self.height
        reach = CLEARANCE_M / self.resolution
        spread = int(reach) + 1
        disc = [(dx, dy) for dy in range(-spread, spread + 1) for dx in range(-spread, spread + 1)
                if max(0, abs(dx) - 0.5) ** 2 + max(0, abs(dy) - 0.5) ** 2 < reach ** 2]
        ring = [(dx, dy) for dx, dy in disc if not {(dx + 1, dy), (dx - 1, dy), (dx, dy + 1), (dx, dy - 1)} <= set(disc)]
        is_open = bytearray(self.is_free[v] for v in self.cells)
        occupied = [self.is_occupied[v] for v in self.cells]
        for i, blocked in enumerate(occupied):
            if not blocked:
                continue
            y, x = divmod(i, width)
            inner = 0 < x < width - 1 and occupied[i - 1] and occupied[i + 1] \
                and i >= width and occupied[i - width] and i + width < len(occupied) and occupied[i + width]
            for dx, dy in ring if inner else disc:
                if 0 <= x + dx < width and 0 <= y + dy < height:
                    is_open[i + dy * width + dx] = 0
        largest = []
        for start in range(len(is_open)):
            if not is_open[start]:
                continue
            is_open[start] = 0
            region, queue = [], collections.deque([start])
            while queue:
                i = queue.popleft()
                region.append(i)
                x = i % width
                for n in ([i - 1] if x > 0 else []) + ([i + 1] if x < width - 1 else []) + [i - width, i + width]:
                    if 0 <= n < len(is_open) and is_open[n]:
                        is_open[n] = 0
                        queue.append(n)
            if len(region) > len(largest):
                largest = region
        return sorted(largest)

    def centre(self, cell):
        row, column = divmod(cell, self.width)
        return (self.x + (column + 0.5) * self.resolution, self.y + (self.height - row - 0.5) * self.resolution)


def drive(build, file, region, world, seed, options):
    draw = random.Random(seed)
    points = [world.centre(draw.choice(region)) for _ in range(GOALS + 1)]
    heading = draw.uniform(-180, 180)
    (x, y), *goals = points
    with tempfile.TemporaryDirectory() as folder:
        summary = pathlib.Path(folder) / "summary.json"
        settings = [f"world.map.file={file}", "world.shapes=[]", "until_s=4000",
                    f"robots.0.start=[{x:.3f}, {y:.3f}, {heading:.1f}]",
                    "robots.0.goals=[" + ", ".join(f"[{a:.3f}, {b:.3f}]" for a, b in goals) + "]", *options]
        run = subprocess.run([build / "tools" / "waitpoint", "run", ROOT / "scenarios" / "office.yaml", "--seed", str(seed), "--summary", summary,
                              *(word for each in settings for word in ("--set", each))], capture_output=True, text=True)
        if not summary.exists():
            return {"failure": run.stderr.strip().splitlines()[-1:] or ["no summary"]}
        return json.loads(summary.read_text())


def map_file(data, name, folder):
    if name in stage_maps.PLANS:
        return stage_maps.write_map(name, data, folder)
    return (data / "maps" / f"{name}.yaml").resolve()


def rounds(arguments, name, file, seeds, options):
    """Prints a row for each seed; the numbers of rounds that passed and failed."""
    if file.suffix != ".yaml" or not file.exists():
        print(f"{name:18} skipped: no file {file}")
        return 0, 0
    world = Map(file)
    region = world.open_region()
    passed = failed = 0
    for seed in seeds:
        result = drive(arguments.build, file, region, world, seed, options)
        if "failure" in result:
            failed += 1
            print(f"{name:18} {seed:4} {result['failure'][0]}", flush=True)
            continue
        good = (result["goals_reached"] == GOALS and result["collisions"] == 0
                and result["position_error_max_m"] <= ERROR_M)
        passed, failed = passed + good, failed + (not good)
        print(f"{name:18} {seed:4} {result['goals_reached']:3} of {GOALS:1} {result['collisions']:9} "
              f"{result['position_error_mean_m']:8.3f} {result['position_error_max_m']:7.3f} "
              f"{result['simulated_s']:9.0f} {result['wall_s']:7.1f}"
              f"{'' if good else '  FAILED'}", flush=True)
    return passed, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--map", choices=MAPS, action="append")
    parser.add_argument("--seeds", default="1..10")
    parser.add_argument("--localisation", choices=("locate", "segloc"), default="locate")
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path(os.environ.get("WAITPOINT_DATA", ROOT.parent / "shared" / "data")))
    arguments = parser.parse_args()
    first, last = (int(word) for word in (arguments.seeds.split("..") * 2)[:2])
    options = [f"robot_types.rackham.modules.{module}.enabled={str(module == arguments.localisation).lower()}"
               for module in ("segloc", "locate")]
    passed = failed = 0
    print(f"{'map':18} {'seed':>4} {'goals':>6} {'collisions':>10} {'error m':>16} {'virtual s':>9} {'wall s':>7}")
    with tempfile.TemporaryDirectory() as folder:
        for name in arguments.map or MAPS:
            found = rounds(arguments, name, map_file(arguments.data, name, pathlib.Path(folder)), range(first, last + 1), options)
            passed, failed = passed + found[0], failed + found[1]
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
