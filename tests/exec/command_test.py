# SPDX-License-Identifier: BSD-3-Clause
"""Output and exit status of `waitpoint exec`: command_test.py BUILD.

Ends of programs, reports of deadlocks, traces, options, campaigns over seeds, and rejected arguments.
"""

import functools
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from exec_case import ExecCase, Summary, WAITPOINT, execute


class Ends(ExecCase):
    """The exit status and the summary, for each way a program can end."""

    def end(self, way):
        return execute(1, self.compile("ends.c"), way)

    def test_by_exit_of_any_thread(self):
        for way, expected in (("", 7), ("exit", 3), ("_exit", 4), ("main leaves", 0)):
            status, _, text = self.end(way)
            self.assertEqual(status, expected, way)
            self.assertGreaterEqual(Summary(text).seconds, 2)
            self.assertEqual("waitpoint: replay: waitpoint exec --seed 1 --" in text, status != 0, text)

    def test_by_a_signal(self):
        for way, expected in (("abort", -6), ("crash", -11), ("kill", -9), ("overflow", -11)):
            status, _, text = self.end(way)
            self.assertEqual(status, expected, way)
            self.assertGreaterEqual(Summary(text).seconds, 2, "not known up to its last event")
            self.assertIn(f"terminated by signal {-expected}", text)
            self.assertRegex(text, r"replay: waitpoint exec --seed 1 -- \S+ends ")

    def test_by_a_signal_to_waitpoint_alone(self):
        for sent in (signal.SIGINT, signal.SIGQUIT, signal.SIGTERM):
            words = [str(word) for word in (WAITPOINT, "exec", "--", "cat")]
            # The parent may have these ignored, as a shell does for background jobs.
            heed = functools.partial(signal.signal, sent, signal.SIG_DFL)
            with subprocess.Popen(
                words, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL, preexec_fn=heed
            ) as running:
                time.sleep(0.5)
                running.send_signal(sent)
                self.assertEqual(running.wait(20), -sent)

    def test_by_a_deadlock_with_an_explanation(self):
        status, _, text = self.end("deadlock")
        self.assertEqual(status, 124)
        self.assertIn("deadlock at 4.", text)
        self.assertIn("main waits for mutex right, held by thread 1\n", text)
        self.assertIn("thread 1 waits for mutex left, held by main\n", text)
        self.assertIn("replay: waitpoint exec --seed 1 --", text)

    def test_as_it_would_while_some_wait_for_each_other(self):
        status, _, text = self.end("cycle")
        self.assertEqual(status, 5, text)
        self.assertIn("deadlock at 4.000000000 s of virtual time, of some threads; the others continue\n"
                      "  thread 2 waits for mutex right, held by thread 1\n"
                      "  thread 1 waits for mutex left, held by thread 2\n", text)
        self.assertEqual(text.count("waits for"), 2)


    def test_a_signal_ends_runs_of_many_seeds_however_short_they_are(self):
        for signal_number in (signal.SIGINT, signal.SIGTERM):
            words = [WAITPOINT, "exec", "--seeds", "1..1000000000", "--", "true"]
            with subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
                time.sleep(1)
                process.send_signal(signal_number)
                self.assertEqual(process.wait(timeout=60), -signal_number)


