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
    "lock": (r"misuse: a task locks a mutex of the system, such as std::mutex, that a task holds already: no task can run", "",
             -signal.SIGABRT),
    "heap": (r"the process dies of SIGABRT \(abort\(\) was called\)", "free_twice", -signal.SIGABRT),
    "exit": (r"exit\(\) is called in a task", "", 1),
    "_exit": (r"_exit\(\) is called in a task", "", 1),
    "quick_exit": (r"quick_exit\(\) is called in a task", "", 1),
    "exit_group": (r"the system call exit\(\) is called in a task", "", 1),
    "execl": (r"execve\(\) is called in a task", "", 1),
    "execlp": (r"execvpe\(\) is called in a task", "", 1),
    "execle": (r"execve\(\) is called in a task", "", 1),
    "daemon": (r"daemon\(\) is called in a task", "", 1),
    "pthread_exit": (r"misuse: a task calls pthread_exit\(\), which ends the thread that runs all tasks", "", -signal.SIGABRT),
    "alarm": (r"the process dies of SIGALRM \(the process sent it itself\)", "", -signal.SIGALRM),
    "default": (r"the process dies of SIGSEGV \(a bad address\)", "write_nowhere", -signal.SIGSEGV),
    "call": (r"the process dies of SIGSEGV \(a bad address\)", "call_nothing", -signal.SIGSEGV),
    "raise": (r"the process dies of SIGSEGV \(the process sent it itself\)", "", -signal.SIGSEGV),
    "trap": (r"the process dies of SIGTRAP \(the process sent it itself\)", "", -signal.SIGTRAP),
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

    def start(self, way, *options):
        return subprocess.Popen(self.command(way, *options), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

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
                 "--record": "r.log", "--journal": "j", "--record-durations": "c"}
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
                for name in "t.tum", "t.estimated.tum", "t.odometry.tum", "d", "e", "r.log", "j", "c":
                    self.assertRegex((self.outputs / name).read_text(), r"(^|\n)# cut off: .*\n$")
                self.assertIn(" doomed mortal.main ", (self.outputs / "e").read_text())
                self.assertEqual(len(list(self.outputs.iterdir())), 10)

    def test_keep_recordings_that_end_with_a_message(self):
        for kind, end in ("mcap", b"\x89MCAP0\r\n"), ("bag", b""):
            file = self.outputs / f"r.{kind}"
            died = self.run_to_its_death("address", "--record", file)
            if "without rosbag_storage" in died.stderr:
                continue
            self.assertIn("the outputs up to here are kept, marked as cut off", died.stderr)
            content = file.read_bytes()
            self.assertIn(b"cut off: the process dies of SIGSEGV (a bad address)", content)
            self.assertTrue(content.endswith(end))
            if kind == "bag":
                # The place of the index in the file's header: 0 in a bag that was not closed.
                place = int.from_bytes(content[content.index(b"index_pos=") + 10:][:8], "little")
                self.assertTrue(0 < place < len(content))
        self.assertFalse([path for path in self.outputs.iterdir() if path.suffix not in (".mcap", ".bag")])

    def test_leave_a_journal_and_a_record_of_durations_that_repeat_them(self):
        journal, durations = self.outputs / "j", self.outputs / "c"
        command = self.command("address", "--interactive", "--journal", journal, "--record-durations", durations)
        died = subprocess.run(command, input="run 0.1\nmove doomed 1 2\nrun\n", capture_output=True, text=True, timeout=120)
        place = re.compile("  at virtual time .*")
        self.assertIn("at 0.100000000 move doomed 1 2\n# cut off: the process dies of SIGSEGV", journal.read_text())
        again = self.run_to_its_death("address", "--replay-journal", journal)
        self.assertEqual(again.returncode, -signal.SIGSEGV)
        self.assertTrue(again.stderr.startswith("waitpoint: the journal has no end: its run was cut off: the process dies of SIGSEGV "
                                                "(a bad address)\n"), again.stderr)
        self.assertEqual(place.findall(again.stderr), place.findall(died.stderr))
        again = self.run_to_its_death("address", "--replay-journal", journal, "--replay-durations", durations)
        self.assertEqual(place.findall(again.stderr), place.findall(died.stderr))

    def test_by_an_exception_keep_the_outputs_and_name_the_replay(self):
        for way, what in ("exception", "out of the codel"), ("throw a number", "an exception of unknown type"):
            with self.subTest(way=way):
                files = {name: self.outputs / f"{way} {name}" for name in ("--journal", "--events", "--summary")}
                failed = self.run_to_its_death(way, *(word for option in files.items() for word in option))
                self.assertEqual(failed.returncode, 1)
                self.assertRegex(failed.stderr, r"^waitpoint: the run failed: an exception escaped from task mortal\.main of doomed at "
                                                rf"0\.300000000 s, in a permanent codel of main: {what}\n  replay: .*deaths run .*\n"
                                                r"  the outputs up to here are kept, marked as cut off\n$")
                self.assertRegex(files["--journal"].read_text(), rf"\n# cut off: .*{what}\n$")
                self.assertRegex(files["--events"].read_text(), rf"\n# cut off: .*{what}\n$")
                self.assertEqual(json.loads(files["--summary"].read_text())["outcome"], "crashed")

    def test_by_an_exception_end_a_series_of_seeds(self):
        command = [word for word in self.command("exception", "--seeds", "3..5") if word not in ("--seed", "7")]
        failed = subprocess.run(command, capture_output=True, text=True, timeout=120)
        self.assertEqual(failed.returncode, 1)
        self.assertRegex(failed.stderr, r"^waitpoint: the run failed: .*\n  replay: .*deaths run .* --seed 3 .*\n$")

    def test_in_a_thread_of_the_operating_system_name_no_task(self):
        died = self.run_to_its_death("die in a thread")
        self.assertEqual(died.returncode, -signal.SIGSEGV)
        self.assertRegex(died.stderr, r"(?m)^waitpoint: the process dies of SIGSEGV \(a bad address\), in a thread of the operating "
                                      r"system\n  replay: .*\n  .*write_nowhere.* at .*deaths\.cpp:\d+$")
        self.assertNotIn("at virtual time", died.stderr)
        self.assertRegex(died.stderr, r"warning: task mortal\.main of doomed calls pthread_create\(\) at 0\.300000000 s")

    def test_by_exit_in_a_thread_are_refused(self):
        left = self.run_to_its_death("exit in a thread", "--events", self.outputs / "e")
        self.assertEqual(left.returncode, 1)
        self.assertRegex(left.stderr, r"^waitpoint: exit\(\) is called before the end of the run, in a thread of the operating system\n"
                                      r"  replay: .*deaths run .*\n")
        self.assertRegex((self.outputs / "e").read_text(), r"\n# cut off: exit\(\) is called")

    def test_by_a_signal_of_another_process_have_a_last_word(self):
        for sent in signal.SIGQUIT, signal.SIGABRT, signal.SIGXCPU:
            target = self.outputs / sent.name
            process = self.start("loop", "--events", target)
            time.sleep(1)
            process.send_signal(sent)
            said = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, -sent)
            self.assertRegex(said, rf"^waitpoint: the process dies of {sent.name} \(another process sent it\)\n{PLACE}  .*spin")
            self.assertRegex(target.read_text(), r"\n# cut off: ")

    def test_deaths_of_constructors_and_destructors_name_module_and_robot(self):
        replay = r"\n  replay: .*deaths run .* --seed 7 --set 'robots\.0\.modules\.mortal\.end=.*'\n"
        for way, what in ("constructor throws", ": no such device"), ("constructor throws a number", " of unknown type"):
            threw = self.run_to_its_death(way)
            self.assertEqual(threw.returncode, 1)
            self.assertRegex(threw.stderr, "^waitpoint: the run failed: constructing module mortal of robot doomed threw an exception"
                                           f"{what}{replay}$")
        for way, doing in ("constructor crashes", "constructing"), ("destructor crashes", "destroying"):
            died = self.run_to_its_death(way)
            self.assertEqual(died.returncode, -signal.SIGSEGV)
            self.assertRegex(died.stderr, r"(?m)^waitpoint: the process dies of SIGSEGV \(a bad address\)\n"
                                          rf"  while {doing} module mortal of robot doomed{replay}  .*write_nowhere")
        left = self.run_to_its_death("constructor exits")
        self.assertEqual(left.returncode, 1)
        self.assertRegex(left.stderr, r"^waitpoint: exit\(\) is called in a module\n"
                                      rf"  while constructing module mortal of robot doomed{replay}")


