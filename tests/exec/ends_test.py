# SPDX-License-Identifier: BSD-3-Clause
"""Ends of explored programs: exits, crashes, deadlocks, hangs: ends_test.py BUILD."""

import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT, explore, replay_words


class Failures(ExecCase):
    def test_has_the_end_of_a_run_and_the_last_calls_of_its_threads(self):
        program = self.compile("ends.c", "-rdynamic")
        for way, expected in (("exit", "exit status 3"), ("_exit", "exit status 4"), ("crash", "terminated by signal 11"),
                              ("abort", "terminated by signal 6"), ("kill", "terminated by signal 9"), ("deadlock", "deadlock"),
                              ("cycle", "deadlock")):
            done = explore("--", program, way)
            self.assertEqual(done.returncode, 1, way)
            self.assertRegex(done.stdout, rf"the default order failed at [24]\.000000000 s: {expected}")
            self.assertIn("thread 1#1 of ends  timeout sleep", done.stdout)
            self.assertEqual(explore(*replay_words(done.stdout)).returncode, 1, way)

    def test_call_stacks_of_the_threads_are_reported(self):
        program = self.compile("stacks.c", "-g", "-O0")
        stacks = {
            "crash": r"  thread 1 is terminated by signal 11\n      at crash at \S*stacks\.c:\d+\n      at run at \S*stacks\.c:\d+\n",
            "abort": r"  thread 1 is terminated by signal 6\n(?:      at .*\n)*      at run at \S*stacks\.c:\d+\n",
            "null": r"  thread 1 is terminated by signal 11\n(?:      at .*\n)*      at run at \S*stacks\.c:\d+\n",
            "deadlock": r"  main\n      at main at \S*stacks\.c:\d+\n"
                        r"  thread 1\n      at wait_in_vain at \S*stacks\.c:\d+\n      at run at \S*stacks\.c:\d+\n",
        }
        for way, expected in stacks.items():
            runs = [subprocess.run([WAITPOINT, "exec", "--", program, way], capture_output=True, text=True) for _ in range(2)]
            self.assertRegex(runs[0].stderr, "call stacks:\n" + expected, way)
            self.assertEqual(runs[0].stderr, runs[1].stderr)
            self.assertRegex(explore("--", program, way).stdout, "call stacks:\n" + expected, way)
        handled = subprocess.run([WAITPOINT, "exec", "--", program, "handled"], capture_output=True, text=True)
        self.assertEqual((handled.returncode, handled.stdout), (0, "handled 6\nhandled 11\n"))
        self.assertNotIn("call stacks", handled.stderr)


class Ends(ExecCase):
    """Threads beside a process that ends: all that they could still do is found."""

    def test_exit_of_the_process_can_be_preceded_by_each_thread(self):
        program = self.compile("beside_exit.cpp")
        for way in ("return", "statics", "atexit", "exit", "_exit", "quick_exit", "abort", "detach"):
            for strategy in ("dfs", "bounded:1", "random"):
                done = explore("--strategy", strategy, "--", program, way)
                self.assertEqual(done.returncode, 1, f"{way} {strategy}: {done.stdout}{done.stderr}")
                self.assertIn("terminated by signal 4 (Illegal instruction)", done.stdout, way)
                self.assertIn("1 switch away from the default order fails", done.stdout, way)
            self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr, way)

    def test_are_exhausted(self):
        done = explore("--strategy", "dfs", "--", self.compile("beside_exit.cpp"), "nothing")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("; exhaustive, switching at calls, ", done.stdout.splitlines()[0])


class Hangs(ExecCase):
    def test_behind_sockets_of_the_program_are_deadlocks(self):
        program = self.compile("epoll_thread.c")
        for strategy in ("portfolio", "dfs"):
            done = explore("--strategy", strategy, "--", program)
            self.assertEqual(done.returncode, 1, strategy)
            self.assertRegex(done.stdout, r" failed at \S+ s: deadlock\n  waitpoint: deadlock at \S+ s of virtual time\n"
                                          r"    main waits for condition variable received\n"
                                          r"    thread 1 waits for descriptor \d+\b.*\n1 switch away from the default order fails")
            self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr, strategy)

    def test_repeat_where_a_program_connects_to_itself(self):
        command = [WAITPOINT, "exec", "--", self.compile("epoll_thread.c")]
        runs = {subprocess.run(command, capture_output=True, text=True).stderr for _ in range(5)}
        self.assertEqual(len(runs), 1, runs)

    def test_spin_loops_on_memory_end(self):
        source = self.folder / "spins.c"
        source.write_text("#include <pthread.h>\nstatic volatile int is_set;\n"
                          "static void* set(void* none) { is_set = 1; return none; }\n"
                          "int main(void) {\n  pthread_t setter;\n  pthread_create(&setter, 0, set, 0);\n"
                          "  while (!is_set) {\n  }\n  return pthread_join(setter, 0);\n}\n")
        done = explore("--switch-at", "accesses", "--iterations", "100", "--", self.compile(str(source)))
        self.assertRegex(done.stdout, r"spins: 100 schedules, \d+ distinct, 0 failed", done.stderr)

    def test_outside_of_the_simulation_end_at_the_limit_and_so_does_their_replay(self):
        done = explore("--schedule-limit", "2", "--", self.compile("epoll_thread.c"), "native wait", self.folder / "fifo")
        self.assertRegex(done.stdout, r"failed at \S+ s: exceeded 2 s of wall clock time \(--schedule-limit\) at 0\.0+ s of virtual time\n"
                                      r"  main waits for something outside\n1 switch away from the default order fails")
        self.assertNotIn("--replay wx1.0.00000000.", done.stdout)
        again = explore("--schedule-limit", "2", *replay_words(done.stdout))
        self.assertEqual(again.returncode, 1)
        self.assertIn("waitpoint: failed: exceeded 2 s of wall clock time (--schedule-limit)\n"
                      "waitpoint: the same run as in the record\n", again.stderr)


if __name__ == "__main__":
    unittest.main()
