# SPDX-License-Identifier: BSD-3-Clause
"""`waitpoint explore -- PROGRAM` of programs of several processes: exploring_processes_test.py BUILD."""

import json
import unittest

from exec_case import ExecCase, explore, replay_words


class Processes(ExecCase):
    def test_the_order_of_processes_is_explored(self):
        program = self.compile("two_processes.c")
        for strategy in ("random", "bounded:1", "dfs", "portfolio"):
            done = explore("--strategy", strategy, "--", program)
            self.assertEqual(done.returncode, 1, strategy)
            self.assertIn("1 switch away from the default order fails", done.stdout, strategy)
            self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr, strategy)
        done = explore("--strategy", "dfs", "--", program, "locked")
        self.assertEqual(done.returncode, 0)
        self.assertIn("; exhaustive, switching at calls, ", done.stdout.splitlines()[0])

    def test_nothing_is_claimed_of_native_children(self):
        done = explore("--strategy", "dfs", "--children", "native", "--", "sh", "-c", "/bin/true; /bin/true")
        self.assertNotIn("exhaustive", done.stdout)
        self.assertIn("perhaps not all orders: the program has waited for what is not simulated\n", done.stdout)

    def test_events_and_switches_of_all_processes_are_reported(self):
        trace = self.folder / "trace.json"
        done = explore("--strategy", "dfs", "--trace", trace, "--", self.compile("two_processes.c"))
        self.assertRegex(done.stdout, r"process two_processes(#1001)? goes first instead of process two_processes(#1001)?\n")
        for thread in ("main#0 of two_processes", "main#0 of two_processes#1001"):
            self.assertRegex(done.stdout, rf"\n  0\.\d+ [* ] {thread} .*semaphore")
        self.assertRegex(done.stdout, r"\n  0\.\d+ \* main#0 of two_processes")
        rows = {event["pid"] for event in json.loads(trace.read_text())["traceEvents"]}
        self.assertEqual(rows, {1000, 1001})

    def test_locks_held_by_other_threads_at_a_fork_stay_locked_in_the_child(self):
        program = self.compile("held_at_fork.c")
        done = explore("--iterations", "50", "--", program, "try")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = explore("--", program, "lock")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("a thread that has ended", done.stdout)

    def test_siblings_begin_in_any_order(self):
        file = self.folder / "written by a sibling"
        for strategy in ("bounded:1", "random"):
            done = explore("--strategy", strategy, "--", "sh", "-c", f"rm -f '{file}'; (echo a > '{file}') & cat '{file}'")
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("No such file or directory", done.stdout)

    def test_programs_that_a_shell_starts_are_explored(self):
        program = self.compile("two_processes.c")
        done = explore("--iterations", "100", "--", "sh", "-c", f"{program} locked & {program}; wait")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = explore("--iterations", "200", "--", "sh", "-c", f"{program} locked & {program}")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr)

    def session(self, how):
        """A session of three programs, the last two of which start when the first has ended."""
        program = self.compile("small_session.c")
        return (f"init={program}", "init", "::", "after:init", f"base={program}", "serve", how, "::", "after:init",
                f"client={program}", "ask", how)

    def test_all_orders_of_a_session_of_init_server_and_client(self):
        done = explore("--strategy", "dfs", "--", self.compile("small_session.c"), "all")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"^small_session: \d\d\d schedules, [4-9] distinct, 0 failed, .*; exhaustive, switching at calls, if threads share memory ")

    def test_planted_bugs_of_a_session_are_found_and_replayed(self):
        schedule = self.folder / "of-session"
        for how in "hasty", "torn":
            for strategy in "portfolio", "bounded:1":
                session = self.session(how)
                done = explore("--strategy", strategy, "--schedule", schedule, "--", *session)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stdout, r"\n  waitpoint: exit status: base 0, client 1, init 0\n[1-4] switch\w* away from "
                                              r"the default order fails?, of \d+ that were found")
                self.assertRegex(done.stdout, r"\n  0\.\d+ s  process \S+ goes first instead of process \S+\n")
                for words in (replay_words(done.stdout), ("--replay", schedule, "--", *session)):
                    self.assertIn("the same run as in the record", explore(*words).stderr)
        done = explore("--iterations", "50", "--", *self.session("updates"))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_processes_left_behind_take_part_up_to_their_end(self):
        program = self.compile("small_session.c")
        reports = {explore("--", program, "all", "torn").stdout.split("\n", 1)[1] for _ in range(5)}
        self.assertEqual(len(reports), 1)
        done = explore("--", "sh", "-c", "(sleep 4; sleep 100) & exit 1")
        self.assertRegex(done.stdout, r"\n  4\.00000000\d +main#0 of sh#1001")
        self.assertNotRegex(done.stdout, r"\n  1\d+\.00000000\d ")

    def test_processes_that_poll_let_others_go_first(self):
        program = self.compile("polling.c")
        for words in ("0", "0"), ("1", "0"):
            done = explore("--strategy", "dfs", "--", program, *words)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn("; exhaustive, switching at calls, except turns of spinning tasks, ", done.stdout.splitlines()[0])
        for strategy in "fifo", "random":
            for wait_us in "0", "2000":
                done = explore("--strategy", strategy, "--iterations", "10", "--", program, "3", wait_us)
                self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