class SystemCalls(OfMortalModules):
    """Threads, processes and waits of the operating system in a codel: the run goes on, but names them."""

    EFFECTS = {
        "thread": ("pthread_create", "it runs in real time, and the run is not repeatable"),
        "fork": ("fork", "it runs in real time, and the run is not repeatable"),
        "system": ("system", "it runs in real time, and the run is not repeatable"),
        "vfork": ("vfork", "it runs in real time, and the run is not repeatable"),
        "timed": ("pthread_mutex_(timed|clock)lock", "it holds up all tasks of the run in real time"),
        "sleep": ("(clock_)?nanosleep", "it holds up all tasks of the run in real time"),
    }

    def test_are_named_with_file_and_line(self):
        for way, (function, effect) in self.EFFECTS.items():
            for check in [], ["--verify"]:
                with self.subTest(way=way, check=check):
                    done = self.run_to_its_death(way, *check)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertRegex(done.stderr, rf"(?m)^waitpoint: warning: task mortal\.main of doomed calls {function}\(\) at "
                                                  rf"0\.300000000 s: {effect}\n(    at .*\n)*    at .*deaths\.cpp:\d+$")

    def test_in_a_constructor_are_named(self):
        done = self.run_to_its_death("constructor forks")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"(?m)^waitpoint: warning: constructing module mortal of robot doomed calls fork\(\): "
                                      r"it runs in real time, and the run is not repeatable\n(    at .*\n)*    at .*deaths\.cpp:\d+$")

    def test_forked_copies_leave_the_outputs_to_the_run(self):
        names = {"--picture": "p.svg", "--trajectory": "t.tum", "--digests": "d", "--events": "e", "--record": "r.log",
                 "--journal": "j", "--summary": "s.json"}
        contents = {}
        for way, line in (("none", ""), ("fork returns", "a process that a task forked returned into the run: it ends here"),
                          ("fork crashes", r"the process dies of SIGSEGV \(a bad address\)")):
            with self.subTest(way=way):
                folder = self.outputs / way
                folder.mkdir()
                done = self.run_to_its_death(way, *(word for option, name in names.items() for word in (option, folder / name)))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(len(re.findall(rf"(?m)^waitpoint: {line}$", done.stderr)), 1 if line else 0, done.stderr)
                self.assertNotIn("outputs up to here", done.stderr)
                self.assertEqual(done.stdout.count("  digest "), 1)
                self.assertNotEqual(json.loads((folder / "s.json").read_text())["outcome"], "crashed")
                contents[way] = {path.name: path.read_bytes() for path in folder.iterdir() if path.name not in ("s.json", "j")}
                self.assertEqual(len(contents[way]), 7)
                self.assertEqual(contents[way], contents["none"])

    def test_before_the_run_are_named(self):
        os.environ["EARLY_THREAD"] = "1"
        self.addCleanup(os.environ.pop, "EARLY_THREAD")
        for check in [], ["--verify"]:
            done = self.run_to_its_death("none", *check)
            self.assertEqual(done.returncode, 0)
            self.assertRegex(done.stderr, r"(?m)^waitpoint: warning: a thread of the operating system was started outside of tasks; "
                                          r"it is not repeatable\n    at .*EarlyThread.*deaths\.cpp:\d+$")


