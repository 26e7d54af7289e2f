# SPDX-License-Identifier: BSD-3-Clause
"""gdb sees the fibers, steps from event to event, and back: gdb_test.py BUILD.

Each session runs commands in gdb and checks the output of each. Exits with 77, skipped, if there is no gdb or if processes
must not be debugged.
"""

import functools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SCRIPT = ROOT / "tools/gdb/waitpoint-gdb.py"
CLEAN = {**os.environ, "DEBUGINFOD_URLS": "", "LC_ALL": "C"}
PLAIN = ["gdb", "-nx", "-batch", "-ex", f"source {SCRIPT}"]


@functools.lru_cache(maxsize=None)
def folder():
    made = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(made.cleanup)
    return pathlib.Path(made.name)


@functools.lru_cache(maxsize=None)
def compiled(name):
    """Compiles a program like a user: optimised, with debugging information, the library as an archive."""
    if not (folder() / "include").exists():
        (folder() / "include").mkdir()
        (folder() / "include/waitpoint").symlink_to(ROOT)
    compiler = os.environ.get("CXX", "g++").split()
    subprocess.run([*compiler, "-std=c++20", "-O2", "-g", HERE / name / f"{name}.cpp", f"-I{folder()}/include", f"-I{ROOT}",
                    BUILD / "libwaitpoint.a", "-lboost_context", "-o", folder() / name], check=True)
    return folder() / name


def session(commands, arguments, start=PLAIN, **environment):
    """The outputs of gdb for the commands, in order, each with the concurrent output of the process."""
    words = [*start, "-ex", "set pagination off", "-ex", "set width 0"]
    for number, command in enumerate(commands):
        words += ["-ex", f"echo @{number}@\\n", "-ex", command]
    words += ["-ex", "echo @end@\\n", *map(str, arguments)]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120,
                          cwd=folder(), env={**CLEAN, **environment})
    return [part.strip() for part in re.split(r"@(?:\d+|end)@\n", done.stdout)[1:-1]]


def of_clock_makers(*commands, arguments=()):
    return session(commands, ["--args", compiled("clock_makers"), *arguments])


def digest(text):
    return re.findall(r"wp1:[0-9a-f]{16}", text)[-1]


@functools.lru_cache(maxsize=None)
def plain_digest():
    return digest(subprocess.run([compiled("clock_makers")], capture_output=True, text=True, check=True).stdout)


