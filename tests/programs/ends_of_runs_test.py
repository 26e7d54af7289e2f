# SPDX-License-Identifier: BSD-3-Clause
"""Every way for a thread or a process to end, at each place and moment of a run: ends_of_runs_test.py BUILD."""

import concurrent.futures
import json
import pathlib
import signal
import tempfile

from deaths_test import OfMortalModules
from installed import main

# Each way for a thread or a process to end: the status, and the same if a thread of the operating system ends so
# (None: the thread alone ends). In a static destructor the statuses of calls are the run's.
ENDS = {
    "abort": -signal.SIGABRT, "assert": -signal.SIGABRT, "terminate": -signal.SIGABRT, "heap": -signal.SIGABRT,
    "fork and abort": -signal.SIGABRT, "throw in terminate": -signal.SIGABRT,
    "illegal": -signal.SIGILL, "division": -signal.SIGFPE, "address": -signal.SIGSEGV, "call": -signal.SIGSEGV,
    "default": -signal.SIGSEGV, "blocked address": -signal.SIGSEGV, "raise": -signal.SIGSEGV, "trap": -signal.SIGTRAP,
    "no signal stack": (-signal.SIGABRT, -signal.SIGSEGV),
    "alarm": -signal.SIGALRM, "pipe": -signal.SIGPIPE, "power": -signal.SIGPWR, "real-time signal": -signal.SIGRTMAX,
    "kill": -signal.SIGKILL, "raise SIGKILL": -signal.SIGKILL, "pthread_kill": -signal.SIGKILL, "tgkill": -signal.SIGKILL,
    "sigqueue": -signal.SIGKILL, "system call kill": -signal.SIGKILL,
    "exit": 1, "_exit": 1, "_Exit": 1, "quick_exit": 1, "exit_group": 1, "execl": 1, "execlp": 1, "execle": 1, "daemon": 1,
    "exit of the system": (1, None), "pthread_exit": (-signal.SIGABRT, None), "thrd_exit": (-signal.SIGABRT, None),
    "cancel itself": (-signal.SIGABRT, None), "cancel the run": -signal.SIGABRT,
    "throw a number": (1, -signal.SIGABRT), "exception": (1, -signal.SIGABRT), "throw at a copy": (1, -signal.SIGABRT),
    "throw in vain": (1, -signal.SIGSEGV),
}
# What ends the main thread in place of the process, and what needs a run, is no way to end after it.
NOT_STATIC = "exit of the system", "pthread_exit", "thrd_exit", "cancel itself", "cancel the run"


class Ends(OfMortalModules):
    """The table of all ends, at each place and moment: what is said, written and returned agree."""

    def end(self, way, place, *options):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.outputs))
        done = self.run_to_its_death(way, "--set", f"robots.0.modules.mortal.place={place}", "--summary", folder / "s.json",
                                     "--events", folder / "e", *options)
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["e", "s.json"], done.stderr)
        done.outcome = json.loads((folder / "s.json").read_text())["outcome"]
        done.events = (folder / "e").read_text()
        return done

    def each(self, place, ways, check, *options):
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            ended = {way: pool.submit(self.end, way, place, *options) for way in ways}
            for way, done in ended.items():
                with self.subTest(way=way, place=place, options=options):
                    check(way, done.result())

    def check_cut_off(self, done, status):
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("digest", done.stdout)
        self.assertEqual(done.outcome, "crashed")
        self.assertRegex(done.events, r"\n# cut off: .*\n$")
        self.assertRegex(done.stderr, r"waitpoint: (?!warning)")
        self.assertIn("\n  replay: ", done.stderr)

    def check_whole(self, done, status):
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stdout.count("  digest "), 1)
        self.assertEqual(done.outcome, "time limit")
        self.assertNotIn("cut off", done.events)

    def in_task(self, way):
        return ENDS[way][0] if isinstance(ENDS[way], tuple) else ENDS[way]

    def in_thread(self, way):
        return ENDS[way][1] if isinstance(ENDS[way], tuple) else ENDS[way]

    def test_in_a_task_cut_the_run_off(self):
        self.each("codel", ENDS, lambda way, done: self.check_cut_off(done, self.in_task(way)))

    def test_threads_cut_off_runs_of_any_length(self):
        # The shorter run ends while the death is reported. The copy that writes the outputs has a thread's corrupted heap.
        fatal = [way for way in ENDS if self.in_thread(way) is not None and way != "heap"]
        for until in "0.4", "1000000":
            self.each("thread", fatal, lambda way, done: self.check_cut_off(done, self.in_thread(way)), "--until", until)

    def test_threads_that_end_alone_leave_the_run_whole(self):
        alone = [way for way in ENDS if self.in_thread(way) is None]
        self.each("thread", alone, lambda way, done: self.check_whole(done, 0))

    def test_after_the_results_leave_them_whole(self):
        fatal = [way for way in ENDS if self.in_thread(way) is not None]
        self.each("thread of a destructor", fatal, lambda way, done: self.check_whole(done, self.in_thread(way)))

    def test_in_static_destructors_do_not_change_the_status_of_the_run(self):
        for place in "static destructor", "thread of a static destructor":
            ways = [way for way in ENDS if way not in NOT_STATIC and (way, place) != ("no signal stack", "static destructor")]
            self.each(place, ways, lambda way, done: self.check_whole(done, min(self.in_thread(way), 0) or 1),
                      "--set", "expect.goals_reached=1")


if __name__ == "__main__":
    main()
