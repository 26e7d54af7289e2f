# SPDX-License-Identifier: BSD-3-Clause
"""The planted bugs of tests/exec/zoo under `waitpoint explore -- PROGRAM`: zoo_test.py BUILD [--long].

The default strategy must find each bug and report no mended twin: in the plain programs, the bugs that show by switches at
calls; in the programs instrumented at memory accesses, all of them except the rare ones. With --long: for 20 seeds, with more schedules of the
twins, and the table of docs/zoo.md at the end.
"""

import concurrent.futures
import dataclasses
import functools
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import unittest

from exec_case import BUILD, ExecCase, WAITPOINT

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
SEEDS = range(1, 21) if LONG else (1,)
SCHEDULES_MAX = 10_000
SCHEDULES_OF_A_TWIN = 2_000 if LONG else 100
JOBS = 2
PROGRAMS = [BUILD / "tests/exec/zoo" / name for name in ("zoo-pthreads", "zoo-threads")]
INSTRUMENTED = "-instrumented"


@dataclasses.dataclass(frozen=True)
class Specimen:
    program: pathlib.Path
    needs: str
    name: str
    switch_at: str = "calls"


@functools.cache
def specimens(suffix):
    """The specimens listed by the programs with this suffix."""
    found = []
    for program in PROGRAMS:
        lines = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
        found += [Specimen(program.with_name(program.name + suffix), *line.split(" ", 1)) for line in lines]
    return found


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True)


def explore(specimen, mended=False, seed=1, schedules=SCHEDULES_MAX, strategy="portfolio"):
    twin = ["mended"] if mended else []
    return run(WAITPOINT, "explore", "--seed", seed, "--strategy", strategy, "--iterations", schedules,
               "--races", "fail", "--switch-at", specimen.switch_at, "--no-minimize", "--", specimen.program, specimen.name, *twin)


def schedules_until_found(specimen, seed):
    """None if it is not found; 0 for the default order."""
    done = explore(specimen, seed=seed)
    number = re.search(rf"^(?:schedule (\d+) of strategy portfolio, seed {seed},|the default order) failed", done.stdout, re.M)
    if done.returncode != (1 if number else 0):
        raise AssertionError(f"{specimen.name}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return int(number[1] or -1) + 1 if number else None


def for_each(function, arguments):
    """Pairs of an argument and the function's result."""
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        return list(zip(arguments, pool.map(lambda each: function(*each), arguments)))


class Programs:
    """Tests for either build of the programs."""

    found = {}  # by suffix and name: for each seed the number of schedules needed

    def check_passes(self, runs):
        for (specimen, mended, *_), done in for_each(explore, runs):
            with self.subTest(specimen.name, mended=mended):
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_each_is_found(self):
        runs = [(specimen, seed) for specimen in self.wanted() for seed in SEEDS]
        for (specimen, seed), schedules in for_each(schedules_until_found, runs):
            self.found.setdefault((self.suffix, specimen.name), []).append(schedules)
            with self.subTest(specimen.name, seed=seed):
                self.assertIsNotNone(schedules, f"not within {SCHEDULES_MAX} schedules")

    def test_no_mended_twin_is_reported(self):
        self.check_passes([(specimen, True, 1, SCHEDULES_OF_A_TWIN) for specimen in self.wanted()])

    def test_the_replay_line_repeats_the_failure(self):
        for name, words in self.replayed.items():
            specimen = next(each for each in self.wanted() if each.name == name)
            replay = re.findall(r"^replay: (.*)$", explore(specimen).stdout, re.M)[-1]
            done = run(*shlex.split(replay))
            self.assertEqual(done.returncode, 1, replay)
            self.assertIn(words, done.stderr)
            self.assertIn("the same run as in the record", done.stderr)


class AsTheyAre(Programs, ExecCase):
    suffix = ""
    replayed = {"crossing of 3": "deadlock", "late subscriber": "no message at all is received"}

    def wanted(self):
        return [specimen for specimen in specimens(self.suffix) if specimen.needs == "synchronization"]

    def test_each_passes_in_the_default_order(self):
        self.check_passes([(specimen, mended, 1, 1, "fifo") for specimen in specimens("") for mended in (False, True)])


# The bugs that need a switch at an access, in the programs as they are: by breakpoints.
class AtBreakpoints(Programs, ExecCase):
    suffix = ""
    replayed = {"lost update": "exit status 1", "freed in use": "exit status 1"}

    def wanted(self):
        # Of a hundred writers each access is two switch points here: it takes more schedules than this test has time for.
        return [dataclasses.replace(one, switch_at="accesses") for one in specimens(self.suffix)
                if one.needs == "memory" and one.name != "reorder of 100"]


# Data races end the search here: even the default order shows them, where they do no harm.
class Instrumented(Programs, ExecCase):
    suffix = INSTRUMENTED
    replayed = {"crossing of 3": "deadlock", "work stealing": "a job is done twice"}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if not (BUILD / "libwaitpoint-exec-races.so").exists() or not specimens(cls.suffix)[0].program.exists():
            raise unittest.SkipTest("this build has no programs whose accesses to memory are seen")

    def wanted(self):
        return [specimen for specimen in specimens(self.suffix) if specimen.needs != "rare"]


def cell(schedules):
    """The median, and the number of successful seeds unless all were; a failed seed counts as more than the maximum."""
    median = statistics.median_high([SCHEDULES_MAX + 1 if each is None else each for each in schedules])
    count = sum(each is not None for each in schedules)
    return ("-" if median > SCHEDULES_MAX else str(median)) + ("" if count == len(schedules) else f" ({count})")


def print_table():
    columns = {"": "as it is", INSTRUMENTED: "instrumented"}
    columns = {suffix: head for suffix, head in columns.items() if any(key[0] == suffix for key in Programs.found)}
    rows = [["program", "specimen", "needs", *columns.values()]]
    for specimen in specimens(""):
        found = [Programs.found.get((suffix, specimen.name)) for suffix in columns]
        rows.append([specimen.program.name, specimen.name, specimen.needs, *(cell(each) if each else "" for each in found)])
    lines = [f"| {' | '.join(row)} |" for row in rows]
    print("\n".join([lines[0], "|---" * len(rows[0]) + "|", *lines[1:]]))


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if LONG:
        print_table()
    sys.exit(not result.wasSuccessful())
