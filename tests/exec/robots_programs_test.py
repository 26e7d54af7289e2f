# SPDX-License-Identifier: BSD-3-Clause
"""Programs of a robot: robots_programs_test.py BUILD [CLASS[.TEST]...].

The tests of Hosted are those of both back ends: processes, and copies of shared objects in the simulator's process. The
programs' sources are independent of waitpoint (several/).
"""

import ctypes.util
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"
PROGRAMS = BUILD / "tests/exec/several"
SCENARIO = pathlib.Path(__file__).resolve().parents[2] / "scenarios/office.yaml"
CHAIN = [[PROGRAMS / "writer.so", 1, 10], [PROGRAMS / "filter.so", 1, 2], [PROGRAMS / "reader.so", 2]]


TWO_ROBOTS = """
format: 1
name: two
until_s: 2
world: {{shapes: [{{corners_m: [0, 0, 1, 1]}}]}}
robot_types: {{include: {types}}}
{medium}
robots:
  - {{name: ada, type: rackham, start: [5, 5, 0], programs: [{{name: sender, file: {file}, arguments: [{sends}, {port}]}}]}}
  - {{name: bea, type: rackham, start: [9, 5, 0], programs: [{{name: receiver, file: {file}, arguments: [{receives}, {port}]}}]}}
"""


class Links(unittest.TestCase):
    """Messages between the programs of two robots."""

    def heard(self, program, medium, *options, sends="send", receives="receive"):
        port = random.randrange(20000, 60000)
        with tempfile.TemporaryDirectory() as folder:
            scenario = pathlib.Path(folder) / "two.yaml"
            scenario.write_text(TWO_ROBOTS.format(types=SCENARIO.parent / "rackham.yaml", medium=medium, port=port,
                                                  file=PROGRAMS / program, sends=sends, receives=receives))
            run = subprocess.run([WAITPOINT, "run", scenario, *options], capture_output=True, text=True, timeout=60)
            self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
            return [line for line in run.stdout.splitlines() if line.startswith(("number ", "record ", "bulk ", "end "))]

    def test_datagrams_take_the_time_of_the_medium(self):
        at_once = self.heard("datagrams.so", "")
        self.assertEqual(at_once, [f"number {i} after 0 ms" for i in range(10)])
        delayed = self.heard("datagrams.so", "medium: {latency_ms: 7}")
        self.assertEqual(delayed, [f"number {i} after 7 ms" for i in range(10)])

    def test_datagrams_are_lost_as_the_medium_says_and_the_seed_draws(self):
        medium = "medium: {latency_ms: [2, 6], loss: 0.5}"
        runs = [self.heard("datagrams.so", medium, "--seed", seed) for seed in ("1", "1", "2")]
        self.assertTrue(0 < len(runs[0]) < 10, runs[0])
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])

    def test_streams_take_the_time_of_the_medium_and_lose_nothing(self):
        def expected(ms):
            return [*(f"record {i} after {ms} ms" for i in range(5)), "bulk of 1000000 bytes", f"end 5 after {ms} ms"]

        self.assertEqual(self.heard("streams.so", ""), expected(0))
        self.assertEqual(self.heard("streams.so", "medium: {latency_ms: 7}"), expected(7))
        self.assertEqual(self.heard("streams.so", "medium: {latency_ms: 7, loss: 0.9}"), expected(7))

    def test_streams_go_both_ways_and_arrive_after_their_sender_has_ended(self):
        said = self.heard("streams.so", "medium: {latency_ms: 7}", sends="leave", receives="meet")
        self.assertEqual(said, [*(f"record {i} after 7 ms" for i in range(3)), "end 2 after 7 ms"])

    def test_streams_take_the_time_that_their_bytes_are_on_the_air(self):
        slow = self.heard("streams.so", "medium: {latency_ms: 1, bandwidth_bit_s: 12800}")
        self.assertEqual(slow[:5], [f"record {i} after 11 ms" for i in range(5)])


PROGRAMS_OF_ROBOT = "[" + ", ".join(
    f"{{name: {path.stem}, file: {path}, arguments: {arguments}}}" for path, *arguments in CHAIN) + "]"


