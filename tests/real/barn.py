#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives a robot through fields of cylinders, and prints a table.

The fields are the worlds of the BARN benchmark in $WAITPOINT_DATA (default: ../shared/data), and generated ones
(cylinder_fields.py). A row for each field, shape, speed and map: seeds that succeeded, collisions, mean time, and the
benchmark's metric: 1 if it succeeded, times OT / clip(AT, 2 OT, 8 OT), where AT is the time taken and OT that of the
shortest path at 2 m/s. The last line is "N passed, M failed": runs that reached the goal without a collision, and
the others.
"""
import argparse
import concurrent.futures
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cylinder_fields

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHAPES = {"disc": "{radius_m: 0.3, height_m: 0.4}", "rectangle": "{size_m: [0.43, 0.42], height_m: 0.4}"}
# Of the disc that fits through a generated field: for the disc, with the planner's clearance; the rectangle turns where it can.
FITS_M = {"disc": 0.35, "rectangle": 0.28}
START, GOAL, REFERENCE_SPEED_M_S = (-2.25, 3.0), (-2.25, 13.0), 2.0


def barn_worlds():
    data = pathlib.Path(os.environ.get("WAITPOINT_DATA", ROOT.parent / "shared" / "data")) / "barn"
    worlds = sorted(data.glob("world_*.world"), key=lambda file: int(re.sub(r"\D", "", file.stem)))
    if not worlds:
        print(f"no worlds in {data}: only generated fields", file=sys.stderr)
    return worlds


def generated(folder, count, shape):
    folder = folder / shape
    folder.mkdir()
    return cylinder_fields.write_fields(folder, count, START, GOAL, FITS_M[shape])


def run(arguments, world, length_m, shape, speed, known, seed):
    command = [arguments.waitpoint, "run", str(ROOT / "tests/real/barn.yaml"), "--seed", str(seed), "--summary", "-",
               "--set", f"world.map={{file: {world}, known: {str(known).lower()}}}",
               "--set", f"robots.jackal.shape={SHAPES[shape]}",
               "--set", f"robots.jackal.modules.ndd.v_m_s_max={speed}"]
    for assignment in arguments.set:
        command += ["--set", assignment]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr.strip())
    summary = json.loads(done.stdout)
    success = summary["goals_reached"] == 1 and summary["collisions"] == 0
    optimal_s = length_m / REFERENCE_SPEED_M_S
    taken_s = summary["simulated_s"]
    metric = optimal_s / min(max(taken_s, 2 * optimal_s), 8 * optimal_s) if success else 0
    return success, summary["collisions"], taken_s, metric


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--waitpoint", default=str(ROOT / "build/tools/waitpoint"))
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--generated", type=int, default=0, help="number of generated fields")
    parser.add_argument("--no-barn", action="store_true", help="only generated fields")
    parser.add_argument("--shapes", default="disc,rectangle")
    parser.add_argument("--speeds", default="0.5,1,2")
    parser.add_argument("--maps", default="known,unknown")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--set", action="append", default=[], help="KEY=VALUE, as of waitpoint run")
    parser.add_argument("--brief", action="store_true", help="no row for each field")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        barn = [] if arguments.no_barn else barn_worlds()
        worlds = {shape: barn + generated(pathlib.Path(folder), arguments.generated, shape)
                  for shape in arguments.shapes.split(",")}
        lengths = {w: cylinder_fields.shortest_path_m(cylinder_fields.read_field(w), START, GOAL)
                   for w in itertools.chain(*worlds.values())}
        cases = list(itertools.product(worlds, arguments.speeds.split(","),
                                       arguments.maps.split(",")))
        failed = passed = 0
        print(f"{'world':<14}{'shape':<11}{'m/s':<6}{'map':<9}{'success':>9}{'collisions':>12}{'time s':>9}{'metric':>8}")
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            for shape, speed, map_kind in cases:
                started = {w: [pool.submit(run, arguments, w, lengths[w], shape, speed, map_kind == "known", seed)
                               for seed in range(1, arguments.seeds + 1)] for w in worlds[shape]}
                every = []
                for world, runs in started.items():
                    rows = [one.result() for one in runs]
                    every += rows
                    if not arguments.brief or not all(row[0] for row in rows):
                        print_row(world.stem, shape, speed, map_kind, rows)
                print_row(f"all {len(worlds[shape])}", shape, speed, map_kind, every)
                passed += sum(row[0] for row in every)
                failed += sum(not row[0] for row in every)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


def print_row(name, shape, speed, map_kind, rows):
    count = len(rows)
    reached = f"{sum(row[0] for row in rows)}/{count}"
    print(f"{name:<14}{shape:<11}{speed:<6}{map_kind:<9}{reached:>9}{sum(row[1] for row in rows):>12}"
          f"{sum(row[2] for row in rows) / count:>9.2f}{sum(row[3] for row in rows) / count:>8.3f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
