# SPDX-License-Identifier: BSD-3-Clause
"""Endurance: scenarios/office-20.yaml for hours of virtual time, twice, side by side.

The two runs differ in the engine of the world, which must not matter. No goal may be lost, no robot may collide or stop
reaching goals, the digests must be equal, and memory must not grow after the first hour (in a shorter run: after its
first half). Called by `./dev test --endurance`."""

import argparse
import contextlib
import dataclasses
import json
import pathlib
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "scenarios/office-20.yaml"
ENGINES = ("fcl", "slice")
GROWTH_MB_MAX = 4
GOAL_INTERVAL_S_MAX = 300
SAMPLING_S = 60


@dataclasses.dataclass
class Run:
    """One run: resident memory by the virtual time in seconds, and in the end its summary and exit status."""

    engine: str
    memory_mb: dict = dataclasses.field(default_factory=dict)
    summary: dict = None
    status: int = None
    errors: list = dataclasses.field(default_factory=list)


def hours(text):
    try:
        value = float(text)
    except ValueError:
        value = 0
    if not SAMPLING_S * 2 / 3600 <= value <= 10000:
        raise argparse.ArgumentTypeError(f"expected a number of hours from {SAMPLING_S * 2 / 3600:.3f} to 10000, found '{text}'")
    return value


def resident_mb(process):
    with contextlib.suppress(OSError):
        for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1]) / 1024
    return None


def carry_out(build, until_s, run, folder, report):
    """Runs to the end. The program's progress lines, "60 s of 3600 s", give the virtual times."""
    summary = folder / f"{run.engine}.json"
    command = [build / "tools/waitpoint", "run", SCENARIO, "--until", str(until_s), "--set", f"world.engine={run.engine}"]
    process = subprocess.Popen(
        [*map(str, command), "--summary", str(summary)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    for line in process.stderr:
        words = line.split()
        if words[1:3] != ["s", "of"]:
            run.errors.append(line.rstrip())
            continue
        memory = resident_mb(process)
        if memory is not None:
            run.memory_mb[int(words[0])] = memory
        report()
    run.status = process.wait()
    if summary.exists():
        run.summary = json.loads(summary.read_text())


def lost_goals(run):
    for robot in run.summary["robots"]:
        for number, goal in enumerate(robot["goal_reports"], 1):
            if goal["times_reached"] < goal["visits"]:
                yield (
                    f"{robot['name']} lost goal {number} {goal['visits'] - goal['times_reached']} of {goal['visits']} times, "
                    f"last at {goal['time_s']:.0f} s: {goal['report']}"
                )


def resting_robots(run, until_s):
    for robot in run.summary["robots"]:
        last_s = max((goal.get("time_s", 0) for goal in robot["goal_reports"]), default=0)
        if until_s - last_s > GOAL_INTERVAL_S_MAX:
            yield f"{robot['name']} reached no goal after {last_s:.0f} s"


def growth_mb(run, until_s):
    """Greatest memory after the first hour, or half of a shorter run, less the memory then."""
    settled_s = min(3600, until_s / 2)
    first = next(time_s for time_s in sorted(run.memory_mb) if time_s >= settled_s)
    return max(memory for time_s, memory in run.memory_mb.items() if time_s >= first) - run.memory_mb[first]


def violations(runs, until_s):
    for run in runs:
        if run.summary is None or not run.memory_mb:
            yield f"{run.engine}: no result, exit status {run.status}: {' '.join(run.errors[-3:])}"
            continue
        if run.status != 0:
            yield f"{run.engine}: exit status {run.status}: {' '.join(run.errors[-3:])}"
        for line in (*lost_goals(run), *resting_robots(run, until_s)):
            yield f"{run.engine}: {line}"
        if run.summary["collisions"]:
            yield f"{run.engine}: {run.summary['collisions']} collisions"
        if growth_mb(run, until_s) > GROWTH_MB_MAX:
            yield f"{run.engine}: memory grew by {growth_mb(run, until_s):.1f} MB, expected at most {GROWTH_MB_MAX} MB"
    digests = {run.summary["digest"] for run in runs if run.summary}
    if len(digests) > 1:
        yield f"the digests differ: {', '.join(sorted(digests))}"


class Table:
    """A line for each hour of virtual time that both runs have reached; in runs of less than four hours more often."""

    def __init__(self, runs, until_s):
        self.runs, self.step_s, self.next_s = runs, 3600 if until_s >= 4 * 3600 else SAMPLING_S, SAMPLING_S
        self.begin, self.lock = time.monotonic(), threading.Lock()
        print("virtual time   " + "   ".join(f"{run.engine:>8}" for run in runs) + "   real time")

    def report(self):
        with self.lock:
            while all(self.next_s in run.memory_mb for run in self.runs):
                cells = "   ".join(f"{run.memory_mb[self.next_s]:5.1f} MB" for run in self.runs)
                print(f"{self.next_s:10} s   {cells}   {time.monotonic() - self.begin:7.0f} s", flush=True)
                self.next_s += self.step_s if self.next_s % self.step_s == 0 else self.step_s - self.next_s


def main():
    parser = argparse.ArgumentParser(prog="dev test --endurance")
    parser.add_argument("build", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("hours", type=hours, nargs="?", default=24, metavar="HOURS", help="of virtual time (default: 24)")
    arguments = parser.parse_args()
    until_s = round(arguments.hours * 3600)

    runs = [Run(engine) for engine in ENGINES]
    table = Table(runs, until_s)
    with tempfile.TemporaryDirectory() as folder:
        threads = [
            threading.Thread(target=carry_out, args=(arguments.build, until_s, run, pathlib.Path(folder), table.report))
            for run in runs
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    for run in runs:
        if run.summary:
            s = run.summary
            print(
                f"{run.engine}: {s['goals_reached']} of {s['goals']} goals, {s['collisions']} collisions, "
                f"position error at most {s['position_error_max_m']:.3f} m, {s['real_time_factor']:.1f} times real time, "
                f"{s['digest']}"
            )
    failures = list(violations(runs, until_s))
    for line in failures:
        print(f"failed: {line}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