def office(command, *words, programs=PROGRAMS_OF_ROBOT, hosting=None, env=None, folder=None):
    """The office's robot with programs, for some seconds."""
    hosted = ["--set", f"hosting={hosting}"] if hosting else []
    return subprocess.run([WAITPOINT, command, SCENARIO, *words, "--set", f"robots.rackham.programs={programs}", *hosted,
                           "--set", "expect={}"], capture_output=True, text=True, timeout=240, env=env, cwd=folder)


def program(name, file, *arguments):
    return f"{{name: {name}, file: {PROGRAMS / file}, arguments: {json.dumps([str(word) for word in arguments])}}}"


def digest_of_summary(run):
    return re.search(r"digest +(wp1:[0-9a-f]{16})", run.stdout).group(1)


class Hosted:
    """What programs do however they are hosted: in each class below, by its back end."""

    hosting = None

    def office(self, *words, **options):
        return office(*words, hosting=self.hosting, **options)

    def test_programs_repeat_and_end_with_their_statuses(self):
        runs = [self.office("run", "--until", "5") for _ in range(2)]
        for run in runs:
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("LINE 2 AT 0.2 S\n", run.stdout)
            self.assertIn("5 lines\n", run.stdout)
            for program, status in ("writer", 0), ("filter", 0), ("reader", 5):
                self.assertIn(f"  rackham: program {program} ended with exit status {status}\n", run.stdout)
            self.assertEqual(digest_of_summary(run), digest_of_summary(runs[0]))
        alone = office("run", "--until", "5", programs="[]")
        self.assertNotIn("program", alone.stdout)
        self.assertNotEqual(digest_of_summary(runs[0]), digest_of_summary(alone))

    def test_missing_program_is_bad_input(self):
        run = self.office("run", programs="[{name: one, file: nowhere.so}]")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertRegex(run.stderr, "^waitpoint: --set .*: there is no program '.*nowhere.so'")
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_conditions_order_the_starts(self):
        chain = PROGRAMS_OF_ROBOT.replace(", arguments: [1, 10]", ", arguments: [1, 10], after: [reader.started]")
        run = self.office("run", "--until", "5", programs=chain)
        self.assertIn("LINE 10 AT 1.0 S\n5 lines\n", run.stdout, run.stderr)

    def test_schedules_of_them_are_explored(self):
        run = self.office("explore", "--until", "2", "--iterations", "4")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        again = self.office("explore", "--until", "2", "--iterations", "4")
        last = [re.sub(r"[0-9.]+ (s|schedules/s|a second)", "", r.stdout.splitlines()[-1]) for r in (run, again)]
        self.assertEqual(last[0], last[1])

    def test_sem_undo_releases_at_the_end_of_a_program(self):
        holders = ", ".join(f"{{name: h{i}, file: {PROGRAMS / 'holder.so'}, arguments: [5]}}" for i in range(3))
        run = self.office("run", "--until", "5", programs=f"[{holders}]")
        self.assertEqual(run.stdout.count("ended with exit status 0\n"), 3, run.stdout)

    def test_a_run_with_them_checks_itself(self):
        run = self.office("run", "--until", "1", "--verify")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("the same run, twice in this process and once in a perturbed one", run.stdout)

    def test_a_program_that_does_not_end_is_left_where_it_is(self):
        run = self.office("run", "--until", "0.5")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("  rackham: program writer was running to the end\n", run.stdout)

    def test_each_has_the_libraries_that_it_is_linked_to_for_itself(self):
        own = subprocess.run([PROGRAMS / "linked-program", "x", "3"], capture_output=True, text=True)
        self.assertEqual(own.stdout, "x: lower upper program, 3 4 7 7 1, 7\n" + self.DESTROYED.format(3, 4))
        run = self.office("run", "--until", "1", programs=f"[{program('a', 'linked.so', 'a', 3)}, {{name: b, file: linked.so, arguments: [b, 5]}}]",
                     folder=PROGRAMS)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("a: lower upper program, 3 4 7 7 1, 7\n" + self.DESTROYED.format(3, 4), run.stdout)
        self.assertIn("b: lower upper program, 5 6 11 11 1, 7\n" + self.DESTROYED.format(5, 6), run.stdout)

    def test_each_opens_its_own_libraries_and_plugins(self):
        def expected(name, count):
            return f"{name}: lower plugin noted, {count} {count} {count + 1}\nplugin destroyed at {count}\nlower destroyed at {count}\n"

        own = subprocess.run([PROGRAMS / "opening-program", "x", "3"], capture_output=True, text=True)
        self.assertEqual(own.stdout, expected("x", 3))
        run = self.office("run", "--until", "1", programs=f"[{program('a', 'opening.so', 'a', 3)}, {program('b', 'opening.so', 'b', 5)}]")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(expected("a", 3), run.stdout)
        self.assertIn(expected("b", 5), run.stdout)

    DESTROYED = "program destroyed\nupper destroyed at {}\nlower destroyed at {}\n"

    def test_each_run_begins_with_fresh_globals(self):
        run = self.office("run", "--until", "0.1", "--verify", programs=f"[{program('a', 'again.so')}]")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout.count("begun 1 and 1 times\n"), 3, run.stdout)

    def test_each_can_use_openmp(self):
        programs = ", ".join(program(name, "sum.so", name) for name in ("a", "b"))
        run = self.office("run", "--until", "0.1", programs=f"[{programs}]")
        self.assertEqual(sorted(line for line in run.stdout.splitlines() if "sum" in line), ["a: sum 4950", "b: sum 4950"])

    def test_each_has_its_handlers_and_timers(self):
        programs = [program(name, "handlers.so", name, ms) for name, ms in (("a", 100), ("b", 200))]
        programs += [program("c", "handlers.so", "c", "user"), program("d", "handlers.so", "d", "pipe")]
        programs += [program(name, "ticks.so") for name in ("e", "f")]
        runs = [self.office("run", "--until", "1.1", programs=f"[{', '.join(programs)}]") for _ in range(2)]
        run = runs[0]
        self.assertEqual(run.returncode, 0, run.stderr)
        for line in "a: 10, 1 held, 5 10 10\n", "b: 20, 1 held, 10 20 20\n", "100 ticks\n100 ticks\n":
            self.assertIn(line, run.stdout)
        statuses = re.findall(r"program (\w) ended with exit status (\d+)", run.stdout)
        self.assertEqual(statuses, [("a", "0"), ("b", "0"), ("c", "138"), ("d", "141"), ("e", "0"), ("f", "0")])
        self.assertEqual(digest_of_summary(runs[0]), digest_of_summary(runs[1]))

    def test_each_has_its_environment(self):
        env = {**os.environ, "GIVEN": "yes"}
        own = subprocess.run([PROGRAMS / "environment-program", "x"], capture_output=True, text=True, env=env)
        self.assertIn("x: set x x, put by x by x, given none\n", own.stdout)
        programs = ", ".join(program(name, "environment.so", name) for name in ("a", "b"))
        run = self.office("run", "--until", "1", programs=f"[{programs}]", env=env)
        for name in "a", "b":
            said = [line for line in run.stdout.splitlines() if line.startswith(f"{name}: ")]
            self.assertEqual(said, re.sub(r"\bx\b", name, own.stdout).splitlines(), run.stderr)

    def test_each_has_its_working_directory(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in "a", "b":
                os.mkdir(f"{folder}/{name}")
            programs = ", ".join(program(name, "directory.so", name, f"{folder}/{name}") for name in ("a", "b"))
            run = self.office("run", "--until", "1", "--events", "events", programs=f"[{programs}]", folder=folder)
            self.assertEqual(run.returncode, 0, run.stderr)
            for name in "a", "b":
                self.assertIn(f"{name} is in {folder}/{name}\n", run.stdout)
                self.assertIn(f"{name} is in /\n", run.stdout)
                self.assertEqual(pathlib.Path(f"{folder}/{name}/mark").read_text(), f"{name}\n" * 6)
            self.assertEqual(sorted(os.listdir(folder)), ["a", "b", "events"])


class InProcess(Hosted, unittest.TestCase):
    """Copies of shared objects in the simulator's process: their threads are tasks of the robot."""

    hosting = "in-process"

    def test_their_threads_are_tasks_of_it(self):
        with tempfile.TemporaryDirectory() as folder:
            events = pathlib.Path(folder) / "events"
            run = self.office("run", "--until", "5", "--events", events)
            self.assertEqual(run.returncode, 0, run.stderr)
            tasks = {line.split()[2] for line in events.read_text().splitlines() if "writer:" in line}
            self.assertTrue(tasks, "no event of a program")

    def test_the_shipped_example_runs_as_described(self):
        with tempfile.TemporaryDirectory() as folder:
            scenarios = shutil.copytree(SCENARIO.parent, pathlib.Path(folder) / "scenarios")
            lines = (scenarios / "office-programs.yaml").read_text().splitlines()
            command = next(line for line in lines if " cc " in line).lstrip("# ")
            subprocess.run(command, shell=True, check=True, cwd=folder)
            run = subprocess.run([WAITPOINT, "run", scenarios / "office-programs.yaml"], capture_output=True, text=True,
                                 timeout=60)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertIn("LINE 10 AT 1.0 S\n5 lines\n", run.stdout)

    def test_the_run_is_the_same_with_another_allocator(self):
        library = ctypes.util.find_library("jemalloc")
        if library is None:
            self.skipTest("there is no jemalloc here")
        preloaded = {**os.environ, "LD_PRELOAD": library}
        told = subprocess.run(["cat", "/proc/self/maps"], capture_output=True, text=True, env=preloaded)
        self.assertIn("jemalloc", told.stdout)
        run = office("run", "--until", "1", env=preloaded)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(digest_of_summary(run), digest_of_summary(office("run", "--until", "1")))

    def test_events_are_written_into_a_pipe(self):
        run = office("run", "--until", "1.5", "--events", "/dev/stdout")
        self.assertRegex(run.stdout, r"rackham +writer: main")
        self.assertNotIn("  digest ", run.stdout)  # the text has the error stream then
        self.assertIn(digest_of_summary(office("run", "--until", "1.5")), run.stderr)

    def test_a_debugger_finds_their_symbols_and_those_of_their_libraries(self):
        if shutil.which("gdb") is None:
            self.skipTest("gdb is not installed")
        words = ["-q", "-batch", "-ex", "set breakpoint pending on", "-ex", "break count_in_lower", "-ex", "run", "-ex", "bt 4"]
        run = subprocess.run(["gdb", *words, "--args", WAITPOINT, "run", SCENARIO, "--until", "0.1", "--set",
                              f"robots.rackham.programs=[{program('a', 'linked.so', 'a', 1)}]"],
                             capture_output=True, text=True, timeout=60)
        self.assertRegex(run.stdout, r"count_in_upper \(\) at \S+/upper.cpp:\d+\n(.*\n)*.* main \(.*\) at \S+/linked.cpp:\d+\n",
                         run.stderr)

    def test_unloadable_program_is_bad_input(self):
        for file, line in ("nowhere.so", "there is no program '.*nowhere.so': No such file or directory"), \
                          (__file__, r".*robots_programs_test.py is no shared object for x86-64"), \
                          (PROGRAMS / "executable", r".*executable is an executable: build it with -shared -fPIC"), \
                          (PROGRAMS / "without-main.so", r".*without-main.so has no main\(\) that others see"):
            run = office("run", programs=f"[{{name: one, file: {file}}}]")
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, f"^waitpoint: --set .*: {line}\n$")
        with tempfile.TemporaryDirectory() as folder:
            for name in "linked.so", "libupper.so":
                shutil.copy(PROGRAMS / name, folder)
            # Meson's runner names the folders of all libraries.
            env = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
            run = office("run", programs=f"[{{name: one, file: {folder}/linked.so}}]", env=env)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, r"^waitpoint: --set .*: \S+/linked.so cannot be loaded: liblower.so: cannot open shared "
                                         r"object file: No such file or directory\n$")
        run = office("run", programs=f"[{{name: one, command: [{PROGRAMS / 'executable'}]}}]", hosting="in-process")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertRegex(run.stderr, r"executable is an executable: build it with -shared -fPIC\n$")
        run = office("check", programs="[]", hosting="threads")
        self.assertEqual(run.returncode, 2)
        self.assertRegex(run.stderr, r"^waitpoint: --set hosting=threads: .*processes.*in-process")
        run = office("check", programs="[{name: one}]")
        self.assertEqual(run.returncode, 2)
        self.assertIn("expected key 'file' in a program", run.stderr)


