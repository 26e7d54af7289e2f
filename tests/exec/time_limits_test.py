# SPDX-License-Identifier: BSD-3-Clause
"""The time limit of `waitpoint explore`: time_limits_test.py BUILD.

It holds for the whole search: the default order, its repetition at accesses, schedules, minimisation and explanation.
"""

import json
import time
import unittest

from exec_case import ExecCase, explore


class TimeLimit(ExecCase):
    """Searches of programs whose runs take long, or do not end."""

    LATE_S = 2  # beyond the limit: one second, and the processors are shared

    def search(self, limit_s, way, *options):
        start_s = time.monotonic()
        done = explore("--time-limit", limit_s, *options, "--", self.compile("long_runs.c"), way)
        self.assertLess(time.monotonic() - start_s, limit_s + self.LATE_S, done.stdout + done.stderr)
        return done

    def test_schedules_are_run_of_a_loop_that_waits_for_another_thread(self):
        done = self.search(8, "flag")
        if done.returncode == 3:  # a build without a disassembler, or a slow machine
            self.assertIn("--time-limit: not even the default order has ended within 8 s", done.stderr)
        else:
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout, r": [1-9]\d* schedules?, ")

    def test_a_search_that_ran_nothing_has_a_status_and_a_reason_of_its_own(self):
        done = self.search(5, "endless")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("stopped at the time limit at 0.000000000 s of virtual time", done.stderr)
        self.assertIn("waitpoint: --time-limit: not even the default order has ended within 5 s", done.stderr)

    def test_a_search_cut_off_in_its_first_schedule_has_that_status(self):
        done = self.search(2, "second", "--json")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("waitpoint: --time-limit: no schedule but the default order has ended within 2 s", done.stderr)
        self.assertEqual(json.loads(done.stdout)["result"]["outcome"], "nothing run")

    def test_a_failure_is_reported_in_time(self):
        done = self.search(4, "failing")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("exit status 9", done.stdout)
        self.assertRegex(done.stdout, r"\nreplay: .* --replay ")


if __name__ == "__main__":
    unittest.main(verbosity=2)
