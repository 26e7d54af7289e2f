# SPDX-License-Identifier: BSD-3-Clause
"""The cause in the report of a failure: causes_test.py BUILD."""

import re
import shutil
import unittest

from exec_case import ExecCase, explore

# gdb reads the types of variables.
BALANCE = r"account\.balance" if shutil.which("gdb") else r"account\+8"
LEFT, CHANGE = 'mutex #\\d+ "left"', 'condition variable #\\d+ "change"'
CROSSED = (
    'locks are taken in opposite orders: thread 1 holds mutex #\\d+ "left" and waits for mutex #\\d+ "right", '
    'thread 2 holds mutex #\\d+ "right" and waits for mutex #\\d+ "left"'
)
CAUSES = {
    "crossed locks": CROSSED,
    "lost wake-up": f"lost wake-up: notify_one of thread 2 comes before thread 1 waits for {CHANGE}, and no notification comes after it",
    "missed notification": f"missed notification: thread [12] waits for {CHANGE}, but the only notification since then, "
    "notify_one of thread [34], wakes thread [12]",
    "lost update": f'lost update: thread [12] writes memory #\\d+ "{BALANCE}" between the read and the write of thread [12]',
    "two sections": f"thread [12] locks {LEFT} between two critical sections of thread [12]",
}
MISUSES = {
    "destruction": "misuse: thread 1 locks mutex left, which was destroyed",
    "release": "misuse: main unlocks mutex left, which is not locked",
}
SEEDS = ("1", "2", "3")


class Causes(ExecCase):
    """One program with frequent mistakes: the sentence is that of the mistake, for each seed."""

    def setUp(self):
        self.program = self.compile("causes.c", "-g", "-pthread")

    def reports(self, mistake, *options):
        for seed in SEEDS:
            done = explore("--seed", seed, *options, "--", self.program, mistake)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            yield done.stdout

    def test_are_those_of_the_mistakes(self):
        for mistake, cause in CAUSES.items():
            for report in self.reports(mistake):
                self.assertEqual(len(re.findall(f"^cause: {cause}$", report, re.M)), 1, mistake + "\n" + report)

    def test_a_read_before_the_first_write(self):
        for report in self.reports("initialisation", "--switch-at", "accesses"):
            self.assertRegex(report, r"\ncause: thread 2 reads memory #\d+.* before thread 1 writes it first\n")

    def test_misuses_are_the_headline(self):
        for mistake, words in MISUSES.items():
            for report in self.reports(mistake, "--iterations", "50"):
                self.assertIn(words, report)
                self.assertNotIn("\ncause: ", report)


class Stacks(ExecCase):
    """Call stacks have the program's frames."""

    def test_both_accesses_are_shown_with_variable_and_line(self):
        done = explore("--", self.compile("causes.c", "-g", "-pthread"), "lost update")
        accesses = re.findall(rf'about to (?:load|store) memory #\d+ "{BALANCE}"\n      at deposit at .*causes\.c:\d+\n', done.stdout)
        self.assertEqual(len(accesses), 2, done.stdout)

    def check_pair(self, mistake, first, other):
        done = explore("--", self.compile("causes.c", "-g", "-pthread"), mistake)
        self.assertRegex(done.stdout, rf"first in the failing run: .*, about to {first}\n      at .*\n  first in a passing run: .*, about to {other}\n")

    def test_an_event_that_the_passing_run_ends_without_is_one_of_the_pair(self):
        self.check_pair("unjoined", r'release semaphore #\d+ "units"', r'load semaphore #\d+ "units"')

    def test_calls_that_are_made_once_are_a_pair(self):
        self.check_pair("once", r'call_once word #\d+ "once"', r'call_once word #\d+ "once"')

    def test_two_fields_of_one_word_are_both_named(self):
        done = explore("--switch-at", "accesses", "--", self.compile("causes.c", "-g", "-pthread"), "neighbours")
        fields = r"pair\.first, pair\.second" if shutil.which("gdb") else r"pair, pair\+4"
        self.assertRegex(done.stdout, rf' memory #\d+ "{fields}"')

    def test_a_crash_begins_in_the_program(self):
        done = explore("--", self.compile("causes.c", "-g", "-pthread"), "two sections")
        self.assertRegex(done.stdout, r"main is terminated by signal 6\n      at main at .*causes\.c:\d+\n(?!      at)")

    def test_threads_are_created_and_finish(self):
        done = explore("--", self.compile("causes.c", "-g", "-pthread"), "two sections")
        self.assertRegex(done.stdout, r" main#0 of causes +create\n")
        self.assertRegex(done.stdout, r" thread 1#1 of causes +finish thread #\d+\n")


if __name__ == "__main__":
    unittest.main()