class AsProcesses(Hosted, unittest.TestCase):
    """The same shared objects, each a process."""

    hosting = "processes"

    def test_events_are_not_of_threads(self):
        run = self.office("run", "--until", "1.5", "--events", "/dev/stdout")
        self.assertNotIn("writer: main", run.stdout)


def command(name, *words):
    return f"{{name: {name}, command: {json.dumps([str(word) for word in words])}}}"


class Commands(unittest.TestCase):
    """Programs of a robot that are processes, with all that they start."""

    SCRIPT = "for i in 1 2 3; do date +%T; sleep 1; done | while read line; do echo it is $line; done; exit 4"

    def test_a_script_runs_in_the_time_of_the_robot(self):
        runs = [office("run", "--until", "5", programs=f"[{command('clock', 'sh', '-c', self.SCRIPT)}]") for _ in range(3)]
        for run in runs:
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(run.stderr, "")
            self.assertIn("it is 00:00:00\nit is 00:00:01\nit is 00:00:02\n", run.stdout)
            self.assertIn("  rackham: program clock ended with exit status 4\n", run.stdout)
            self.assertEqual(digest_of_summary(run), digest_of_summary(runs[0]))
        alone = office("run", "--until", "5", programs="[]")
        self.assertNotEqual(digest_of_summary(runs[0]), digest_of_summary(alone))

    def test_several_share_the_objects_of_processes(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = f"{folder}/pipe"
            os.mkfifo(pipe)
            programs = [command("reader", "sh", "-c", f"read word < {pipe}; echo heard $word at $(date +%S)"),
                        command("writer", "sh", "-c", f"sleep 2; echo hello > {pipe}")]
            for _ in range(2):
                run = office("run", "--until", "5", programs=f"[{', '.join(programs)}]")
                self.assertIn("heard hello at 02\n", run.stdout, run.stderr)
                self.assertIn("program writer ended with exit status 0\n", run.stdout)

    def test_conditions_order_their_starts(self):
        def waiting(text, after):
            return f"{text[:-1]}, after: {json.dumps(after)}}}"

        with tempfile.TemporaryDirectory() as folder:
            file = f"{folder}/there"
            programs = [command("a", "sh", "-c", "sleep 1; echo first"), waiting(command("b", "echo", "second"), ["a"]),
                        waiting(command("c", "sh", "-c", f"sleep 0.5; echo third > {file}"), ["b.started", "a"]),
                        waiting(command("d", "cat", file), [file])]
            for _ in range(2):
                run = office("run", "--until", "5", programs=f"[{', '.join(programs)}]")
                self.assertIn("first\nsecond\nthird\n", run.stdout, run.stderr)
                os.remove(file)
        for after, line in ((["nobody"], "after: the robot has no program 'nobody'"),
                            (["one"], "'one' can never start: the conditions in after form a cycle"),
                            (["tcp:x"], "expected NAME, NAME.started, tcp:PORT or a path with a '/' in after, got 'tcp:x'")):
            run = office("run", programs=f"[{waiting(command('one', 'true'), after)}]")
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, f"^waitpoint: --set .*: {line}\n$")

    def test_running_programs_are_left_and_deaths_are_reported(self):
        programs = [command("long", "sleep", "100"), command("dies", "sh", "-c", "kill -9 $$"),
                    command("crashes", "sh", "-c", "sleep 1; kill -SEGV $$")]
        run = office("run", "--until", "3", programs=f"[{', '.join(programs)}]")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("program long was running to the end\n", run.stdout)
        self.assertIn("program dies ended with exit status 137\n", run.stdout)
        self.assertIn("program crashes ended with exit status 139\n", run.stdout)

    def test_a_run_with_them_checks_itself_and_is_explored(self):
        programs = f"[{command('clock', 'sh', '-c', self.SCRIPT)}]"
        run = office("run", "--until", "2", "--verify", programs=programs)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        run = office("explore", "--until", "2", "--iterations", "3", programs=programs)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_unstartable_program_is_bad_input(self):
        for programs, line in ((command("one", "./nowhere"), "there is no program '.*nowhere'"),
                               (command("one", "no-such-program"), "there is no program 'no-such-program'"),
                               ("{name: one, command: []}", "expected a program in the command, got none"),
                               ("{name: one, command: [ls], file: a.so}",
                                "expected a file with arguments, or a command, in a program, got both"),
                               (command("one", "true") + ", " + PROGRAMS_OF_ROBOT[1:-1],
                                "expected programs of one kind in a scenario, shared objects or commands, got both")):
            run = office("run", programs=f"[{programs}]")
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertRegex(run.stderr, f"^waitpoint: --set .*: {line}\n$")


if __name__ == "__main__":
    unittest.main(verbosity=1)
