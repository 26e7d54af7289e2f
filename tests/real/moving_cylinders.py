#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the robot of barn.yaml through fields of moving cylinders, after the DynaBARN benchmark, and prints a table.

Each cylinder goes to and fro on a parabola across the field, at a constant speed, whatever is in its way; with --varied their
radii differ, their ways are parabolas or waves, and they stop and turn back at any time. A row for each number of
cylinders and greatest speed of them; success: the goal is reached, and the robot has had no collision, with a cylinder
that drives into it neither. The last line is "N passed, M failed"; status 0 if nine in ten pass.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cylinder_fields import Random

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEFT, RIGHT, LOW, HIGH = -5.25, 0.75, 5.0, 11.0  # the cylinders' field; the robot comes from y = 3 and goes to y = 13
PIECE_S = 0.5
# What moves does not give way, so the robot keeps farther away than from a field that stands.
SETTINGS = ["executive={replan_ms: 100}", "modules.ndd.emergency_distance_m=0.15", "modules.ndd.security_distance_m=0.5",
            "modules.ndd.reaction_s=0.2", "modules.ndd.foresight_s=2"]


def way_of(random, varied):
    """The heading of a way, by x."""
    slope, bend = random.uniform() - 0.5, 0.3 * (random.uniform() - 0.5)
    middle = 0.5 * (LEFT + RIGHT)
    if varied and random.uniform() < 0.5:
        swing, per_m, phase = 1.2 * random.uniform(), 0.5 + 2 * random.uniform(), 6.3 * random.uniform()
        return lambda at: math.atan(slope) + swing * math.sin(per_m * at + phase)
    return lambda at: math.atan(slope + 2 * bend * (at - middle))


def cylinder(name, random, speed_max, varied, starts):
    """A robot without software, and the commands of its base: v and w of each piece of its way."""
    speed = speed_max * (0.4 + 0.6 * random.uniform())
    y = LOW + (HIGH - LOW) * random.uniform()
    heading = way_of(random, varied)
    x = LEFT + (RIGHT - LEFT) * random.uniform()
    radius = 0.1 + 0.3 * random.uniform() if varied else 0.2
    while any(math.hypot(x - other[0], y - other[1]) < radius + other[2] + 0.2 for other in starts):
        x, y = LEFT + (RIGHT - LEFT) * random.uniform(), LOW + (HIGH - LOW) * random.uniform()
    starts.append((x, y, radius))
    text = (f"{{name: {name}, shape: {{radius_m: {radius:.3f}, height_m: 1}}, start: [{x:.3f}, {y:.3f}, "
            f"{math.degrees(heading(x)):.2f}], base: {{kind: synchro, v_max_m_s: 2, w_max_rad_s: 3, "
            f"v_acceleration_m_s2: 20, w_acceleration_rad_s2: 40}}}}")
    commands, forward, time_s = [], random.uniform() < 0.5, 0.02
    while time_s < 60:
        stands = varied and random.uniform() < 0.1
        forward ^= varied and random.uniform() < 0.05
        v = 0 if stands else speed if forward else -speed
        to = x + v * math.cos(heading(x)) * PIECE_S
        if not LEFT < to < RIGHT:
            forward = not forward
            continue
        w = (heading(to) - heading(x)) / PIECE_S
        commands.append((time_s, f"at {time_s:.2f} command {name} v_m_s={v:.4f} w_rad_s={w:.5f}"))
        x, time_s = to, time_s + PIECE_S
    return text, commands


def run(arguments, count, speed_max, shape, seed):
    random = Random(1000 * seed + count)
    starts = []
    cylinders = [cylinder(f"c{i}", random, speed_max, arguments.varied, starts) for i in range(count)]
    commands = sorted((each for _, some in cylinders for each in some), key=lambda each: each[0])
    robots = "".join(f"  - {text}\n" for text, _ in cylinders)
    scenario = (ROOT / "tests/real/barn.yaml").read_text().replace("robots:\n", "robots:\n" + robots)
    file = pathlib.Path(arguments.folder) / f"moving_{count}_{speed_max}_{shape}_{seed}.yaml"
    file.write_text(scenario)
    command = [arguments.waitpoint, "run", str(file), "--seed", str(seed), "--interactive", "--summary",
               str(file) + ".json"]
    for setting in SETTINGS:
        command += ["--set", "robots.jackal." + setting]
    if shape == "disc":
        command += ["--set", "robots.jackal.shape={radius_m: 0.3, height_m: 0.4}"]
    for assignment in arguments.set:
        command += ["--set", assignment]
    script = "\n".join(text for _, text in commands) + "\nuntil jackal.goals >= 1\nquit\n"
    done = subprocess.run(command, input=script, capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr.strip() or done.stdout[-500:])
    summary = json.loads(pathlib.Path(str(file) + ".json").read_text())
    robot = next(each for each in summary["robots"] if each["name"] == "jackal")
    return summary["goals_reached"] == 1 and robot["collisions"] == 0, robot["collisions"], summary["simulated_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--waitpoint", default=str(ROOT / "build/tools/waitpoint"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--cylinders", default="5,10")
    parser.add_argument("--speeds", default="0.5,1")
    parser.add_argument("--shapes", default="rectangle,disc")
    parser.add_argument("--varied", action="store_true", help="radii and ways of all kinds")
    parser.add_argument("--set", action="append", default=[], help="KEY=VALUE, as of waitpoint run")
    arguments = parser.parse_args()
    passed = failed = 0
    print(f"{'cylinders':<11}{'to m/s':<8}{'shape':<11}{'success':>9}{'collisions':>12}{'time s':>9}")
    with tempfile.TemporaryDirectory() as arguments.folder, \
            concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for count in map(int, arguments.cylinders.split(",")):
            for speed in map(float, arguments.speeds.split(",")):
                for shape in arguments.shapes.split(","):
                    rows = list(pool.map(lambda seed: run(arguments, count, speed, shape, seed),
                                         range(1, arguments.seeds + 1)))
                    good = sum(row[0] for row in rows)
                    passed, failed = passed + good, failed + len(rows) - good
                    print(f"{count:<11}{speed:<8}{shape:<11}{f'{good}/{len(rows)}':>9}{sum(r[1] for r in rows):>12}"
                          f"{sum(r[2] for r in rows) / len(rows):>9.2f}", flush=True)
    print(f"{passed} passed, {failed} failed")
    return 0 if passed >= 9 * failed else 1


if __name__ == "__main__":
    sys.exit(main())
