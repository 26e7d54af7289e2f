# SPDX-License-Identifier: BSD-3-Clause
"""`waitpoint explore -- PROGRAM`: unmodified programs under many schedules: exploring_test.py BUILD."""

import json
import pathlib
import re
import shutil
import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT, explore, replay_words


class Exploring(ExecCase):
    def test_finds_a_lost_update_and_cuts_it_short(self):
        program = self.compile("lost_update.c")
        done = explore("--", program)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"schedule \d+ of strategy portfolio, seed 1, failed at \S+ s: exit status 1\n"
                                      r"  an update was lost\ncause: thread 2 locks .* between two critical sections of thread 1\n1 switch away from the default order fails")
        self.assertIn("thread 2#2 of lost_update (start) goes first instead of", done.stdout)
        self.assertIn("the last choice from which it could still have passed: number ", done.stdout)
        self.assertRegex(done.stdout, r"the two events whose order matters:\n"
                                      r"  first in the failing run: +at 0\.0+ s: thread 2#2 of lost_update, about to lock mutex #\d+ "
                                      r"\"mutex\"\n      at pay_in[^\n]*\n"
                                      r"  first in a passing run: +at 0\.0+ s: thread 1#1 of lost_update, about to lock "
                                      r"mutex #\d+ \"mutex\"\n      at pay_in[^\n]*\n")
        self.assertEqual(explore("--", program).stdout.splitlines()[1:], done.stdout.splitlines()[1:])

    def test_replays_it_with_the_output_that_it_had(self):
        program = self.compile("lost_update.c")
        words = replay_words(explore("--", program).stdout)
        done = explore(*words)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "an update was lost\nwaitpoint: failed: exit status 1\n"
                                      "waitpoint: the same run as in the record\n")

    def test_every_strategy_finds_it_and_its_schedule_is_replayed(self):
        program = self.compile("lost_update.c")
        for strategy in ("random", "pct:2", "pos", "urw", "surw", "portfolio"):
            schedule, trace = self.folder / "schedule", self.folder / "trace.json"
            done = explore("--strategy", strategy, "--jobs", "2", "--schedule", schedule, "--trace", trace, "--", program)
            self.assertEqual(done.returncode, 1, strategy)
            self.assertGreater(len(json.loads(trace.read_text())["traceEvents"]), 10)
            self.assertEqual(explore("--replay", schedule, "--", program).returncode, 1)
            raw = explore("--strategy", strategy, "--no-minimize", "--", program)
            self.assertIn("the same run as in the record", explore(*replay_words(raw.stdout)).stderr, strategy)

    def test_a_correct_program_passes_under_many_schedules(self):
        done = explore("--iterations", "100", "--switch-at", "calls", "--", self.compile("lost_update.c"), "locked")
        self.assertEqual(done.returncode, 0, done.stdout)
        # Who locks first, and whether the other comes to the lock before it is free.
        self.assertIn("lost_update: 100 schedules, 4 distinct, 0 failed", done.stdout)

    def test_shards_and_processes_change_no_result(self):
        program, lines = self.compile("lost_update.c"), set()
        for shard in ("1/2", "2/2"):
            results = self.folder / "results"
            explore("--iterations", "40", "--jobs", "2", "--shard", shard, "--results", results, "--", program)
            lines |= set(results.read_text().splitlines())
        explore("--iterations", "40", "--results", self.folder / "results", "--", program)
        self.assertEqual(lines, set((self.folder / "results").read_text().splitlines()))

    def test_results_are_written_as_they_come(self):
        results = self.folder / "results"
        words = [WAITPOINT, "explore", "--time-limit", "60", "--results", results, "--", self.compile("lost_update.c"), "locked"]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            while not results.exists() or len(results.read_text().splitlines()) < 20:
                self.assertIsNone(process.poll())
            process.kill()
        lines = results.read_text().splitlines()[1:]
        self.assertEqual([int(line.split()[0]) for line in lines], list(range(len(lines))))

    def test_child_processes_end_with_their_run(self):
        program = self.compile("parent.c")
        self.assertEqual(explore("--iterations", "5", "--", program).returncode, 0)
        left = subprocess.run(["pgrep", "-f", f"^{program}$"], capture_output=True, text=True).stdout.split()
        self.assertEqual(left, [])

    def test_variables_of_one_letter_keep_their_names(self):
        source = self.folder / "short.c"
        source.write_text("#include <pthread.h>\nstatic pthread_mutex_t m = PTHREAD_MUTEX_INITIALIZER;\n"
                          "int main(void) { pthread_mutex_lock(&m); return pthread_mutex_lock(&m); }\n")
        done = explore("--", self.compile(str(source)))
        self.assertIn("main waits for mutex m, held by itself", done.stdout)

    def test_each_run_reads_a_file_from_its_beginning(self):
        with (self.folder / "lines").open("w") as file:
            file.write("one\ntwo\n")
        with (self.folder / "lines").open() as file:
            done = explore("--iterations", "20", "--", "python3", "-c", "import sys; sys.exit(len(sys.stdin.readlines()) != 2)",
                           stdin=file)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Exhaustive(ExecCase):
    """Exhaustive strategies."""

    def outcomes(self, *words):
        """The outcome of each schedule, and the summary line."""
        results = self.folder / "results"
        done = explore("--iterations", "100000", "--results", results, *words, "--", self.compile("orders.c"))
        lines = results.read_text().splitlines()[1:]
        self.assertEqual(len({line.split()[1] for line in lines}), len(lines), "a schedule came twice")
        return {line.split(" ", 2)[2] for line in lines}, done.stdout.splitlines()[0]

    def test_bounded_search_tries_all_orders_that_so_many_preemptions_make(self):
        passed, status = {"passed"}, "failed: exit status "
        without_one = {status + "5"} | passed
        found, line = self.outcomes("--strategy", "bounded:1")
        self.assertLess(without_one, found)
        self.assertIn("; exhaustive with at most 1 preemption, switching at calls, ", line)
        found, line = self.outcomes("--strategy", "bounded:3")
        self.assertEqual({status + str(order) for order in range(1, 6)} | passed, found)
        self.assertIn("; exhaustive with at most 3 preemptions, switching at calls, ", line)

    def test_search_by_partial_orders_tries_all_results_in_fewer_schedules(self):
        program = self.compile("lost_update.c")
        found = {}
        for strategy in ("dfs", "dpor"):
            done = explore("--strategy", strategy, "--iterations", "100000", "--", program, "locked")
            self.assertRegex(done.stdout, "0 failed.*; exhaustive", strategy)
            found[strategy] = int(re.search(r"(\d+) schedule", done.stdout)[1])
            failed = explore("--strategy", strategy, "--no-minimize", "--", program)
            self.assertEqual(failed.returncode, 1, failed.stderr)
            self.assertIn("the same run as in the record", explore(*replay_words(failed.stdout)).stderr)
        self.assertLess(10 * found["dpor"], found["dfs"])

    def test_cut_off_search_claims_no_completeness(self):
        done = explore("--iterations", "10", "--strategy", "dfs", "--", self.compile("lost_update.c"), "locked")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("exhaustive", done.stdout)

    def test_reports_time_advanced_for_a_polling_thread(self):
        source = self.folder / "polls.c"
        source.write_text("#include <pthread.h>\n#include <semaphore.h>\n#include <unistd.h>\nstatic sem_t posted;\n"
                          "static void* post(void* none) { sleep(2); sem_post(&posted); return none; }\n"
                          "int main(void) {\n  pthread_t poster;\n  sem_init(&posted, 0, 0);\n"
                          "  pthread_create(&poster, NULL, post, NULL);\n  sleep(1);\n"
                          "  for (int i = 0; i < 30; ++i) sem_trywait(&posted);\n  return pthread_join(poster, NULL);\n}\n")
        line = explore("--strategy", "bounded:0", "--", self.compile(str(source))).stdout.splitlines()[0]
        self.assertIn("exhaustive with at most 0 preemptions, switching at calls, except turns of spinning tasks, ", line)

    def test_findings_are_replayed(self):
        program = self.compile("lost_update.c")
        for options in ((), ("--no-minimize",)):
            done = explore("--strategy", "bounded:2", *options, "--", program)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr)

    def test_the_default_order_is_one_schedule(self):
        done = explore("--strategy", "fifo", "--", self.compile("lost_update.c"))
        self.assertIn("lost_update: 1 schedule, 1 distinct, 0 failed", done.stdout)

    def test_bad_input(self):
        for words, line in (
            (("--strategy", "dfs", "--jobs", "2", "--", self.compile("lost_update.c")),
             "--jobs: cannot be used together with dfs, which derives each schedule from the one before"),
            (("--strategy", "dpor", "--shard", "1/2", "--", self.compile("lost_update.c")),
             "--shard: cannot be used together with dpor, which derives each schedule from the one before"),
            (("--strategy", "dpor", "--", self.compile("two_processes.c"), "locked"),
             "--strategy: expected dfs or bounded:K, as the program starts processes or other programs, found 'dpor'"),
        ):
            done = explore(*words)
            self.assertEqual((done.returncode, done.stderr), (2, f"waitpoint: {line}\n"))


