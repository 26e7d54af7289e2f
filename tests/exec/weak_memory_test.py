# SPDX-License-Identifier: BSD-3-Clause
"""`waitpoint explore --memory`: older values of atomic loads: weak_memory_test.py BUILD."""

import re
import shlex
import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT
from exploring_test import explore


class WeakMemory(ExecCase):
    def setUp(self):
        if not (WAITPOINT.parent.parent / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        self.program = self.compile("weak_memory.cpp", "-g", "-fsanitize=thread")

    def passes(self, *words):
        done = explore(*words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_is_off_by_default(self):
        self.passes("--iterations", "100", "--", self.program, "buffer")

    def test_shows_older_values_and_where_they_were_stored(self):
        done = explore("--memory", "weak", "--", self.program, "buffer")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"failed at \S+ s: terminated by signal 6 \(Aborted\)\n1 switch away from")
        self.assertRegex(done.stdout, r"switches away from the default order:\n[^\n]* thread 2#2 of weak_memory \(load memory #\d+[^\n]*\) "
                                      r"reads an older value, as C\+\+ allows for relaxed: 0, the one before the first atomic store\n")
        line = re.findall(r"^replay: (.*)$", done.stdout, re.M)[-1]
        self.assertRegex(line, r" --memory weak --replay wx1\.0w\.")
        again = subprocess.run(shlex.split(line), capture_output=True, text=True)
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn("waitpoint: failed: terminated by signal 6", again.stderr)
        self.assertIn("the same run as in the record", again.stderr)

    def test_is_replayed_from_a_file(self):
        schedule = self.folder / "weak.schedule"
        done = explore("--memory", "weak", "--schedule", schedule, "--", self.program, "buffer")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(schedule.read_text(), r"\nvalue [0-9a-f]{16} \d+ 1\n")
        again = explore("--memory", "weak", "--replay", schedule, "--", self.program, "buffer")
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertIn("the same run as in the record", again.stderr)
        other = explore("--replay", schedule, "--", self.program, "buffer")
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertIn("expected a schedule of this program", other.stderr)

    def test_all_schedules_with_release_and_acquire_pass(self):
        self.assertIn("; exhaustive", self.passes("--memory", "weak", "--strategy", "dfs", "--iterations", "20000", "--", self.program, "pass"))

    def test_the_c_library_and_the_system_order_accesses(self):
        for way in ("mutex", "futex", "barrier"):
            self.passes("--memory", "weak", "--iterations", "300", "--", self.program, way)

    def test_a_loop_that_reads_older_values_ends(self):
        self.passes("--memory", "weak", "--iterations", "100", "--", self.program, "wait")

    def test_bad_input_is_one_line(self):
        plain = self.compile("lost_update.c")
        for words, line in ((("--memory", "weak", "--", plain), "expected a program compiled with -fsanitize=thread, found 'lost_update'"),
                            (("--memory", "strong", "--", self.program), "--memory: expected sc or weak, found 'strong'")):
            done = explore(*words)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(line, done.stderr)


if __name__ == "__main__":
    unittest.main()