class Looking(unittest.TestCase):
    TABLE = [
        ["No", "Name", "Robot", "Module", "Local time", "State", "Waits for"],
        ["1", "main", "environment", "-", "1.000000000", "ready", "sleep until 1.000000000 s"],
        ["*", "2", "master", "environment", "-", "0.001000000", "running"],
        ["3", "journeyman", "environment", "-", "0.000000000", "blocked",
         'lock mutex #1 "bench", held by master of environment'],
        ["4", "shop.keeper", "environment", "shop", "0.000000000", "blocked", 'wait condition variable #3 "bell"'],
        ["5", "apprentice", "environment", "-", "0.000000000", "blocked",
         'acquire semaphore #4 "springs", until 0.500000000 s'],
    ]

    def assert_table(self, text):
        self.assertEqual([re.split(r" {2,}", line.strip()) for line in text.splitlines()], self.TABLE)

    def assert_looks(self, told):
        """The outputs at 1 ms, equal in a process and in a core file."""
        info, time_told, fiber, trace, above, local, printed, apply_all, apply_one, bench, number, door = told
        self.assert_table(info)
        self.assertEqual(time_told, "0.001000000 s, event 11; master of environment is at 0.001000000 s")
        self.assertIn('Fiber 3, journeyman of environment, at 0.000000000 s, blocked: lock mutex #1 "bench", held by master',
                      fiber)
        self.assertRegex(fiber, r"#\d+ .*make_clock \(.*number=2")
        functions = " ".join(trace.splitlines())
        self.assertRegex(functions, r"waitpoint::kernel::block.*waitpoint::mutex::lock.*make_clock.*run_entry")
        self.assertNotRegex(trace, r"debugger_stop|corrupt|\?\?")
        self.assertRegex(above, r"^#\d+ ")
        self.assertIn("lock = ", local)
        self.assertTrue(printed.endswith("= 0"), printed)
        self.assertEqual(re.findall(r"^Fiber (\d), ([\w.]+) of", apply_all, re.MULTILINE),
                         [("1", "main"), ("2", "master"), ("3", "journeyman"), ("4", "shop.keeper"), ("5", "apprentice")])
        self.assertIn("wait_for_customer", apply_all)
        self.assertEqual(re.findall(r"^Fiber (\d)", apply_one, re.MULTILINE), ["4", "1"])
        self.assertRegex(apply_one, r"(?s)^Fiber 4[^\n]*\n#\d+ [^\n]*wait_for_customer", "the innermost frame is the user's")
        self.assertEqual(bench, 'mutex #1 "bench" of environment: held by master of environment\n'
                                "  journeyman of environment waits since 0.000000000 s (lock)")
        self.assertIn("shop.keeper of environment waits since 0.000000000 s (wait)", number)
        self.assertEqual(door, 'mutex #2 "door" of environment: not held\n  no waiters')

    COMMANDS = ["info fibers", "virtual-time", "fiber journeyman", "bt", "up", "fiber 4\ninfo locals",
                "print workshop.clocks", "fiber apply all bt", "fiber apply shop.keeper 1 bt 1", "blocked-on bench",
                "blocked-on condition variable#3", "blocked-on workshop.door"]

    def test_shows_parked_fibers_and_their_waits(self):
        commands = list(self.COMMANDS)
        commands[5:6] = ["fiber 4", "info locals"]
        told = of_clock_makers("break-time 0.001", "run", *commands, "delete", "continue")
        self.assert_looks(told[2:7] + told[8:-2])
        self.assertIn("event 11 at 0.001000000 s: master of environment: sleep", told[1])
        self.assertEqual(digest(told[-1]), plain_digest())

    def test_shows_the_same_of_a_core_file(self):
        core = folder() / "clock.core"
        told = of_clock_makers("break-time 0.001", "run", f"generate-core-file {core}", "continue")
        self.assertEqual(digest(told[-1]), plain_digest())
        self.assertLess(core.stat().st_size, 1e9)
        commands = list(self.COMMANDS)
        commands[5:6] = ["fiber 4", "info locals"]
        told = session([*commands, "next-event", "back"], [compiled("clock_makers"), core])
        core.unlink()
        self.assert_looks(told[:5] + told[6:-2])
        self.assertEqual(told[-2:], ["no process is being run: run or start it first"] * 2)

    def test_thousands_of_fibers_are_listed_in_a_moment(self):
        start = time.monotonic()
        table, clock = of_clock_makers("break-time 0.001", "run", "python import time; before = time.monotonic()",
                                       "info fibers", "python print(time.monotonic() - before)", arguments=["2000"])[3:]
        self.assertEqual(table.count("hand "), 2000)
        self.assertLess(float(clock), 10, f"of {time.monotonic() - start} s")

    def test_reports_bad_fibers_objects_times_and_processes(self):
        told = of_clock_makers("info fibers", "next-event", "back", "break-time soon", "break-time 0.001", "run",
                               "fiber 77", "fiber nobody", "blocked-on nothing", "blocked-on", "next-event-of nobody",
                               "next-event 0", "break-time 0.0005", "fiber apply all", "back 100", "fiber app")
        self.assertEqual(told[0], "no program is being run, and no core file is read")
        self.assertEqual(told[1:3], ["no process is being run: run or start it first"] * 2)
        self.assertIn("expected a time such as 12.5", told[3])
        for text, expected in zip(told[6:], ["there is no fiber '77'", "there is no fiber 'nobody'",
                                             "no task waits for, uses or holds an object 'nothing'", "expected: blocked-on",
                                             "there is no fiber 'nobody'", "expected: next-event [N]",
                                             "it is 0.001000000 s already", "expected: fiber apply", "there is no previous event",
                                             "there is no fiber 'app'"]):
            self.assertIn(expected, text)


    def test_the_innermost_frames_of_the_running_fiber_are_the_users_too(self):
        told = of_clock_makers("break-time 0.001", "run", "fiber apply all bt 1", "fiber apply all nosuch")
        self.assertRegex(told[2], r"(?s)Fiber 2, master [^\n]*, running\n#\d+ [^\n]*make_clock")
        self.assertIn('Undefined command: "nosuch"', told[3])
        self.assertNotIn("Python Exception", told[3])


