# SPDX-License-Identifier: BSD-3-Clause
"""Looks for tests that fail now and then: each test program of a Meson build folder N times, with its cases in another
order each time, while every processor is busy.

Each round runs all programs once, so that a campaign that is interrupted has covered them all. Each flake is named with
the rounds in which it failed; a round's number is also the seed of the order. The last line is `N passed, M failed`: cases
run. The exit status is 1 if any failed.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import run_tests

PATIENCE = 6  # times a program's own timeout

BUSY_LOOP = """
import os
parent = os.getppid()
while os.getppid() == parent:
    for _ in range(1000000):
        pass
"""


class Load:
    """A busy loop for each processor, while it is entered."""

    def __init__(self, processes=None):
        self.count = processes or os.cpu_count() or 1
        self.loops = []

    def __enter__(self):
        self.loops = [subprocess.Popen([sys.executable, "-c", BUSY_LOOP]) for _ in range(self.count)]
        return self

    def __exit__(self, *_):
        for loop in self.loops:
            loop.kill()
            loop.wait()


def programs_of(build, names):
    """(name, function of the round that returns a Result) of each test program; with `names`, only of these."""
    described = subprocess.run(["meson", "introspect", "--tests", str(build)], check=True, capture_output=True).stdout
    reports = build / "test-reports"
    reports.mkdir(exist_ok=True)
    for test in json.loads(described):
        name, command = test["name"], test["cmd"]
        common = (test["timeout"] * PATIENCE, {**os.environ, **test["env"]}, test["workdir"])
        if names and name not in names:
            continue
        if test["protocol"] != "gtest":
            yield name, lambda _, c=command, a=common: run_tests.run_one_case(c, *a)
            continue
        report = reports / (re.sub(r"\W+", "-", name) + ".flakes.xml")
        shuffled = lambda number, c=command: [*c, "--gtest_shuffle", f"--gtest_random_seed={number}"]
        yield name, lambda number, s=shuffled, r=report, a=common: run_tests.run_googletest(s(number), r, *a)
    for name, command in run_tests.OWN_CASES.items():
        if run_tests.BUILD in command and (not names or name in names):
            words = [str(build) if word == run_tests.BUILD else word for word in command]
            yield name, lambda _, c=words: run_tests.run_one_case(c, run_tests.OWN_CASE_TIMEOUT_S * PATIENCE)


class Campaign:
    """The cases that passed, and the rounds in which each of the others failed."""

    def __init__(self):
        self.passed = 0
        self.failed_in = {}

    def run_round(self, number, rounds, programs):
        for name, run in programs:
            begin = time.monotonic()
            result = run(number)
            self.passed += result.passed
            verdict = f"{len(result.failed)} FAILED" if result.failed else "ok"
            print(f"round {number} of {rounds}: {name}: {verdict}  ({time.monotonic() - begin:.1f} s)", flush=True)
            for case in result.failed:
                self.failed_in.setdefault(f"{name}: {case}", []).append(number)
            if result.failed:
                told = run_tests.excerpt(result.output, result.failed)
                print("".join(f"    | {line}\n" for line in told.splitlines()), end="", flush=True)

    def print_result(self, rounds):
        for case, failed_in in sorted(self.failed_in.items()):
            numbers = ", ".join(map(str, failed_in))
            print(f"flaky: {case}: failed in {len(failed_in)} of {rounds} rounds: {numbers}")
        failed = sum(map(len, self.failed_in.values()))
        print(f"{self.passed} passed, {failed} failed")
        return 1 if failed or not self.passed else 0


def main():
    parser = argparse.ArgumentParser(prog="dev test --flakes", description="Looks for tests that fail now and then.")
    parser.add_argument("build", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("rounds", type=int, nargs="?", default=100, metavar="N", help="runs of each program (default: 100)")
    parser.add_argument("--programs", type=lambda names: names.split(","), metavar="NAME,...", help="only these")
    parser.add_argument("--first", type=int, default=1, metavar="N", help="number of the first round, to repeat one")
    arguments = parser.parse_args()
    programs = list(programs_of(arguments.build.resolve(), arguments.programs))
    campaign, ended = Campaign(), 0
    try:
        with Load():
            for number in range(arguments.first, arguments.first + arguments.rounds):
                campaign.run_round(number, arguments.first + arguments.rounds - 1, programs)
                ended += 1
    except KeyboardInterrupt:
        for group in list(run_tests.running_groups):
            run_tests.end_group(group)
        print(f"interrupted after {ended} rounds")
    return campaign.print_result(max(ended, 1))


if __name__ == "__main__":
    sys.exit(main())
