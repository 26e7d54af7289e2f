# SPDX-License-Identifier: BSD-3-Clause
"""Schedules of `waitpoint explore --snapshots N`, which begin in the middle of others: snapshots_test.py BUILD
[--long]."""

import ctypes
import os
import resource
import re
import subprocess
import sys
import unittest

from exec_case import ExecCase, WAITPOINT, explore

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
SCHEDULES = 30 if LONG else 10
PR_SET_CHILD_SUBREAPER = 36


class Snapshots(ExecCase):
    def setUp(self):
        super().setUp()
        self.program = self.compile("snapshots.c")

    def results_of(self, *words):
        """Output, and the file of results, of all schedules with their digests and outcomes."""
        results, given = self.folder / "results", self.folder / "given"
        given.write_text("first\nsecond\n")
        command = [WAITPOINT, "explore", "--results", results, *words]
        with given.open() as stdin:
            done = subprocess.run([str(word) for word in command], stdin=stdin, capture_output=True, text=True, timeout=250)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.stdout, results.read_text()

    def compare(self, *words, snapshots=4):
        """Returns the results, which must be those of runs from the beginning."""
        plain, found = self.results_of(*words)
        output, again = self.results_of("--snapshots", snapshots, *words)
        self.assertEqual(again, found)
        self.assertEqual(output.split(", in ")[0], plain.split(", in ")[0])
        return found

    def test_exhaustive_searches(self):
        for strategy, snapshots in (("dfs", 1), ("dfs", 4), ("bounded:1", 4)):
            self.assertNotIn("failed", self.compare("--strategy", strategy, "--iterations", SCHEDULES, "--", self.program,
                                                   snapshots=snapshots))

    def test_random_schedules_share_their_beginning(self):
        self.compare("--strategy", "random", "--iterations", SCHEDULES, "--jobs", 2, "--", self.program)

    def test_restores_open_files_and_input(self):
        for what in ("read", "write", "pipe", "input"):
            found = self.compare("--strategy", "dfs", "--iterations", 8 if LONG else 4, "--", self.program, what, self.folder / "written")
            self.assertNotIn("failed", found, what)

    def test_failures_are_the_same(self):
        self.assertIn("failed", self.compare("--strategy", "random", "--iterations", 20, "--", self.program, "fail"))

        def report(*options):
            done = explore("--strategy", "random", *options, "--", self.program, "fail")
            return [line for line in done.stdout.splitlines() if " a second)" not in line]

        plain = report()
        self.assertIn("  has begun", plain)
        self.assertEqual(report("--snapshots", "10"), plain)

    def test_most_schedules_do_not_begin_at_main(self):
        def faults(*options):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt
            self.results_of("--strategy", "dfs", "--iterations", SCHEDULES, "--fork-each", *options, "--", self.program)
            try:
                while True:
                    os.wait()
            except ChildProcessError:
                pass
            return resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt - before

        # The processes that run schedules are waited for here.
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        self.assertLess(3 * faults("--snapshots", 4), faults())

    @unittest.skipUnless(LONG, "takes half a minute")
    def test_the_enumeration_after_draws_is_the_same(self):
        def line(*options):
            done = explore("--strategy", "random", "--iterations", "1000", *options, "--", self.program, "once")
            return re.sub(r"in \d+\.\d s \(.*? a second\)", "", done.stdout)

        plain = line()
        self.assertIn("; exhausted, ", plain)
        self.assertEqual(line("--snapshots", "4"), plain)

    def test_bad_input(self):
        for number in ("-1", "1001", "many"):
            done = explore("--snapshots", number, "--", self.program)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn("--snapshots: expected a whole number from 0 to 1000", done.stderr)


if __name__ == "__main__":
    unittest.main()
