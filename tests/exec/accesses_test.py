# SPDX-License-Identifier: BSD-3-Clause
"""Accesses to memory as switch points of programs as they are, found by breakpoints: accesses_test.py BUILD."""

import re
import subprocess
import unittest

from exec_case import BUILD, ExecCase, WAITPOINT, explore, replay_words


class Accesses(ExecCase):
    def setUp(self):
        help_text = subprocess.run([WAITPOINT, "explore", "--switch-at", "accesses", "--iterations", "1", "--", "true"],
                                   capture_output=True, text=True).stderr
        if "Zydis" in help_text or not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no disassembler")
        self.program = self.compile("accesses.c", "-w")

    def passes(self, case, *options, schedules="60"):
        """The first line of the report."""
        done = explore("--iterations", schedules, *options, "--", self.program, case)
        self.assertEqual(done.returncode, 0, f"{case} {options}: {done.stdout}{done.stderr}")
        return done.stdout.splitlines()[0]

    def test_disturb_no_correct_program(self):
        for case in ("signals", "faults", "own stacks", "contexts", "spin lock", "bits"):
            for options in ((), ("--switch-at", "accesses")):
                self.assertNotIn("switches at calls only", self.passes(case, *options), case)

    def test_are_left_out_where_they_would_disturb(self):
        for case, why in (("traps", "the program handles SIGTRAP"), ("sum of code", "the program accesses its own code"),
                          ("changed code", "the program's code is changed")):
            for options in ((), ("--switch-at", "accesses")):
                self.assertTrue(self.passes(case, *options).endswith("; switches at calls only: " + why), (case, options))

    def test_find_by_default_failures_without_a_switch_at_a_call(self):
        for case in ("update", "copies", "padding"):
            self.assertNotIn("failed at", self.passes(case, "--switch-at", "calls", schedules="200"))
            done = explore("--iterations", "500", "--", self.program, case)
            self.assertEqual(done.returncode, 1, f"{case}: {done.stdout}{done.stderr}")
            self.assertGreaterEqual(int(re.search(r"^schedule (\d+) of strategy portfolio", done.stdout, re.M)[1]), 20)
            words = replay_words(done.stdout)
            self.assertIn("accesses", words)
            self.assertIn("the same run as in the record", explore(*words).stderr, case)
            raw = explore("--iterations", "500", "--no-minimize", "--", self.program, case)
            self.assertIn("the same run as in the record", explore(*replay_words(raw.stdout)).stderr, case)

    def test_are_switch_points_of_all_schedules_if_a_thread_waits_in_a_loop_without_a_call(self):
        self.assertRegex(self.passes("turns", "--schedule-limit", "2"), r"60 schedules, \d+ distinct, 0 failed")

    def test_take_turns_with_calls_in_each_kind_of_process(self):
        results, lines = self.folder / "results", {}
        for options in ((), ("--jobs", "2"), ("--fork-each",)):
            self.passes("signals", "--results", results, *options)
            lines[options] = results.read_text()
        self.assertEqual(len(set(lines.values())), 1)
        at = {}
        for which in ("calls", "accesses"):
            self.passes("signals", "--switch-at", which, "--results", results)
            at[which] = results.read_text().splitlines()[1:]
        mixed = lines[()].splitlines()[1:]
        self.assertEqual(mixed[:20] + mixed[30:40] + mixed[50:], at["calls"][:20] + at["calls"][30:40] + at["calls"][50:])
        self.assertEqual(mixed[20:30] + mixed[40:50], at["accesses"][20:30] + at["accesses"][40:50])

    def test_exhaustive_strategies_say_that_they_switch_at_calls(self):
        self.assertRegex(self.passes("signals", "--strategy", "bounded:0", "--observe", "0", schedules="1000"),
                         "; exhaustive with at most 0 preemptions, switching at calls")


if __name__ == "__main__":
    unittest.main()