class Conditions(ExecCase):
    """Properties shared by all runs, besides their schedules."""

    def test_computing_takes_the_time_of_the_clock(self):
        program = self.compile("lost_update.c")
        done = explore("--clock", "fixed:100", "--strategy", "random", "--", program)
        self.assertRegex(done.stdout, r"failed at 0\.00[1-9]\d+ s: exit status 1")
        words = replay_words(done.stdout)
        self.assertEqual(words[2:4], ["--clock", "fixed:100"])
        self.assertIn("the same run as in the record", explore(*words).stderr)

    def test_costs_of_computations_are_chosen(self):
        done = explore("--clock", "interval:1..9", "--iterations", "20", "--", self.compile("lost_update.c"), "locked")
        self.assertRegex(done.stdout, r"20 schedules, (1\d|20) distinct, 0 failed")

    def test_the_outside_is_kept_from_it(self):
        done = explore("--isolate", "--iterations", "2", "--", self.compile("options.c"), "isolated")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_counter_is_kept_from_it(self):
        self.require_trapped_counter()
        program = self.compile("options.c")
        done = explore("--trap-rdtsc", "--iterations", "2", "--", program, "trapped")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(explore("--iterations", "2", "--", program, "trapped").returncode, 1)

    def test_bad_input(self):
        done = explore("--clock", "cpu", "--", self.compile("options.c"))
        self.assertEqual((done.returncode, done.stderr),
                         (2, "waitpoint: --clock: expected fixed:US, interval:US..US or counted[:NS], as measured clocks "
                             "are not repeatable, found 'cpu'\n"))


