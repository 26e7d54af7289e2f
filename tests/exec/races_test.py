# SPDX-License-Identifier: BSD-3-Clause
"""`waitpoint explore --races`: data races beside other failures: races_test.py BUILD."""

import re
import shlex
import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT
from exploring_test import explore


class RacesBesideFailures(ExecCase):
    """A program with two harmless races in each order, and a failure in few."""

    RACE = r"data race of the write at .*benign\.cpp:(\d+) and the write at .*benign\.cpp:\1 \(\(anonymous namespace\)::(?:begun|done)\)"

    def setUp(self):
        if not (WAITPOINT.parent.parent / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        self.program = self.compile("benign.cpp", "-g", "-fsanitize=thread")

    def check_replays(self, line, words):
        again = subprocess.run(shlex.split(line), capture_output=True, text=True)
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn(f"waitpoint: failed: {words}", again.stderr)
        self.assertIn("the same run as in the record", again.stderr)

    def test_do_not_hide_them_and_are_reported_once_when_found(self):
        for jobs in ("1", "2"):
            done = explore("--jobs", jobs, "--", self.program, "abort")
            self.assertEqual(done.returncode, 1)
            lines = done.stderr.splitlines()
            self.assertEqual(len(lines), 3, done.stderr)
            for line in lines[:2]:
                self.assertRegex(line, "^waitpoint: the default order: " + self.RACE + "$")
            self.assertRegex(lines[2], r"^waitpoint: schedule \d+ of strategy portfolio, seed 1: terminated by signal 6 \(Aborted\)$")
            self.assertRegex(done.stdout, r"\d+ failed \(\d+ by a data race alone\), in ")
            self.assertRegex(done.stdout, r"schedule \d+ of .* failed at \S+ s: terminated by signal 6 \(Aborted\)\ncause: lost update: .*\n1 switch away from")
            self.assertIn("the last choice from which it could still have passed", done.stdout)
            self.assertEqual(done.stdout.count("also found, by the default order: data race at"), 2, done.stdout)
            replays = re.findall(r"^replay: (.*)$", done.stdout, re.M)
            self.assertEqual(len(replays), 3, done.stdout)
            self.check_replays(replays[0], "terminated by signal 6")
            self.check_replays(replays[1], "a data race")

    def test_alone_fail_the_whole_campaign(self):
        done = explore("--iterations", "20", "--", self.program, "harmless")
        self.assertEqual(done.returncode, 1)
        self.assertIn("benign: 20 schedules, ", done.stdout)
        self.assertIn("20 failed (20 by a data race alone)", done.stdout)
        self.assertIn("the default order failed at 0.000000000 s: a data race\n", done.stdout)
        self.assertEqual(done.stdout.count("data race at"), 2, done.stdout)
        self.assertNotIn("also found", done.stdout)

    def test_are_not_looked_at_if_they_are_to_be_ignored(self):
        done = explore("--races", "ignore", "--iterations", "20", "--", self.program, "harmless")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        done = explore("--races", "ignore", "--", self.program, "abort")
        self.assertNotIn("data race", done.stdout + done.stderr)
        self.assertIn(" --races ignore --replay ", done.stdout)
        self.check_replays(re.findall(r"^replay: (.*)$", done.stdout, re.M)[0], "terminated by signal 6")

    def test_the_first_failure_of_each_kind_is_reported_in_order_of_severity(self):
        results = self.folder / "results"
        for way, gravest, other in (("abort-or-deadlock", r"terminated by signal 6 \(Aborted\)", "deadlock"),
                                    ("crash-or-deadlock", r"terminated by signal 11 \(Segmentation fault\)", "deadlock")):
            done = explore("--iterations", "60", "--results", results, "--no-minimize", "--", self.program, way)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stdout, rf"(?s)\nschedule \d+ of [^\n]* failed at \S+ s: {gravest}\n.*\n"
                                          rf"also found, by schedule \d+ of [^\n]*: {other}\nreplay: [^\n]*\n"
                                          r"also found, by the default order: data race at ")
            self.assertEqual(len(done.stderr.splitlines()), 4, done.stderr)
            self.assertEqual(len(results.read_text().splitlines()), 61)

    def test_are_reported_before_the_end(self):
        results = self.folder / "endless"
        command = [str(word) for word in (WAITPOINT, "explore", "--iterations", "1000000", "--results", results, "--",
                                          self.program, "abort")]
        search = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        lines = [search.stderr.readline() for _ in range(3)]
        self.assertIsNone(search.poll())
        search.kill()
        search.wait()
        search.stderr.close()
        self.assertEqual([line.count("data race") for line in lines], [1, 1, 0], lines)


if __name__ == "__main__":
    unittest.main()
