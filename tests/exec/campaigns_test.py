# SPDX-License-Identifier: BSD-3-Clause
"""Schedules of `waitpoint explore -- PROGRAM` that depend on earlier ones: feedback, and the enumeration that follows draws
which bring nothing new: campaigns_test.py BUILD."""

import json
import re
import unittest

from exec_case import ExecCase, explore, replay_words

STAGES = """
#include <pthread.h>
#include <semaphore.h>
#define STAGES %d
static pthread_mutex_t lock[STAGES];
static int written[STAGES], reached;
static void* write_all(void* none) {
  for (int i = 0; i < STAGES; ++i) {
    pthread_mutex_lock(&lock[i]);
    written[i] = 1;
    pthread_mutex_unlock(&lock[i]);
  }
  return none;
}
static void* read_all(void* none) {
  for (int is_right = 1; reached < STAGES && is_right; reached += is_right) {
    pthread_mutex_lock(&lock[reached]);
    is_right = written[reached] == reached %% 2;
    pthread_mutex_unlock(&lock[reached]);
  }
  return none;
}
int main(void) {
  pthread_t writer, reader;
  pthread_create(&writer, NULL, write_all, NULL);
  pthread_create(&reader, NULL, read_all, NULL);
  pthread_join(writer, NULL);
  pthread_join(reader, NULL);
  return reached == STAGES && %s;
}
"""


class Exhausted(ExecCase):
    """Searches that have tried all: draws that bring nothing new are followed by an enumeration."""

    def alternating(self, stages, fails):
        """Two threads, of which the reader is in turns before and behind the writer, in one order of many."""
        source = self.folder / f"alternating_{stages}_{fails}.c"
        source.write_text(STAGES % (stages, fails))
        return self.compile(str(source))

    def test_ends_and_names_its_assumptions(self):
        program = self.alternating(3, 0)
        lines = set()
        for options in ((), ("--jobs", "3"), ("--fork-each",)):
            done = explore("--iterations", "5000", "--switch-at", "calls", *options, "--", program)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines.add(re.sub(r"in \d+\.\d s \(.*? a second\)", "", done.stdout))
        self.assertEqual(len(lines), 1, lines)
        line = lines.pop()
        self.assertRegex(line, r": \d+ schedules, 22 distinct, 0 failed, ; exhausted, no other ordering exists up to the order of "
                               r"independent events, if there are no data races, switching at calls, the program's own code shares no other memory in 20 schedules ")
        self.assertLess(int(re.search(r": (\d+) schedules", line)[1]), 5000)

    def test_is_not_said_before(self):
        for iterations in (199, 210):
            done = explore("--iterations", str(iterations), "--", self.alternating(3, 0))
            self.assertRegex(done.stdout, rf": {iterations} schedules, \d+ distinct, 0 failed, .* a second\)\n"
                                          r"\d+ pairs of events in \d+ schedules of random( with switches at accesses)?, a new one in the next ")

    def test_tells_how_much_was_seen(self):
        program = self.alternating(6, 0)
        lines = set()
        for options in ((), ("--jobs", "3"), ("--fork-each",)):
            done = explore("--iterations", "480", "--switch-at", "calls", *options, "--", program)
            lines.add(done.stdout.splitlines()[1])
            self.assertRegex(done.stdout.splitlines()[1], r"^\d+ pairs of events in 40 schedules of random, a new one in the next with a chance of "
                                                          r"\S+ % \(95 % confidence: \S+ % to \S+ %\)$")
        self.assertEqual(len(lines), 1, lines)
        done = explore("--iterations", "480", "--switch-at", "calls", "--json", "--", program)
        seen = json.loads(done.stdout)["result"]["search"]["seen"]
        self.assertIn(f"{seen['pairs']} pairs of events in {seen['schedules']} schedules of {seen['strategy']},", lines.pop())
        self.assertLessEqual(seen["lower_bound"], seen["new_pair_chance"])
        self.assertLess(seen["new_pair_chance"], seen["upper_bound"])

    def test_calls_on_shared_state_are_in_pairs(self):
        source = self.folder / "environment.c"
        source.write_text("#include <pthread.h>\n#include <stdlib.h>\nstatic void* set(void* none) {\n"
                          "  for (int i = 0; i < 40; ++i) setenv(\"NAME\", i % 2 ? \"1\" : \"2\", 1), getenv(\"NAME\");\n  return none;\n}\n"
                          "int main(void) {\n  pthread_t one, two;\n  pthread_create(&one, NULL, set, NULL), pthread_create(&two, NULL, set, NULL);\n"
                          "  return pthread_join(one, NULL) + pthread_join(two, NULL);\n}\n")
        done = explore("--iterations", "120", "--switch-at", "calls", "--", self.compile(str(source)))
        # Of each thread two events, each of which reads from the other's change or from its own.
        self.assertGreaterEqual(int(re.search(r"(\d+) pairs of events in 10 schedules of random", done.stdout)[1]), 8, done.stdout)

    def test_finds_failures_that_random_draws_miss(self):
        program = self.alternating(5, 1)
        done = explore("--strategy", "pct:1", "--iterations", "5000", "--", program)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"\nschedule \d+ of strategy dpor, seed 1, failed at ")
        self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr)
        self.assertEqual(done.stdout.splitlines()[1:],
                         explore("--strategy", "pct:1", "--iterations", "5000", "--jobs", "2", "--", program).stdout.splitlines()[1:])

    def test_several_processes_are_searched_depth_first(self):
        source = self.folder / "parent_of_one.c"
        source.write_text("#include <sys/wait.h>\n#include <unistd.h>\nint main(void) {\n  if (fork() == 0) _exit(0);\n"
                          "  return wait(NULL) < 0;\n}\n")
        done = explore("--iterations", "2000", "--", self.compile(str(source)))
        self.assertRegex(done.stdout, r" 0 failed, .*; exhausted, no other ordering exists(, except .*)?, switching at calls, if threads share memory by calls alone ")

    def test_results_are_of_as_many_schedules_as_were_asked_for(self):
        results = self.folder / "results"
        explore("--iterations", "400", "--results", results, "--", self.alternating(3, 0))
        self.assertEqual(len(results.read_text().splitlines()), 401)


