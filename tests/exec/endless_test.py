# SPDX-License-Identifier: BSD-3-Clause
"""Runs that would not end by themselves: endless_test.py BUILD.

Programs in which only timers expire; signals to `waitpoint`; loops without calls.
"""

import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

from exec_case import BUILD, ExecCase, HERE, Summary, WAITPOINT


def heed_signals():
    """In the new process: nohup and others may have left them ignored."""
    for each in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
        signal.signal(each, signal.SIG_DFL)


def await_handler(process, sent):
    """Until the process has a handler for the signal."""
    while not int(re.search(r"SigCgt:\s+(\w+)", pathlib.Path(f"/proc/{process.pid}/status").read_text())[1], 16) >> (sent - 1) & 1:
        time.sleep(0.02)


class Idle(ExecCase):
    """The idle limit, by default an hour of virtual time."""

    def end(self, way, *options):
        words = [WAITPOINT, "exec", *options, "--", self.compile("idle.c"), way]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=100)
        return done.returncode, done.stdout, done.stderr

    def test_ends_a_run_without_wake_ups_between_tasks(self):
        states = {
            "poll": r"  main sleeps\n  thread 1 sleeps\n",
            "timeouts": r"  main waits for condition variable changed, with a timeout\n",
            "ticks": r"  main waits for descriptor \d+\n",
            "processes": r"  idle#1001: main sleeps\n  idle: main waits for child\n",
        }
        for way, state in states.items():
            status, _, text = self.end(way)
            self.assertEqual(status, 124, text)
            self.assertRegex(text, r"waitpoint: idle \(.*--idle-limit\) at \d+\.\d+ s of virtual time\n" + state)
            self.assertTrue(3600 <= Summary(text).seconds <= 4600, text)

    def test_ends_a_run_of_ignored_timers_after_a_thousand_seconds(self):
        status, _, text = self.end("unheard")
        self.assertEqual(status, 124, text)
        self.assertIn("  main waits for the end of a thread, that is thread 1\n  thread 1 waits for mutex lock, held by main\n", text)
        self.assertTrue(1000 <= Summary(text).seconds <= 1600, text)

    def test_is_an_option(self):
        status, _, text = self.end("poll", "--idle-limit", "20")
        self.assertEqual(status, 124, text)
        self.assertTrue(20 <= Summary(text).seconds <= 30, text)
        self.assertIn("replay: waitpoint exec --seed 1 --idle-limit 20", text)
        self.assertEqual(self.end("timed", "--idle-limit", "100")[0], 124)
        self.assertEqual(self.end("timed", "--idle-limit", "0")[0], 0)
        self.assertIn("--idle-limit: expected seconds of virtual time from 0 to 1e9, found '-1'", self.end("poll", "--idle-limit", "-1")[2])

    def test_leaves_runs_alone_that_go_on(self):
        for way, hours in (("working", 3), ("printing", 3), ("sleeping", 30), ("timed", 0.5)):
            status, _, text = self.end(way)
            self.assertEqual(status, 0, text)
            self.assertAlmostEqual(Summary(text).seconds / 3600, hours, places=3)

    def test_repeats(self):
        self.assertEqual(self.end("poll"), self.end("poll"))

    def test_is_a_failure_of_an_explored_schedule(self):
        words = [WAITPOINT, "explore", "--idle-limit", "20", "--iterations", "5", "--", self.compile("idle.c"), "poll"]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("idle: only timers expire, and no thread wakes another", done.stdout)
        self.assertIn("main sleeps", done.stdout)