class Explored(OfMortalModules):
    """`waitpoint explore` has the same eyes."""

    def explore(self, way, *options):
        words = self.command(way, "--iterations", "5", *options)
        return subprocess.run([words[0], "explore", *words[2:]], capture_output=True, text=True, timeout=120)

    def test_threads_and_processes_are_failures(self):
        for way, function in ("thread", "pthread_create"), ("fork", "fork"):
            found = self.explore(way)
            self.assertEqual(found.returncode, 1, found.stderr)
            self.assertRegex(found.stdout, r"^the default order.* failed at 0\.400000000 s: a task starts a thread or process of the "
                                           rf"operating system, .*\nwaitpoint: warning: task mortal\.main of doomed calls {function}"
                                           r"\(\) at 0\.300000000 s: .*\n(    at .*\n)*    at .*deaths\.cpp:\d+\n")

    def test_sleeps_are_named_once(self):
        found = self.explore("sleep")
        self.assertEqual(found.returncode, 0, found.stdout)
        self.assertEqual(len(re.findall(r"(?m)^waitpoint: warning: task .* calls .*nanosleep\(\) at 0\.300000000 s", found.stderr)), 1)

    def test_crashes_have_their_last_word(self):
        found = self.explore("address")
        self.assertEqual(found.returncode, 1)
        self.assertRegex(found.stdout, r"killed by .*\nwaitpoint: the process dies of SIGSEGV \(a bad address\)\n  at virtual time 0\.3")