class Processes(ExecCase):
    """Schedules that learn from others, and batches of those that do not."""

    def test_results_do_not_depend_on_processes(self):
        program = self.compile("orders.c")

        def results(*options):
            file = self.folder / "results"
            explore("--strategy", strategy, "--iterations", str(schedules), *options, "--results", file, "--", program)
            return set(file.read_text().splitlines())

        for strategy, schedules in (("rff", 60), ("portfolio", 200), ("random", 500)):
            one = results()
            self.assertEqual(len(one), schedules + 1)
            for options in (("--jobs", "3"), ("--fork-each",)):
                self.assertEqual(one, results(*options), (strategy, options))
            self.assertEqual(one, set().union(*(results("--shard", f"{shard}/3") for shard in (1, 2, 3))), strategy)

    def test_the_first_failure_does_not_depend_on_processes(self):
        for stages, strategy in ((4, "random"), (7, "dpor")):
            source = self.folder / f"alternating_{stages}.c"
            source.write_text(STAGES % (stages, 1))
            words = ("--strategy", "random", "--iterations", "20000", "--races", "ignore", "--", self.compile(str(source)))
            found = {re.search(r"\nschedule (\d+ of strategy \w+), seed 1, failed", explore(*options, *words).stdout)[1]
                     for options in ((), ("--jobs", "3"), ("--fork-each",))}
            self.assertEqual(len(found), 1, found)
            self.assertIn(strategy, found.pop())

    def test_a_number_is_replayed_with_the_schedules_that_it_learns_from(self):
        source = self.folder / "alternating_9.c"
        source.write_text(STAGES % (9, 1))
        program = self.compile(str(source))
        done = explore("--strategy", "rff", "--iterations", "5000", "--switch-at", "calls", "--no-minimize", "--races", "ignore", "--", program)
        self.assertEqual(done.returncode, 1, done.stdout)
        number = int(re.search(r"\nschedule (\d+) of strategy rff, seed 1, failed", done.stdout)[1])
        digest = re.search(r"^replay: .* wx1\.0\.([0-9a-f]{8})", done.stdout, re.M)[1]
        self.assertGreater(number, 8)
        again = explore("--switch-at", "calls", "--races", "ignore", "--replay", f"wx1.0.{digest}.rff.1.{number}", "--", program)
        self.assertIn("the same run as in the record", again.stderr)


if __name__ == "__main__":
    unittest.main()
