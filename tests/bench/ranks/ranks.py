# SPDX-License-Identifier: BSD-3-Clause
"""One run on several ranks: ranks.py BUILD [--quick] [--robots N,...] [--ranks N,...] [--json FILE].

For each number of robots and ranks: wall-clock time of a simulated second, processor time of the slowest rank in a window (a
step of the world), its part for the world, and the time of an exchange. Processor times hold also where there are more ranks than
cores; wall-clock times are printed only where there are not. A model is fitted to the runs of two and four ranks, compared with
all, and says what more cores would give.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
STEP_S = 0.01
CELL_M = 6
CORES = (8, 64, 1024)


def rooms(robots, folder):
    """A floor of rooms with a robot in each, which drives to and fro."""
    side = math.ceil(math.sqrt(robots))
    lines = ["format: 1", f"name: rooms-{robots}", "until_s: 600", "world:", "  step_ms: 10", "  shape_height_m: 2", "  shapes:"]
    for i in range(side + 1):
        at, end = i * CELL_M, side * CELL_M
        lines += [f"    - {{corners_m: [{at - 0.1}, -0.1, {at + 0.1}, {end + 0.1}]}}",
                  f"    - {{corners_m: [-0.1, {at - 0.1}, {end + 0.1}, {at + 0.1}]}}"]
    lines += [f"robot_types: {{include: {ROOT}/scenarios/rackham.yaml}}", "robots:"]
    for i in range(robots):
        x, y = i % side * CELL_M, i // side * CELL_M
        lines += [f"  - name: r{i}", "    type: rackham", f"    start: [{x + 1.5}, {y + 1.5}, 45]",
                  f"    goals: [[{x + 4.5}, {y + 4.5}], [{x + 1.5}, {y + 4.5}], [{x + 4.5}, {y + 1.5}]]"]
    file = folder / f"rooms-{robots}.yaml"
    file.write_text("\n".join(lines) + "\n")
    return file


def run(build, scenario, ranks, until_s, folder):
    """The best of two runs: wall-clock and processor seconds of the run alone."""
    best = None
    for _ in range(2):
        summary = folder / "summary.json"
        subprocess.run([build / "tools/waitpoint", "run", scenario, "--ranks", str(ranks), "--until", str(until_s), "--summary",
                        summary], capture_output=True, check=False)
        result = json.loads(summary.read_text())
        slowest = max(result.get("ranks", []), key=lambda rank: rank["computing_s"], default=None)
        figures = {"digest": result["digest"], "wall_s": result["wall_s"],
                   "computing_s": slowest["computing_s"] if slowest else result["wall_s"],
                   "world_s": slowest["world_s"] if slowest else None,
                   "exchange_s": min((rank["exchange_s"] for rank in result.get("ranks", [])), default=0)}
        if best is None or figures["computing_s"] < best["computing_s"]:
            best = figures
    return best


class Model:
    """Processor time of the slowest rank in a window, with n robots on r ranks: shared * n + own * ceil(n / r).

    Fitted to the runs of two and four ranks: a run of one is another program, which exchanges nothing, and whose robots do not
    share the caches with another process's.
    """

    def __init__(self, robots, one, two, four, windows):
        (at_two, at_four), (own_two, own_four) = (each["computing_s"] / windows for each in (two, four)), (
            math.ceil(robots / 2), math.ceil(robots / 4))
        self.own = min((at_two - at_four) / (own_two - own_four), at_four / own_four)
        self.shared = (at_four - self.own * own_four) / robots
        self.exchange = two["exchange_s"] / windows
        self.one = one["computing_s"] / windows

    def computing(self, robots, ranks):
        return self.shared * robots + self.own * math.ceil(robots / ranks)

    def window(self, robots, ranks):
        """With an exchange that takes as many steps as a number of ranks has binary digits."""
        return self.computing(robots, ranks) + self.exchange * max(1, math.log2(ranks))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="10 and 100 robots")
    parser.add_argument("--robots", help="numbers of robots (default: 10,100,1000)")
    parser.add_argument("--ranks", help="numbers of ranks (default: 1,2,4,8)", default="1,2,4,8")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    robots_of = [int(n) for n in (options.robots or ("10,100" if options.quick else "10,100,1000")).split(",")]
    ranks_of = sorted({1, 2, 4, *(int(n) for n in options.ranks.split(","))})
    cores = len(os.sched_getaffinity(0))
    rows, predictions = [], []
    print(f"{'robots':>7} {'ranks':>6} {'wall ms a s':>12} {'us a window':>12} {'of it world':>12} {'exchange us':>12} {'model':>8} {'error':>7}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for robots in robots_of:
            scenario, until_s = rooms(robots, folder), 20 if robots <= 100 else 3
            windows = until_s / STEP_S
            measured = {ranks: run(options.build, scenario, ranks, until_s, folder) for ranks in ranks_of}
            if len({each["digest"] for each in measured.values()}) != 1:
                sys.exit(f"ranks: the digests of {robots} robots differ: {measured}")
            model = Model(robots, measured[1], measured[2], measured[4], windows)
            for ranks, each in measured.items():
                used = each["computing_s"] / windows * 1e6
                wall = each["wall_s"] / until_s * 1e3 if ranks <= cores else None
                told = model.computing(robots, ranks) * 1e6
                world = each["world_s"] / each["computing_s"] if each["world_s"] is not None else None
                exchange = each["exchange_s"] / windows * 1e6 if 1 < ranks <= cores else None
                print(f"{robots:>7} {ranks:>6} {'' if wall is None else f'{wall:.1f}':>12} {used:>12.1f} "
                      f"{'' if world is None else f'{world:.0%}':>12} {'' if exchange is None else f'{exchange:.1f}':>12} "
                      f"{told:>8.1f} {told / used - 1:>+7.0%}")
                case = f"{robots} robots, {ranks} ranks"
                rows.append({"bench": "ranks", "case": case, "who": "waitpoint", "value": used, "unit": "us a window"})
                if wall is not None:
                    rows.append({"bench": "ranks", "case": case, "who": "waitpoint", "value": wall, "unit": "ms a simulated second"})
            predictions.append((robots, model))
    print(f"\nthe model, with an exchange of as many steps as the number of ranks has binary digits:\n{'robots':>7} {'cores':>6} "
          f"{'us a window':>12} {'speed-up':>9} {'shared':>12}")
    for robots, model in predictions:
        for count in CORES:
            window = model.window(robots, count)
            print(f"{robots:>7} {count:>6} {window * 1e6:>12.1f} {model.one / window:>9.1f} {model.shared * robots / window:>12.0%}")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