class Waits(OfMortalModules):
    """A codel that waits without a timeout, while others go on."""

    WAIT = (r'  task mortal\.main of doomed waits \(wait\) for condition variable #\d+ "data ready", since 0\.300000000 s, '
            r"in a permanent codel of main\n(      at .*\n)*?      at .*wait_for_a_lost_notification.* at .*deaths\.cpp:\d+\n")

    def test_are_listed_at_the_end(self):
        done = self.run_to_its_death("lost", "--idle", "1", "--summary", self.outputs / "s.json")
        self.assertRegex(done.stdout, "waiting without a timeout:\n" + self.WAIT)
        self.assertRegex(json.loads((self.outputs / "s.json").read_text())["waiting"], '"data ready"')
        for options in ["--idle", "1.8"], ["--idle", "0"], []:
            self.assertNotIn("waiting", self.run_to_its_death("lost", *options).stdout)

    def test_are_listed_on_request(self):
        asked = subprocess.run(self.command("lost", "--interactive"), input="run 1\nidle 0.5\nidle\nidle x\nquit\n",
                               capture_output=True, text=True, timeout=60)
        self.assertRegex(asked.stdout, self.WAIT)
        self.assertIn("  none\n", asked.stdout)
        self.assertIn("expected seconds, found 'x'", asked.stderr)


class Hangs(OfMortalModules):
    """A codel that reaches no waitpoint."""

    def test_are_reported_and_ended(self):
        for way, function in ("loop", "spin"), ("block", "deaths.cpp"):
            with self.subTest(way=way):
                ended = self.run_to_its_death(way, "--watchdog", "1", "--summary", self.outputs / f"{way}.json")
                self.assertEqual(ended.returncode, 1)
                self.assertRegex(ended.stderr, rf"(?m)^waitpoint: no event for 1 s: .*\n{PLACE}")
                self.assertRegex(ended.stderr, rf"(?m)^waitpoint: no event for 6 s: the run is ended\n{PLACE}")
                self.assertIn(function, ended.stderr)
                self.assertEqual(json.loads((self.outputs / f"{way}.json").read_text())["outcome"], "crashed")

    def test_are_ended_by_a_signal_at_once(self):
        for way, sent in ("loop", signal.SIGTERM), ("loop", signal.SIGINT), ("blocked", signal.SIGTERM):
            process = self.start(way)
            time.sleep(1.5)
            process.send_signal(sent)
            began = time.monotonic()
            said = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 130)
            self.assertRegex(said, rf"(?m)^waitpoint: the run is interrupted while a task .*\n{PLACE}")
            self.assertLess(time.monotonic() - began, 30)

    def test_signal_ends_a_blocked_constructor_at_once(self):
        process = self.start("constructor spins")
        time.sleep(1.5)
        process.send_signal(signal.SIGHUP)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130)
        self.assertRegex(said, r"^waitpoint: the run is interrupted while a module's constructor or destructor runs\n"
                               r"  while constructing module mortal of robot doomed\n  replay: .*\n  .*spin")

    def test_leave_nothing_behind_for_ever(self):
        """kill -9: the next run that writes there removes the leftover, but not the file of one that still runs."""
        for option, name in ("--events", "e"), ("--journal", "j"), ("--record", "r.mcap"), ("--record", "r.bag"):
            folder = self.outputs / name
            folder.mkdir()
            target = folder / name
            process = subprocess.Popen(self.command("loop", option, target), stderr=subprocess.DEVNULL)
            while not (found := list(folder.iterdir())) and process.poll() is None:
                time.sleep(0.05)
            if not found:  # built without rosbag_storage
                continue
            os.utime(found[0], (time.time() - 60,) * 2)
            self.run_to_its_death("none", option, target)
            self.assertIn(found[0], list(folder.iterdir()))
            process.kill()
            process.wait()
            os.utime(found[0], (time.time() - 60,) * 2)
            self.run_to_its_death("none", option, target)
            self.assertEqual(list(folder.iterdir()), [target])


if __name__ == "__main__":
    main()