class Stepping(unittest.TestCase):
    def test_goes_from_event_to_event_of_all_tasks_or_of_one(self):
        told = of_clock_makers("break-time 1ms", "break-time 500ms", "run", "next-event", "next-event 3",
                               "next-event-of shop.keeper", "virtual-time", "back 2", "continue")
        self.assertIn("0.001000000 s\nstop at the first event at or after 0.500000000 s", told[1])
        self.assertIn('event 12 at 0.001000000 s: master of environment: unlock mutex #1 "bench"', told[3])
        self.assertIn('event 15 at 0.001000000 s: journeyman of environment: resume mutex #1 "bench"', told[4])
        self.assertRegex(told[4], r"#\d+ .*make_clock")
        self.assertIn('event 20 at 0.500000000 s: apprentice of environment: timeout semaphore #4 "springs"', told[5])
        self.assertIn("event 18 at", told[7])
        self.assertEqual(digest(told[8]), plain_digest())

    def test_a_breakpoint_ends_a_step_and_a_step_in_a_parked_fiber_changes_nothing(self):
        told = of_clock_makers("break wait_for_customer", "run", "next-event-of main", "next", "fiber main", "next",
                               "fiber 1", "finish", "virtual-time", "delete", "continue")
        self.assertIn("wait_for_customer", told[1])
        self.assertIn("event ", told[2])
        self.assertEqual(digest(told[-1]), plain_digest())

    def test_stops_and_looks_at_every_event_change_no_digest(self):
        loop = """python exec("for i in range(37): gdb.execute('next-event'); gdb.execute('fiber apply all bt', to_string=True)")"""
        told = of_clock_makers("break-time 0", "run", loop, "virtual-time", "continue")
        self.assertEqual(re.findall(r"^event (\d+) at", told[2], re.MULTILINE), [str(event) for event in range(2, 39)])
        self.assertIn("1.000000000 s, event 38", told[3])
        self.assertEqual(digest(told[4]), plain_digest())


class Back(unittest.TestCase):
    def test_goes_to_the_event_before_over_jumps_of_time_and_forward_again(self):
        told = of_clock_makers("break-time 1", "run", "back", "virtual-time", "back", "back", "back", "info fibers",
                               "fiber apprentice", "back 2", "next-event 5", "next-event", "continue")
        self.assertIn("event 23 at 1.000000000 s: main of environment: sleep", told[1])
        self.assertIn("event 22 at 0.500000000 s: apprentice of environment: end\nits function has returned", told[2])
        self.assertEqual(told[3], "0.500000000 s, event 22; apprentice of environment is at 0.500000000 s")
        self.assertIn("event 19 at 0.002000000 s: journeyman of environment: end", told[6])
        self.assertIn("until 0.500000000 s", told[7])
        self.assertIn("try_acquire_for(500ms)", told[8])
        self.assertIn("event 17 at 0.002000000 s", told[9])
        self.assertIn("event 22 at 0.500000000 s: apprentice of environment: end", told[10])
        self.assertIn("event 23 at 1.000000000 s: main of environment: sleep", told[11])
        everything = "\n".join(told)
        self.assertEqual(everything.count("springs: no"), 2, "what a replay writes is thrown away")
        self.assertEqual(digest(told[12]), plain_digest())
        self.assertIn("exited normally", told[12])

    def test_goes_back_in_a_run_that_stops_at_every_event(self):
        told = of_clock_makers("break-time 0", "run", "next-event", "next-event", "back", "back", "virtual-time", "back",
                               "next-event", "continue")
        self.assertIn("event 2 at", told[4])
        self.assertIn("event 1 at", told[5])
        self.assertEqual(told[6].split(";")[0], "0.000000000 s, event 1")
        self.assertIn("there is no previous event", told[7])
        self.assertIn("event 2 at", told[8])
        self.assertEqual(digest(told[9]), plain_digest())

    def test_goes_to_the_beginning_of_the_event_from_within(self):
        told = of_clock_makers("break 'clock_makers.cpp':50", "run", "virtual-time", "back", "back", "continue",
                               "delete", "continue")
        event = int(re.search(r"event (\d+)", told[2])[1])
        self.assertIn(f"event {event} at", told[3])
        self.assertIn(f"event {event - 1} at", told[4])
        self.assertIn("Breakpoint 1", told[5])
        self.assertEqual(digest(told[-1]), plain_digest())

    def test_says_when_the_run_does_not_repeat(self):
        told = of_clock_makers("break-time 1ns", "run", "next-event", "back", arguments=["0", "restless"])
        self.assertIn("event 12", told[2])
        self.assertIn("this run does not repeat", told[3])