class Signals(ExecCase):
    """SIGINT, SIGTERM and SIGHUP end a run at once, with the states of all threads."""

    def run_and_send(self, sent, words, command=("exec",), to_group=False, wait_s=0.2):
        """Returns the status, the error stream and the seconds that the end has taken."""
        words = [str(word) for word in (WAITPOINT, *command, "--", *words)]
        with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              preexec_fn=heed_signals, start_new_session=True) as running:
            self.assertEqual(running.stdout.readline(), "ready\n")
            time.sleep(wait_s)
            begin = time.monotonic()
            (os.killpg if to_group else os.kill)(running.pid, sent)
            status = running.wait(60)
            text = running.stderr.read()
            return status, text, time.monotonic() - begin

    def program(self, text):
        name = self.folder / f"signalled-{abs(hash(text))}.py"
        name.write_text("import os, signal, sys, threading, time\n" + text)
        return ["/usr/bin/python3", name]

    READY = "print('ready', flush=True)\n"

    def assertNobodyIsLeft(self, mark):
        left = [pid for pid in os.listdir("/proc") if pid.isdigit() and mark in self.command_line(pid)]
        self.assertEqual(left, [])

    def command_line(self, pid):
        try:
            return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace")
        except OSError:
            return ""

    def test_end_a_program_that_waits(self):
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for to_group in (False, True):
                for wait_s in (0.2, 1, 5):  # a loaded machine may not have let it come to its wait
                    status, text, _ = self.run_and_send(sent, [self.compile("idle.c"), "reading"], to_group=to_group, wait_s=wait_s)
                    if "main computes" not in text:
                        break
                self.assertEqual(status, -sent, text)
                self.assertIn(f"waitpoint: ended by signal {int(sent)} ", text)
                self.assertIn("main waits for descriptor 0 (outside)\n", text)

    def test_end_all_processes_and_name_the_calls_of_each(self):
        script = "sh -c 'read line <&3' & sh -c 'echo ready; while :; do :; done' & wait"
        for to_group in (False, True):
            status, text, _ = self.run_and_send(signal.SIGTERM, ["sh", "-c", f"exec 3<&0; {script}", "mark-of-all"], to_group=to_group)
            self.assertEqual(status, -signal.SIGTERM, text)
            self.assertRegex(text, r"  sh: main (waits for child|is ready)\n")
            if not to_group:  # else it may be about to end
                self.assertRegex(text, r"  sh#\d+: main computes\n      at ")
            self.assertNobodyIsLeft("mark-of-all")

    def test_end_a_loop_without_calls(self):
        program = self.compile("until.c", "-g")
        status, text, _ = self.run_and_send(signal.SIGTERM, [program, "ready spin"])
        self.assertEqual(status, -signal.SIGTERM, text)
        self.assertRegex(text, r"  main computes\n      at spin_until_set at \S*until\.c:\d+\n")

    def test_are_first_the_programs_own_if_it_handles_them(self):
        polite = self.program("def leave(*_):\n  os.write(2, b'leaving\\n'); os._exit(3)\n"
                              "signal.signal(signal.SIGTERM, leave)\n" + self.READY + "sys.stdin.read()")
        status, text, _ = self.run_and_send(signal.SIGTERM, polite)
        self.assertEqual(status, 3, text)
        self.assertIn("leaving\n", text)

    def test_end_a_program_that_handles_them_and_stays(self):
        stubborn = self.program("signal.signal(signal.SIGTERM, lambda *_: None)\n" + self.READY + "while True: sys.stdin.read()")
        status, text, _ = self.run_and_send(signal.SIGTERM, stubborn)
        self.assertEqual(status, -signal.SIGTERM, text)
        self.assertIn("main waits for descriptor 0 (outside)", text)

    def test_end_an_exploration(self):
        program = self.compile("until.c", "-g")
        words = [str(word) for word in (WAITPOINT, "explore", "--", program, "spin", "thread")]
        for sent in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=heed_signals) as running:
                await_handler(running, sent)
                time.sleep(1.5)
                running.send_signal(sent)
                output, text = running.communicate(timeout=60)
                self.assertEqual(running.returncode, 130, text)
                self.assertIn("; stopped by a signal\n", output)
                self.assertRegex(text + output, r"  main computes\n      at spin_until_set at \S*until\.c:\d+\n")

    def test_to_its_group_end_an_exploration_without_a_failure(self):
        program = self.compile("lost_update.c")
        words = [str(word) for word in (WAITPOINT, "explore", "--iterations", "1000000", "--", program, "locked")]
        for sent in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                                  preexec_fn=heed_signals) as running:
                await_handler(running, sent)
                time.sleep(0.5)
                os.killpg(running.pid, sent)
                output, text = running.communicate(timeout=60)
                self.assertEqual(running.returncode, 130, output + text)
                self.assertRegex(output, r"^lost_update: \d+ schedules, \d+ distinct, 0 failed, .*; stopped by a signal\n(\d+ pairs? of events in .*\n)?$")


class Loops(ExecCase):
    """Without calls, until another thread or a signal's handler sets a flag."""

    def run_until_set(self, program, by, *options):
        words = [str(word) for word in (WAITPOINT, "exec", *options, "--", program, "spin", by)]
        return subprocess.run(words, capture_output=True, text=True, timeout=100)

    def instrumented(self, name, *options):
        program = self.folder / name
        subprocess.run(["gcc", "-O1", "-g", "-pthread", HERE / "until.c", *options, "-o", program], check=True)
        return program

    def assertEnds(self, program, *options):
        for by in "handler", "thread":
            done = self.run_until_set(program, by, *options)
            self.assertEqual((done.returncode, done.stdout), (0, "1\n"), done.stderr)
            self.assertAlmostEqual(Summary(done.stderr).seconds, 1, places=1)
            self.assertEqual(Summary(done.stderr).digest, Summary(self.run_until_set(program, by, *options).stderr).digest)

    def test_end_where_accesses_to_memory_are_seen(self):
        if not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no runtime for -fsanitize=thread")
        program = self.instrumented("until-accesses", "-fsanitize=thread")
        self.assertEnds(program)
        words = [str(word) for word in (WAITPOINT, "explore", "--iterations", "5", "--", program, "spin", "handler")]
        done = subprocess.run(words, capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_end_where_basic_blocks_are_counted(self):
        library = self.folder / "libblocks.so"
        subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", library], text=True, check=True,
                       input="void __sanitizer_cov_trace_pc(void) {}")
        program = self.instrumented("until-blocks", "-fsanitize-coverage=trace-pc", library)
        self.assertEnds(program)
        self.assertEnds(program, "--clock", "counted:10")

    def test_are_named_where_nothing_is_seen(self):
        words = [str(word) for word in (WAITPOINT, "exec", "--", self.compile("until.c", "-g"), "spin", "thread")]
        with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as running:
            text = running.stderr.readline() + running.stderr.readline() + running.stderr.readline()
            running.terminate()
            running.communicate(timeout=60)
        self.assertRegex(text, r"waitpoint: thread 'main' has computed for \d+ s, at 0\.0+ s of virtual time, without a "
                               r"simulated call, at spin_until_set at \S*until\.c:\d+:\n")
        self.assertIn("-fsanitize=thread or -fsanitize-coverage=trace-pc", text)


if __name__ == "__main__":
    unittest.main()
