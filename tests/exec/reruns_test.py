# SPDX-License-Identifier: BSD-3-Clause
"""Schedules of `waitpoint explore -- PROGRAM` that one process runs one after the other: reruns_test.py BUILD."""

import ctypes
import os
import resource
import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT

PR_SET_CHILD_SUBREAPER = 36


class Reruns(ExecCase):
    switch_at = "calls"

    def explore(self, schedules, *words):
        """The file of results, of all schedules with their digests and outcomes."""
        results, given = self.folder / "results", self.folder / "given"
        given.write_text("first\nsecond\n")
        command = [WAITPOINT, "explore", "--switch-at", self.switch_at, "--iterations", schedules, "--results", results, *words]
        with given.open() as stdin:
            done = subprocess.run([str(word) for word in command], stdin=stdin, capture_output=True, text=True, timeout=250)
        self.assertIn(f"{schedules} schedules, ", done.stdout, done.stderr)
        return results.read_text()

    def compare(self, schedules, *words):
        """Returns the results, which must be those of processes that run one schedule each."""
        found = self.explore(schedules, "--", *words)
        self.assertEqual(found, self.explore(schedules, "--fork-each", "--", *words))
        return found

    def test_all_state_of_the_process_is_put_back(self):
        self.assertNotIn("failed", self.compare(1000, self.compile("reruns.c", "-lm")))

    def test_irreversible_calls_prevent_reruns(self):
        program = self.compile("reruns.c", "-lm")
        for what in ("fork", "spawn", "limit"):
            self.assertNotIn("failed", self.compare(40, program, what))

    def test_descriptors_are_closed(self):
        program = self.compile("reruns.c", "-lm")
        for what in ("pipe", "file"):
            self.assertNotIn("failed", self.compare(100, program, what))

    def test_failures_are_those_of_processes_of_their_own(self):
        program = self.compile("reruns.c", "-lm")
        for what, words in (("exit", "exit status 3"), ("abort", "signal 6"), ("crash", "signal 11")):
            found = self.compare(100, program, what)
            self.assertIn(words, found)
            self.assertIn("passed", found)

    def test_other_programs(self):
        for name, schedules, *options in (("lost_update.c", 1000), ("meetings.cpp", 300, "-std=c++20"), ("until.c", 300),
                                          ("two_processes.c", 50)):
            self.compare(schedules, self.compile(name, *options))

    def test_breakpoints_at_accesses_are_taken_away(self):
        self.switch_at = "accesses"
        for name, schedules, *options in (("reruns.c", 300, "-lm"), ("lost_update.c", 500), ("meetings.cpp", 200, "-std=c++20")):
            self.compare(schedules, self.compile(name, *options))

    def test_programs_with_data_races(self):
        for name in ("benign.cpp", "racing.cpp"):
            found = self.compare(200, self.compile(name, "-g", "-fsanitize=thread"))
            self.assertIn("failed: a data race", found)

    def test_most_schedules_are_not_forked(self):
        def faults_per_schedule(*options):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt
            self.explore(1000, *options, "--", program, "locked")
            try:
                while True:
                    os.wait()
            except ChildProcessError:
                pass
            return (resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt - before) / 1000

        program = self.compile("lost_update.c")
        # The processes that run schedules are waited for here.
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        for self.switch_at in ("calls", "accesses"):
            self.assertLess(2 * faults_per_schedule(), faults_per_schedule("--fork-each"), self.switch_at)
            # Its memory is there from the first one on.
            self.assertLess(faults_per_schedule("--strategy", "random"), 12, self.switch_at)


if __name__ == "__main__":
    unittest.main()
