# SPDX-License-Identifier: BSD-3-Clause
"""Every way in which a module can end or hold up the process leaves a last word and the outputs: deaths_test.py BUILD."""

import json
import os
import re
import signal
import subprocess
import time

from installed import HERE, Installed, flags, main

# The way: reason, the function in the call stack, and the status (negative: a signal's).
DEATHS = {
    "abort": (r"the process dies of SIGABRT \(abort\(\) was called\)", "", -signal.SIGABRT),
    "assert": (r"the process dies of SIGABRT \(abort\(\) was called\)", "fail_an_assertion", -signal.SIGABRT),
    "terminate": (r"the process dies of SIGABRT \(abort\(\) was called\)", "throw_out_of_noexcept", -signal.SIGABRT),
    "illegal": (r"the process dies of SIGILL \(an illegal instruction\)", "", -signal.SIGILL),
    "division": (r"the process dies of SIGFPE \(integer division by zero\)", "divide", -signal.SIGFPE),
    "address": (r"the process dies of SIGSEGV \(a bad address\)", "write_nowhere", -signal.SIGSEGV),
    "heap": (r"the process dies of SIGABRT \(abort\(\) was called\)", "free_twice", -signal.SIGABRT),
    "exit": (r"exit\(\) is called in a task", "", 1),
    "_exit": (r"_exit\(\) is called in a task", "", 1),
}
PLACE = r"""  at virtual time 0\.300000000 s, in task mortal\.main of doomed, at its event \d+ \(\w+\), seed 7
  in a permanent codel of main
  replay: .*deaths run .*
"""


class OfMortalModules(Installed):
    def setUp(self):
        self.program = self.compile("deaths", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        self.outputs = self.folder / self.id().rpartition(".")[2]
        self.outputs.mkdir()

    def command(self, way, *options):
        return [self.program, "run", HERE / "deaths/deaths.yaml", "--seed", "7", "--set", f"robots.0.modules.mortal.end={way}",
                *options]

    def run_to_its_death(self, way, *options):
        return subprocess.run(self.command(way, *options), capture_output=True, text=True, errors="replace", timeout=120)


class Deaths(OfMortalModules):
    def test_have_a_last_word(self):
        for way, (reason, function, status) in DEATHS.items():
            with self.subTest(way=way):
                died = self.run_to_its_death(way)
                self.assertRegex(died.stderr, rf"(?m)^waitpoint: {reason}\n{PLACE}")
                self.assertEqual(died.stderr.count("at virtual time"), 1, died.stderr)
                self.assertRegex(died.stderr, rf"(?m)^  .*{function}.* at .*deaths\.cpp:\d+$")
                self.assertEqual(died.returncode, status, died.stderr)

    def test_keep_the_outputs_marked_as_cut_off(self):
        names = {"--summary": "s.json", "--picture": "p.svg", "--trajectory": "t.tum", "--digests": "d", "--events": "e",
                 "--record": "r.log"}
        options = [word for option, name in names.items() for word in (option, self.outputs / name)]
        for way in "address", "heap", "_exit":
            with self.subTest(way=way):
                for old in self.outputs.iterdir():
                    old.unlink()
                died = self.run_to_its_death(way, *options)
                self.assertIn("the outputs up to here are kept, marked as cut off", died.stderr)
                summary = json.loads((self.outputs / "s.json").read_text())
                self.assertEqual(summary["outcome"], "crashed")
                self.assertRegex(summary["crash"], DEATHS[way][0])
                self.assertAlmostEqual(summary["simulated_s"], 0.3, places=9)
                self.assertIn("<!-- cut off: ", (self.outputs / "p.svg").read_text())
                for name in "t.tum", "t.estimated.tum", "t.odometry.tum", "d", "e", "r.log":
                    self.assertRegex((self.outputs / name).read_text(), r"(^|\n)# cut off: .*\n$")
                self.assertIn(" doomed mortal.main ", (self.outputs / "e").read_text())
                self.assertEqual(len(list(self.outputs.iterdir())), 8)

    def test_of_a_constructor_or_destructor_name_module_and_robot(self):
        threw = self.run_to_its_death("constructor throws")
        self.assertEqual(threw.returncode, 1)
        self.assertEqual(threw.stderr, "waitpoint: the run failed: constructing module mortal of robot doomed threw an exception: "
                                       "no such device\n")
        for way, doing in ("constructor crashes", "constructing"), ("destructor crashes", "destroying"):
            died = self.run_to_its_death(way)
            self.assertEqual(died.returncode, -signal.SIGSEGV)
            self.assertRegex(died.stderr, r"(?m)^waitpoint: the process dies of SIGSEGV \(a bad address\)\n"
                                          rf"  while {doing} module mortal of robot doomed$")
            self.assertIn("write_nowhere", died.stderr)


class Hangs(OfMortalModules):
    """A codel that reaches no waitpoint."""

    def test_are_reported_and_ended(self):
        for way, function in ("loop", "spin"), ("lock", "deaths.cpp"):
            with self.subTest(way=way):
                ended = self.run_to_its_death(way, "--watchdog", "1", "--summary", self.outputs / f"{way}.json")
                self.assertEqual(ended.returncode, 1)
                self.assertRegex(ended.stderr, rf"(?m)^waitpoint: no event for 1 s: .*\n{PLACE}")
                self.assertRegex(ended.stderr, rf"(?m)^waitpoint: no event for 6 s: the run is ended\n{PLACE}")
                self.assertIn(function, ended.stderr)
                self.assertEqual(json.loads((self.outputs / f"{way}.json").read_text())["outcome"], "crashed")

    def test_are_ended_by_a_signal_at_once(self):
        for sent in signal.SIGTERM, signal.SIGINT:
            process = subprocess.Popen(self.command("loop"), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            time.sleep(1.5)
            process.send_signal(sent)
            began = time.monotonic()
            said = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 130)
            self.assertRegex(said, rf"(?m)^waitpoint: the run is interrupted while a task .*\n{PLACE}")
            self.assertLess(time.monotonic() - began, 30)

    def test_leave_nothing_behind_for_ever(self):
        """kill -9: the next run that writes there removes the leftover, but not the file of one that still runs."""
        target = self.outputs / "e"
        process = subprocess.Popen(self.command("loop", "--events", target), stderr=subprocess.DEVNULL)
        while not (found := list(self.outputs.iterdir())):
            time.sleep(0.05)
        os.utime(found[0], (time.time() - 60,) * 2)
        self.run_to_its_death("none", "--events", target)
        self.assertIn(found[0], list(self.outputs.iterdir()))
        process.kill()
        process.wait()
        os.utime(found[0], (time.time() - 60,) * 2)
        self.run_to_its_death("none", "--events", target)
        self.assertEqual(list(self.outputs.iterdir()), [target])


if __name__ == "__main__":
    main()