class CountedTime(ExecCase):
    """Programs whose basic blocks are counted."""

    def compile_counted(self):
        library = self.folder / "libblocks.so"
        subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", str(library)], check=True, text=True,
                       input="void __sanitizer_cov_trace_pc(void) {}\n")
        return self.compile("blocks.c", "-fsanitize-coverage=trace-pc", library)

    def take_ns(self, program, *options):
        done = subprocess.run([str(WAITPOINT), "exec", *options, "--", str(program)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [int(word) for word in done.stdout.split()], re.search(r"digest (\S+)", done.stderr)[1]

    def test_passes_by_how_often_a_loop_is_gone_through(self):
        program = self.compile_counted()
        (few, many), digest = self.take_ns(program, "--clock", "counted")
        self.assertGreaterEqual(few, 1000)
        self.assertTrue(9 * few < many < 11 * few, f"{few} {many}")
        self.assertEqual(self.take_ns(program, "--clock", "counted"), ([few, many], digest))
        (few_dear, _), _ = self.take_ns(program, "--clock", "counted:7")
        self.assertTrue(6 * few < few_dear < 7.1 * few, f"{few} {few_dear}")
        self.assertLess(self.take_ns(program)[0][1], 1000)

    def test_is_refused_where_none_is_counted(self):
        for words in ("exec",), ("explore",):
            done = subprocess.run([str(WAITPOINT), *words, "--clock", "counted", "--", "/bin/true"], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(done.stderr, "waitpoint: --clock: counted is for programs compiled with "
                                          "-fsanitize-coverage=trace-pc, which '/bin/true' is not\n")


class Instrumented(ExecCase):
    """Programs compiled with -fsanitize=thread, as for the compiler's own runtime."""

    def setUp(self):
        if not (WAITPOINT.parent.parent / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        self.program = self.compile("racing.cpp", "-g", "-fsanitize=thread")

    def execute(self, *words):
        return subprocess.run([str(WAITPOINT), "exec", "--", str(self.program), *words], capture_output=True, text=True)

    def test_exhaustive_search_says_that_it_leaves_first_accesses_out(self):
        source = self.folder / "late.cpp"
        source.write_text("#include <pthread.h>\n#include <atomic>\nstatic std::atomic<std::atomic<int>*> shared;\n"
                          "static void* publish(void*) {\n  auto* value = new std::atomic<int>(0);\n  shared.store(value);\n"
                          "  return reinterpret_cast<void*>(static_cast<long>(value->load()));\n}\n"
                          "int main() {\n  pthread_t publisher;\n  pthread_create(&publisher, nullptr, publish, nullptr);\n"
                          "  if (auto* value = shared.load()) value->store(1);\n  return pthread_join(publisher, nullptr);\n}\n")
        line = explore("--strategy", "bounded:2", "--", self.compile(str(source), "-fsanitize=thread")).stdout.splitlines()[0]
        self.assertTrue(line.endswith("exhaustive with at most 2 preemptions, except switches at first accesses to memory that "
                                      "the default order does not share"), line)

    def test_races_are_reported_with_both_accesses_and_their_lines(self):
        done = self.execute()
        self.assertEqual((done.returncode, done.stdout), (0, "2 seen\n"), "they did no harm in this schedule")
        self.assertRegex(done.stderr, r"data race at 0x\w+ .*\n  first: write of 4 bytes by task thread 1#1, after its event \d+\n"
                                      r"    .* at .*racing\.cpp:20\n(    .*\n)*"
                                      r"  second: read of 4 bytes by task thread 2#2, after its event \d+\n    .* at .*racing\.cpp:19\n")

    def test_accesses_ordered_by_locks_and_atomics_do_not_race(self):
        for way in ("locked", "ordered"):
            self.assertNotIn("data race", self.execute(way).stderr)
            done = explore("--iterations", "50", "--", self.program, way)
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_meeting_points_order_accesses(self):
        program = self.compile("meetings.cpp", "-std=c++20", "-fsanitize=thread")
        meetings = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertGreater(len(meetings), 15)
        for meeting in meetings:
            with self.subTest(meeting):
                done = explore("--iterations", "30", "--", program, meeting)
                self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_race_is_a_failure_and_is_replayed(self):
        for way in ([], ["flag"]):
            done = explore("--races", "fail", "--", self.program, *way)
            self.assertEqual(done.returncode, 1)
            self.assertIn("the default order failed at 0.000000000 s: a data race\n", done.stdout)
            again = explore(*replay_words(done.stdout))
            self.assertIn("the same run as in the record", again.stderr)
            self.assertIn("racing.cpp:", again.stderr)


class Names(ExecCase):
    def test_functions_of_the_program_keep_their_names(self):
        # Instrumented, it refers to a library that has functions of these names, so that it exports them.
        for option in ("-g", "-fsanitize=thread"):
            program = self.compile("names_of_functions.c", "-fno-builtin", "-w", option)
            self.assertEqual(subprocess.run([WAITPOINT, "exec", "--", program]).returncode, 0, option)
            done = explore("--iterations", "20", "--", program)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            program.unlink()


    def test_functions_of_the_compilers_runtime_are_provided(self):
        program = self.compile("at_exit.c", "-fsanitize=thread")
        self.assertEqual(subprocess.run([program]).returncode, 7)
        self.assertRegex(explore("--", program).stdout, "^the default order failed at .*: exit status 7\n")


class Debugging(ExecCase):
    def test_gdb_sees_the_threads(self):
        if not shutil.which("gdb"):
            self.skipTest("there is no gdb")
        program = self.compile("lost_update.c", "-g")
        commands = ("break pay_in", "run", "info fibers", "next-event", "virtual-time", "delete", "continue")
        done = subprocess.run([str(WAITPOINT), "gdb", "-batch", *(word for text in commands for word in ("-ex", text)),
                               "--", "exec", "--seed", "3", "--", str(program)], capture_output=True, text=True, timeout=120)
        self.assertRegex(done.stdout, r"\* +[23] +thread [12] +lost_update +- +0\.000000000 +running")
        self.assertRegex(done.stdout, r"event \d+ at 0\.000000000 s: \S.* of lost_update: ")
        self.assertIn("exited normally", done.stdout)


class Refusals(ExecCase):
    def refused(self, *words):
        done = explore(*words)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_say_what_is_wrong(self):
        self.assertIn("expected a scenario or a program: waitpoint explore SCENARIO", self.refused())
        self.assertIn("there is no program 'nosuch'", self.refused("--", "nosuch"))
        self.assertIn("--from: cannot be used together with a program", self.refused("--from", "1", "--", "true"))
        self.assertIn("--set: cannot be used", self.refused("--set", "world.step_ms=5", "--", "true"))
        self.assertIn("--property: cannot be used", self.refused("--property", "collisions=0", "--", "true"))
        self.assertIn("SCENARIO: cannot be used together with a program", self.refused("office.yaml", "--", "true"))
        self.assertIn(f"'{self.folder}' is not an executable file", self.refused("--", self.folder))
        early = self.compile("early.c")
        self.assertIn("did not reach main(): terminated by signal 6 (Aborted)", self.refused("--", early))
        self.assertIn("unknown strategy 'best'", self.refused("--strategy", "best", "--", "true"))
        self.assertIn("--races: expected report, fail or ignore, found 'some'", self.refused("--races", "some", "--", "true"))

    def test_refuses_other_records(self):
        program, schedule = self.compile("lost_update.c"), self.folder / "other"
        explore("--schedule", schedule, "--", program)
        self.assertIn("2: expected a schedule of this program", self.refused("--replay", schedule, "--", program, "locked"))
        self.assertIn("belongs to a test that calls explore()", self.refused("--replay", "wx1.1.0123abcd.random.1.5", "--", program))
        self.assertIn("this is not the run of the record",
                      self.refused("--replay", "wx1.0.0123abcd.=0-1", "--", pathlib.Path("/bin/true")))


if __name__ == "__main__":
    unittest.main()