class Explored(unittest.TestCase):
    def test_a_failing_schedule_is_stepped_through(self):
        program = compiled("explored_letter")
        found = subprocess.run([program], capture_output=True, text=True, env=CLEAN, timeout=60)
        token = re.search(r"replay: WAITPOINT_REPLAY=(\S+)", found.stdout)[1]
        told = session(["break-time 0", "run", "next-event 3", "next-event-of postman", "info fibers", "back",
                        "fiber reader", "delete", "continue"], ["--args", program], WAITPOINT_REPLAY=token)
        self.assertRegex(told[1], r"event 1 at 0\.0+ s: main of environment: start\nits function has not begun")
        self.assertIn("event 4 at", told[2])
        at = int(re.search(r"event (\d+) at 0\.0+ s: postman of environment: ", told[3])[1])
        self.assertRegex(told[4], r"\n\* +3 +postman +environment")
        self.assertIn(f"event {at - 1} at", told[5])
        self.assertIn("Fiber 2, reader of environment, at 0.000000000 s, ", told[6])
        self.assertIn(f"WAITPOINT_REPLAY={token}", told[8])
        self.assertIn("deadlock at 0.000000000 s", told[8])

    def test_process_ended_by_the_debugger_is_no_finding(self):
        told = session(["break-time 0", "run", "next-event 3", "back", "kill", "shell sleep 0.3"],
                       ["--args", compiled("explored_letter")])
        self.assertIn("event 3 at", told[3])
        self.assertNotIn("the process ended", "".join(told))


class Office(unittest.TestCase):
    """A robot's modules in `waitpoint gdb`."""

    def test_is_stepped_through_and_keeps_its_digest(self):
        program, scenario = BUILD / "tools/waitpoint", ROOT / "scenarios/office.yaml"
        plain = subprocess.run([program, "run", scenario, "--until", "4"], capture_output=True, text=True, check=False)
        told = session(["break-time 3", "run", "info fibers", "next-event-of ndd.motion", "back", "virtual-time",
                        "fiber rackham/segloc.slam", "bt", "fiber apply all bt 3", "back 50000", "break-time 3.5",
                        "continue", "continue"], ["--", "run", scenario, "--until", "4"],
                       start=[program, "gdb", "-nx", "-batch"])
        self.assertIn("at 3.000000000 s: world of environment: sleep", told[1])
        self.assertRegex(told[2], r"ndd\.motion +rackham +ndd +2\.\d+ +blocked +timer_wait timer #\d+ \"task period\"")
        at = int(re.search(r"event (\d+) at 3\.\d+ s: ndd.motion of rackham", told[3])[1])
        self.assertIn(f"event {at - 1} at", told[4])
        self.assertIn(f", event {at - 1};", told[5])
        self.assertIn("segloc", told[7])
        self.assertEqual(len(re.findall(r"^Fiber ", told[8], re.MULTILINE)), 13)
        self.assertIn("there is no previous event", told[9])
        self.assertIn("at 3.500000000 s", told[11])
        self.assertEqual(digest(told[12]), digest(plain.stdout))

    def test_shows_the_tasks_of_every_level(self):
        told = session(["break-time 2", "run", "info fibers", "fiber script", "bt"],
                       ["--", "run", ROOT / "scenarios/laas.yaml"], start=[BUILD / "tools/waitpoint", "gdb", "-nx", "-batch"])
        names = [line.split()[1] for line in told[2].replace("*", " ").splitlines()[1:]]
        modules = [f"{module}.{task}" for module, task in
                   (("rflex", "motion"), ("sick", "scanning"), ("segloc", "slam"), ("pom", "fusing"), ("ndd", "motion"))]
        self.assertLessEqual({"plan", "tcl.control", "script", "control", *modules, "bridge", "world"}, set(names), told[2])
        self.assertRegex(told[4], r"(?s)TaskInterpreter::request.*Tcl_EvalEx.*TclExecutive::serve")

    def test_the_command_names_a_missing_part(self):
        def status(*words, **environment):
            done = subprocess.run([BUILD / "tools/waitpoint", "gdb", *words], capture_output=True, text=True,
                                  env={**CLEAN, **environment})
            self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1))
            return done.returncode, done.stderr

        self.assertEqual(status("--", "run", "x.yaml", PATH="/nonexistent"), (2, "waitpoint: gdb: gdb is not installed\n"))
        self.assertEqual(status("--", "./nothing"), (2, "waitpoint: gdb: there is no program './nothing'\n"))
        for words in ([], ["--"], ["run", "x.yaml"]):
            self.assertEqual(status(*words)[0], 2)
            self.assertIn("expected a command to run", status(*words)[1])