class Traces(ExecCase):
    def test_hold_all_events_up_to_a_crash(self):
        for way, status in (("crash", -11), ("deadlock", 124)):
            trace = self.folder / "trace.json"
            done = subprocess.run([str(WAITPOINT), "exec", "--trace", str(trace), "--", str(self.compile("ends.c")), way],
                                  capture_output=True)
            self.assertEqual(done.returncode, status)
            events = json.loads(trace.read_text())["traceEvents"]
            threads = {event["args"]["name"] for event in events if event["name"] == "thread_name"}
            self.assertEqual(threads, {"main#0 of ends", "thread 1#1 of ends"})
            last = max(event["ts"] for event in events if "ts" in event)
            self.assertGreaterEqual(last, 2e6, "microseconds of virtual time")


    def test_show_each_process_with_its_threads(self):
        trace, words = self.folder / "trace.json", ["--", "sh", "-c", "(sleep 1; kill -9 $$) & echo a | cat; sleep 2"]
        done = subprocess.run([str(WAITPOINT), "exec", "--trace", str(trace), *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, -9)
        events = json.loads(trace.read_text())["traceEvents"]
        names = {}
        for event in events:
            if event["name"] == "process_name":
                names.setdefault(event["pid"], []).append(event["args"]["name"])
        self.assertEqual(names[1000], ["sh"])
        cat = next(process for process in names if f"cat#{process}" in names[process])
        self.assertEqual(names[cat], [f"sh#{cat}", f"cat#{cat}"])
        threads = {(event["pid"], event["args"]["name"]) for event in events if event["name"] == "thread_name"}
        self.assertIn((1000, "main#0 of sh"), threads)
        self.assertIn((cat, f"main#0 of cat#{cat}"), threads)
        self.assertEqual({event["pid"] for event in events if "ts" in event}, set(names))
        stamps = [event["ts"] for event in events if event.get("cat") == "event"]
        self.assertEqual(stamps, sorted(set(stamps)), "the events of all processes are in one order")
        plain = subprocess.run([str(WAITPOINT), "exec", *words], capture_output=True, text=True)
        self.assertEqual(Summary(done.stderr).digest, Summary(plain.stderr).digest)


class Options(ExecCase):
    """Isolation of a run from the machine."""

    def output(self, what, *options, seed=1):
        words = [WAITPOINT, "exec", "--quiet", "--seed", seed, *options, "--", self.compile("options.c"), what]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split(), done.stderr

    def test_the_trapped_counter_of_the_processor_shows_virtual_time(self):
        self.require_trapped_counter()
        (between, slept, processor), _ = self.output("counter", "--trap-rdtsc")
        self.assertLess(int(between), 1000)
        self.assertTrue(1_000_000 <= int(slept) < 1_010_000, slept)
        self.assertEqual(processor, "0")
        self.assertEqual(self.output("counter", "--trap-rdtsc")[0], [between, slept, processor])

    def test_an_isolated_program_reaches_nothing_outside(self):
        found, told = self.output("connect", "--isolate")
        self.assertEqual(found, ["0", "1"])
        self.assertEqual(told, "waitpoint: exec: --isolate: traffic beyond this machine is rejected (EACCES)\n")
        self.assertEqual(self.output("connect")[0][0], "0")

    def test_the_random_bytes_of_a_process_are_of_the_seed(self):
        self.assertEqual(self.output("random"), self.output("random"))
        for one, other in zip(self.output("random")[0], self.output("random", seed=2)[0]):
            self.assertNotEqual(one, other)

    def test_setting_the_date_sets_that_of_the_simulation(self):
        if os.geteuid() == 0:
            self.assertEqual(self.output("date")[0], ["1000000000"])
        self.assertLess(abs(time.time() - os.stat("/proc/self").st_ctime), 100)


class Deadlocks(ExecCase):
    """Waits for descriptors that only the program itself could make ready."""

    def test_are_reported_for_descriptors_of_each_kind(self):
        program = self.compile("stuck.c")
        for way in "pipe", "pipe2", "socketpair", "eventfd", "dup", "dup2", "dup3", "fcntl", "epoll_create", "epoll_create1":
            status, _, text = execute(1, program, way)
            self.assertEqual(status, 124, f"{way}: {text}")
            self.assertIn("main waits for descriptor", text)

    def test_are_none_where_something_may_come_from_outside(self):
        done = subprocess.run([str(WAITPOINT), "exec", "--", str(self.compile("stuck.c")), "epoll of outside"],
                              input=b"x", capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 1, done.stderr)


class Loopback(ExecCase):
    def test_is_no_matter_of_the_wall_clock(self):
        runs = [execute(seed, self.compile("loopback.c")) for seed in (1, 1, 1, 2)]
        for status, _, text in runs:
            self.assertEqual(status, 0, text)
            self.assertLess(Summary(text).seconds, 0.02)
        digests = [Summary(text).digest for _, _, text in runs]
        self.assertEqual((len(set(digests[:3])), len(set(digests))), (1, 2))


class Polling(ExecCase):
    """Loops until a second has passed, that look at no clock."""

    def test_by_primitives_has_about_as_many_rounds_as_a_real_machine(self):
        program = self.compile("until.c")
        for what in "lock", "post":
            for by in "handler", "thread":
                words = [str(word) for word in (WAITPOINT, "exec", "--", program, what, by)]
                done = subprocess.run(words, capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertAlmostEqual(int(done.stdout), 10_000_000, delta=1000, msg=f"{what} {by}: 50 ns a primitive")
                self.assertAlmostEqual(Summary(done.stderr).seconds, 1, places=3)


class PlainPath(ExecCase):
    """The kernel without its fast paths."""

    def test_is_the_same_run(self):
        digests = []
        for value in ("1", "0"):
            words = ["env", f"WAITPOINT_FAST_PATHS={value}", str(WAITPOINT), "exec", "--", str(self.compile("loopback.c"))]
            done = subprocess.run(words, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            digests.append(Summary(done.stderr).digest)
        self.assertEqual(digests[0], digests[1])


class Seeds(ExecCase):
    """A campaign ends at the first failing seed, and prints its replay line."""

    def test_find_a_lost_update_without_compiling_the_program_anew(self):
        program = self.compile("lost_update.c")
        done = subprocess.run([str(WAITPOINT), "exec", "--seeds", "1..200", "--", str(program)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("an update was lost", done.stderr)
        seed = re.search(r"seed (\d+) failed, after \d+ that passed: exit status 1", done.stderr)[1]
        self.assertIn(f"replay: waitpoint exec --seed {seed} -- {program}", done.stderr)
        self.assertEqual(execute(seed, program)[0], 1)

    def test_passing_runs_are_counted_with_their_schedules(self):
        program = self.compile("lost_update.c")
        done = subprocess.run([str(WAITPOINT), "exec", "--seeds", "1..20", "--", str(program), "locked"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"lost_update: 20 seeds, \d+ schedules, none failed")


class Refusals(ExecCase):
    def refused(self, *words):
        done = subprocess.run([str(WAITPOINT), "exec", *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 125)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_say_what_is_wrong(self):
        self.assertIn("there is no program 'nosuch'", self.refused("--", "nosuch"))
        self.assertIn("expected a program", self.refused())
        self.assertIn("expected a program", self.refused("--"))
        self.assertIn("--seed: expected a whole number from 0 to 2^64 - 1, found 'x'", self.refused("--seed", "x", "--", "true"))
        self.assertIn("--seeds: expected FIRST..LAST, found '5..1'", self.refused("--seeds", "5..1", "--", "true"))
        for clock in ("best", "fixed", "fixed:-1", "interval:5", "interval:5..1", "cpu:2", "cpu:x-1"):
            self.assertIn(f"--clock: expected fixed:US, interval:US..US, counted[:NS], cpu[:xFACTOR] or proportional[:xFACTOR], found '{clock}'",
                          self.refused("--clock", clock, "--", "true"))
        self.assertIn("--trace: cannot be used together with --seeds", self.refused("--seeds", "1..2", "--trace", "x", "--", "true"))
        self.assertIn("--strategy: expected fifo or random, found 'best'", self.refused("--strategy", "best", "--", "true"))
        for words, given in ((["ls"], " -- ls"), (["--seed", "3", "ls", "-l", "a b"], " --seed 3 -- ls -l 'a b'")):
            self.assertEqual(f"waitpoint: exec: expected '--' before the program: waitpoint exec{given}\n", self.refused(*words))
        self.assertIn("unknown option '--sed', did you mean '--seed'?", self.refused("--sed", "1", "--", "true"))
        self.assertIn("unknown option '--sed', did you mean '--seed'?", self.refused("--sed", "1", "true"))

    def test_simulation_within_a_simulation(self):
        done = subprocess.run([WAITPOINT, "exec", "--quiet", "--", WAITPOINT, "exec", "--", "true"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 125, done.stderr)
        self.assertIn("waitpoint: exec: a simulated program cannot start a simulation of its own\n", done.stderr)

    def test_programs_that_refuse_preloading(self):
        static = self.folder / "static"
        (self.folder / "empty.c").write_text("int main(void) { return 0; }\n")
        for option in "-static-pie", "-static":
            subprocess.run(["gcc", option, self.folder / "empty.c", "-o", static], check=True)
            self.assertIn("is linked statically", self.refused("--", str(static)))
        for compiler, option, reason in (("gcc", "address", "is compiled with -fsanitize=address"),
                                         ("clang", "address", "is compiled with -fsanitize=address"),
                                         ("clang", "thread", "can be linked by g++ with this option")):
            sanitized = self.folder / f"{compiler}-{option}"
            with self.subTest(compiler=compiler, option=option):
                if shutil.which(compiler) is None:
                    self.skipTest(f"there is no {compiler}")
                linked = subprocess.run([compiler, f"-fsanitize={option}", self.folder / "empty.c", "-o", sanitized],
                                        capture_output=True, text=True)
                if compiler == "clang" and "libclang_rt" in linked.stderr:
                    self.skipTest("clang has no libraries for sanitizers: they are a package of their own")
                self.assertEqual(linked.returncode, 0, linked.stderr)
                self.assertIn(reason, self.refused("--", str(sanitized)))
        static.chmod(0o4755)
        self.assertIn("changes its user or group", self.refused("--", str(static)))
        text = self.folder / "text"
        text.write_text("neither\n")
        text.chmod(0o755)
        self.assertIn("is neither a program nor a script", self.refused("--", str(text)))


if __name__ == "__main__":
    unittest.main()