class Processes(unittest.TestCase):
    """A pipeline of a shell in `waitpoint gdb -- exec`."""

    SCRIPT = "for i in 1 2 3; do echo $i; sleep 1; done | while read n; do echo $n; done | cat"

    def of_pipeline(self, *commands):
        # Some releases of sleep add a nanosecond.
        return [re.sub(r"(?<=\d\.00000005)\d", "0", part) for part in self.of_program(["sh", "-c", self.SCRIPT], *commands)]

    def of_program(self, words, *commands):
        if not (BUILD / "libwaitpoint-exec.so").exists():
            self.skipTest("this build has no library for programs")
        return session(commands, ["--", "exec", "--", *words], start=[BUILD / "tools/waitpoint", "gdb", "-nx", "-batch"])

    @staticmethod
    def rows(table):
        return [re.split(r" {2,}", line.strip(" *")) for line in table.splitlines()]

    def test_fibers_of_all_are_listed(self):
        told = self.of_pipeline("break-time 0.5", "run", "info fibers", "virtual-time", "back", "continue")
        self.assertIn("event 6 at 3.000000050 s: main of sh: resume", told[1])
        self.assertEqual(self.rows(told[2]), [
            ["Process", "No", "Name", "Robot", "Module", "Local time", "State", "Waits for"],
            ["1000", "1", "main", "sh", "-", "3.000000050", "running"],
            ["1002", "1", "main", "sh#1002", "-", "3.000000050", "ready", "its turn: receive"],
            ["1003", "1", "main", "cat#1003", "-", "2.000000050", "blocked", "receive descriptor #1"]])
        self.assertRegex(told[2], r"\n\* +1000 ")
        self.assertIn("`waitpoint exec` has none", told[4])
        self.assertIn("exited normally", told[5])

    def test_the_programs_own_frames_are_selected(self):
        program = folder() / "ends"
        subprocess.run(["gcc", "-g", "-O1", "-pthread", ROOT / "tests/exec/ends.c", "-o", program], check=True)
        told = self.of_program([program, "deadlock"], "break-time 1", "run", "next-event", "fiber main", "process", "continue")
        self.assertRegex(told[1], r"#\d+ .* in end \(.*\n\d+\s+sleep\(2\);")
        self.assertRegex(told[2], r"lock mutex.*\n#\d+ .* in end \(")
        self.assertRegex(told[3], r"#\d+ .* in main \(.*\n\d+\s+sleep\(4\);")
        self.assertEqual(told[4], "the program has no other process")
        self.assertIn("deadlock at 4.000000000 s", told[5])

    def test_the_process_of_a_replay_is_followed(self):
        if not (BUILD / "libwaitpoint-exec.so").exists():
            self.skipTest("this build has no library for programs")
        program = folder() / "lost_update"
        subprocess.run(["gcc", "-g", "-O1", "-pthread", ROOT / "tests/exec/lost_update.c", "-o", program], check=True)
        found = subprocess.run([BUILD / "tools/waitpoint", "explore", "--", program], capture_output=True, text=True, timeout=120)
        words = shlex.split(re.findall(r"(?m)^replay: \S+ (explore .*)$", found.stdout)[-1])
        told = session(["break pay_in", "run", "info fibers", "delete", "continue"], ["--", *words],
                       start=[BUILD / "tools/waitpoint", "gdb", "-nx", "-batch"])
        self.assertRegex(told[1], r"Breakpoint 1, pay_in \(")
        self.assertIn("lost_update", told[2])
        self.assertIn("an update was lost", told[4])
        self.assertIn("exited with code 01", told[4])

    def test_another_process_is_looked_at(self):
        told = self.of_pipeline("break-time 0.5", "run", "process 1003", "fiber main", "bt", "info fibers", "process 7", "detach",
                                "process 1000", "virtual-time", "continue")
        self.assertIn("process 1003, cat#1003", told[2])
        self.assertIn("Fiber 1, main of cat#1003, at 2.000000050 s, blocked: receive descriptor #1", told[3])
        self.assertRegex(told[4], r"#\d+ (.* in )?read ?\((int|descriptor=)")
        self.assertEqual([row[0] for row in self.rows(told[5])[1:]], ["1000", "1002", "1003"])
        self.assertIn("there is no process '7'", told[6])
        self.assertIn("process 1000, sh", told[8])
        self.assertIn("3.000000050 s, event 6; main of sh", told[9])
        self.assertIn("exited normally", told[10])


def may_debug():
    done = subprocess.run([*PLAIN[:3], "-ex", "run", "--args", "true"], capture_output=True, text=True, env=CLEAN)
    return "exited normally" in done.stdout


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    if shutil.which("gdb") is None:
        print("gdb is not installed")
        sys.exit(77)
    if not may_debug():
        print("no process may be debugged here")
        sys.exit(77)
    unittest.main()
