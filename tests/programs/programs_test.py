# SPDX-License-Identifier: BSD-3-Clause
"""What users build outside the tree works against the installed library: programs_test.py BUILD.

Installs the build folder into a temporary place and compiles the programs beside this file with the flags of pkg-config
alone.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def run(*command, **options):
    """Runs a command that must succeed; returns its standard output."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def flags(prefix, *arguments):
    """What pkg-config answers; the packages of the installed library say that they lie in `prefix`."""
    folders = os.pathsep.join(str(path.parent) for path in prefix.rglob("*.pc"))
    environment = {**os.environ, "PKG_CONFIG_PATH": folders}
    return run("pkg-config", f"--define-variable=prefix={prefix}", *arguments, env=environment).split()


class Installed(unittest.TestCase):
    """Installs once for all; what is compiled is compiled once too."""

    @classmethod
    def setUpClass(cls):
        if hasattr(Installed, "folder"):
            return
        folder = tempfile.TemporaryDirectory()
        unittest.addModuleCleanup(folder.cleanup)
        Installed.folder = pathlib.Path(folder.name)
        run("meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", cls.folder / "root")
        Installed.prefix = next((cls.folder / "root").rglob("include/waitpoint")).parents[1]

    def compile(self, name, *more, program=None):
        """Compiles NAME/NAME.cpp with the given flags, in a folder outside the tree; returns the program."""
        program = self.folder / (program or name)
        if not program.exists():
            compiler = os.environ.get("CXX", "g++").split()
            run(*compiler, "-std=c++20", "-O1", "-g", HERE / name / f"{name}.cpp", "-o", program, *more, cwd=self.folder)
        return program


class Headers(Installed):
    def test_they_need_neither_the_tree_nor_other_libraries(self):
        # Real threads take the place of the simulated ones: never both.
        headers = sorted(path.relative_to(self.prefix / "include") for path in self.prefix.rglob("*.hpp")
                         if not path.name.startswith("real_"))
        self.assertGreater(len(headers), 50)
        text = "".join(f"#include <{header}>\n" for header in headers)
        source = self.folder / "all.cpp"
        source.write_text(text)
        run("g++", "-std=c++20", "-fsyntax-only", *flags(self.prefix, "--cflags", "waitpoint-robots"), source)
        self.assertFalse(re.search(r"<(Eigen|fcl|yaml-cpp|nlohmann|CLI)/", "".join(path.read_text() for path in
                                   self.prefix.rglob("*.hpp"))), "a header asks for a library that users need not have")

    def test_the_tree_lacks_no_header(self):
        for source in HERE.parents[1].rglob("*.hpp"):
            tree = source.relative_to(HERE.parents[1])
            if tree.parts[0] in ("core", "fibers", "modules", "tools", "world"):
                self.assertTrue((self.prefix / "include/waitpoint" / tree).exists(), f"{tree} is in no list of headers")


class Blinker(Installed):
    """Modules of one's own, in a robot that has no others, no base and no goals."""

    def test_runs_its_scenario_and_repeats(self):
        program = self.compile("blinker", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"))
        outputs = [run(program, "run", HERE / "blinker/blinker.yaml", "--events", self.folder / "events") for _ in range(2)]
        lines = outputs[0].splitlines()
        self.assertEqual([line.split(": ")[1] for line in lines if "the lamp is" in line], ["the lamp is on", "the lamp is off"] * 3)
        self.assertIn("final reply: ok", outputs[0])
        digests = [re.findall(r"wp1:[0-9a-f]{16}", output) for output in outputs]
        self.assertTrue(digests[0])
        self.assertEqual(digests[0], digests[1])
        self.assertIn(digests[0][-1], (HERE.parents[1] / "README.md").read_text(), "the README shows another digest")
        self.assertIn("lighthouse", (self.folder / "events").read_text())

        other = run(program, "run", HERE / "blinker/blinker.yaml", "--set", "robots.0.modules.watchman.flashes=1")
        self.assertEqual(other.count("the lamp is on"), 1)
        self.assertNotEqual(re.findall(r"wp1:[0-9a-f]{16}", other), digests[0])

        wrong = subprocess.run([program, "run", HERE / "blinker/blinker.yaml", "--set", "robots.0.modules.watchman.flashs=1"],
                               capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("did you mean 'flashes'?", wrong.stderr)

    def test_stands_beside_the_papers_modules(self):
        scenario = self.prefix / "share/waitpoint/scenarios/office.yaml"
        program = self.compile("blinker", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"))
        mixed = self.folder / "mixed.yaml"
        mixed.write_text(f"""
format: 1
name: mixed
until_s: 3
world: {{include: {scenario.parent}/office-floor.yaml}}
robot_types: {{include: {scenario.parent}/rackham.yaml}}
robots:
  - {{name: rackham, type: rackham, start: [20, 4, 90], goals: [[22.4, 6.6]], modules: [{{name: blinker}}, {{name: watchman}}]}}
""")
        self.assertEqual(run(program, "run", mixed, "--until", "3").count("the lamp is on"), 3)

    def test_the_same_source_runs_on_the_threads_of_the_system(self):
        needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots-native")
        program = self.compile("blinker", *needed, program="blinker_native")
        output = run(program, "run", HERE / "blinker/blinker.yaml", timeout=60)
        seen = [line.split(": ")[1] for line in output.splitlines() if "the lamp is" in line]
        self.assertEqual(seen[:2], ["the lamp is on", "the lamp is off"])
        self.assertIn("on real threads", output)

    def test_code_for_one_kind_of_threads_is_not_linked_with_the_other(self):
        mixed = [flag for flag in flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots-native")
                 if flag != "-DWAITPOINT_REAL_THREADS"]
        with self.assertRaisesRegex(AssertionError, "threads::simulated"):
            self.compile("blinker", *mixed, program="blinker_mixed")


class TwoRobots(Installed):
    """Robots that talk to each other over the medium of their scenario."""

    def outcome(self, *options):
        program = self.compile("two_robots", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"))
        output = run(program, "run", HERE / "two_robots/two_robots.yaml", *options)
        # (time, who, what, positions, log entries), and the digest of the run
        told = re.findall(r"^ *([\d.]+) s  (\w+) (.*) \((\d+) positions, (\d+) log entries\)$", output, re.MULTILINE)
        return told, re.findall(r"wp1:[0-9a-f]{16}", output)[-1]

    def test_lose_sight_of_each_other_and_no_letter(self):
        told, digest = self.outcome()
        self.assertEqual([(who, what) for _, who, what, _, _ in told],
                         [("bea", "hears ada"), ("ada", "hears bea"), ("bea", "has lost ada"), ("ada", "has lost bea"),
                          ("bea", "hears ada"), ("ada", "hears bea")])
        for _, _, what, positions, entries in told[2:]:
            # In 20 s and 5 positions a second some are lost; the log waits out of range, and then it is all there.
            self.assertLess(int(positions), 90)
            self.assertEqual(int(entries), 34 if what.startswith("hears") else 18)
        self.assertEqual(self.outcome()[1], digest)
        document = (HERE.parents[1] / "docs/communication.md").read_text()
        self.assertIn(digest, document, "docs/communication.md shows another digest")

    def test_the_medium_is_the_scenarios_to_say(self):
        told, digest = self.outcome("--set", "medium.loss=0")
        self.assertEqual([positions for _, _, what, positions, _ in told if "lost" in what], ["91", "91"])
        self.assertNotEqual(digest, self.outcome()[1])
        self.assertEqual(self.outcome("--set", "medium.loss=1")[0], [])
        self.assertEqual([what for _, _, what, _, _ in self.outcome("--set", "medium=")[0]], ["cannot send: no route"] * 2)


class LatePom(Installed):
    """A module with a mistake that only other schedules show; `waitpoint explore` finds it."""

    def explore(self, *options):
        program = self.compile("late_pom", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"))
        return subprocess.run([program, "explore", HERE / "late_pom/late_pom.yaml", "--until", "15", *options],
                              capture_output=True, text=True, timeout=300)

    def test_is_found_minimised_explained_and_replayed(self):
        schedule = self.folder / "schedule"
        found = self.explore("--jobs", "2", "--schedule", schedule)
        self.assertEqual(found.returncode, 1, found.stdout + found.stderr)
        self.assertIn("expected at most 0.06 m", found.stdout)
        self.assertRegex(found.stdout, r"(?m)^1 switch away from the default order fails")
        self.assertRegex(found.stdout, r"could still have passed: number \d+, at [\d.]+ s: ")
        digest = re.search(r"(?m)^digest: (\S+)", found.stdout).group(1)
        for record in [re.search(r"--replay (wx1\S+)", found.stdout).group(1), schedule]:
            replayed = self.explore("--replay", record)
            self.assertEqual(replayed.returncode, 1)
            self.assertIn("the same run", replayed.stdout, replayed.stderr)
        self.assertIn(digest, replayed.stdout)

    def test_is_stepped_through_in_gdb(self):
        if shutil.which("gdb") is None or "exited normally" not in self.gdb("-ex", "run", "--", "true"):
            self.skipTest("no process may be debugged here")
        found = self.explore("--jobs", "2").stdout
        words = shlex.split(re.search(r"(?m)^replay: (.*)$", found).group(1))
        failed_s = float(re.search(r"failed at ([\d.]+) s", found).group(1))
        told = self.gdb("-ex", f"break-time {failed_s - 0.2}", "-ex", "run", "-ex", "next-event-of pom.fusing",
                        "-ex", "info fibers", "-ex", "back", "-ex", "tbreak Pom<true>::fuse", "-ex", "continue",
                        "-ex", "delete", "-ex", "continue", "--", *words)
        at = int(re.search(r"event (\d+) at [\d.]+ s: pom.fusing of rackham: resume timer", told).group(1))
        self.assertIn(f"event {at - 1} at", told)
        self.assertRegex(told, r"\n\* +\d+ +pom.fusing +rackham")
        self.assertIn("Pom<true>::fuse", told)
        self.assertIn("failed: position error of ", told)
        self.assertIn(re.search(r"(?m)^digest: (\S+)", found).group(1), told)

    def gdb(self, *words):
        done = subprocess.run([BUILD / "tools/waitpoint", "gdb", "-nx", "-batch", "-ex", "set pagination off", *words],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120,
                              env={**os.environ, "DEBUGINFOD_URLS": "", "LC_ALL": "C"})
        return done.stdout

    def test_its_mended_twin_passes(self):
        passed = self.explore("--jobs", "2", "--iterations", "40", "--set", "robots.0.modules.pom.type=mended_pom")
        self.assertEqual(passed.returncode, 0, passed.stdout + passed.stderr)


class Unrepeatable(Installed):
    """Whatever a module takes from outside the simulation, a self-check finds it and names the first event that differs."""

    SECOND, PERTURBED = "the second run in this process", "the run in a perturbed process"

    def check(self, source, *more, **surroundings):
        program = self.compile("unrepeatable", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"),
                               "-pthread")
        entries = self.folder / "entries"  # more than fit into one page, or into one reading
        if not entries.exists():
            entries.mkdir()
            for number in range(1000):
                (entries / f"entry {number}").touch()
        command = [program, "run", HERE / "unrepeatable/unrepeatable.yaml", "--check", "--set",
                   f"robots.0.modules.unrepeatable.source={source}", *more]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=entries,
                              env={**os.environ, **surroundings})
        return done.returncode, done.stdout + done.stderr

    def assert_caught(self, source, *runs):
        """Found by one of the runs, at the event after the value was given to the poster."""
        status, output = self.check(source)
        self.assertEqual(status, 1, output)
        told = re.fullmatch(r"""unrepeatable, seed 1: not the same run: (?P<run>.*) parts from the first
  event             (?P<number>\d+)
  was               (?P<was>[0-9.]+ s, robot gambler, task unrepeatable\.main: \w+.*), digest (?P<digest>[0-9a-f]{16})
  is                (?P<is>.*), digest (?P<other>[0-9a-f]{16})
  differs in        the values that the robot gave since its event before
  event before      [0-9.]+ s, robot gambler, task unrepeatable\.main: .*
(?P<threads>(?:  OS thread         .*
)*)  replay            waitpoint run .*unrepeatable.yaml --seed 1 --set 'robots.0.modules.unrepeatable.source=\w+' --check
""", output)
        self.assertIsNotNone(told, output)
        self.assertIn(told["run"], runs)
        self.assertEqual(told["was"], told["is"])
        self.assertNotEqual(told["digest"], told["other"])
        return told

    def test_a_run_that_repeats_is_said_to_repeat(self):
        status, output = self.check("none")
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"""\Aunrepeatable, seed 1: the same run, twice in this process and once in a perturbed one
  events            \d+, each compared with its robot's digest
  digest            wp1:[0-9a-f]{16}
\Z""")

    def test_the_wall_clock_is_caught(self):
        self.assert_caught("wall_clock", self.PERTURBED)

    def test_rdtsc_is_caught(self):
        self.assert_caught("rdtsc", self.SECOND)

    def test_getrandom_is_caught(self):
        self.assert_caught("getrandom", self.SECOND)

    def test_a_pointer_ordered_set_is_caught(self):
        self.assert_caught("pointer_order", self.SECOND, self.PERTURBED)

    def test_hash_order_is_caught(self):
        self.assert_caught("hash_order", self.SECOND, self.PERTURBED)

    def test_uninitialised_memory_is_caught(self):
        self.assert_caught("uninitialised", self.SECOND, self.PERTURBED)

    def test_uninitialised_memory_of_a_stack_is_caught(self):
        self.assert_caught("uninitialised_stack", self.SECOND, self.PERTURBED)

    def test_a_static_that_survives_a_run_is_caught(self):
        self.assert_caught("static", self.SECOND)

    def test_getpid_is_caught(self):
        self.assert_caught("getpid", self.PERTURBED)

    def test_directory_order_is_caught(self):
        self.assert_caught("directory_order", self.PERTURBED)

    def test_a_heap_address_is_caught(self):
        self.assert_caught("heap_address", self.SECOND, self.PERTURBED)

    def test_a_hidden_thread_of_the_system_is_caught_and_named(self):
        self.assertIn("OS thread         'hidden'", self.assert_caught("hidden_thread", self.SECOND)["threads"])

    def test_an_environment_variable_is_caught(self):
        self.assert_caught("environment", self.PERTURBED)

    def assert_cut_off(self, how, source, **surroundings):
        """The process ended, or was ended, in the first period: the event that it did not come to is named."""
        status, output = self.check(source, **surroundings)
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"not the same run: the run in a perturbed process parts from the first\n"
                                 r"  event             \d+\n  was               0\.\d+ s, robot gambler, task .*\n"
                                 rf"  is                no event: {how}\n  differs in        whether there is such an event\n"
                                 r"  event before      0\.\d+ s, robot gambler, task unrepeatable\.main: ")

    def test_a_perturbed_process_that_dies_is_told_with_the_event_it_did_not_come_to(self):
        self.assert_cut_off(r"the process was ended by signal 4 \(Illegal instruction\)", "crash")

    def test_a_perturbed_process_is_not_waited_for_without_end(self):
        self.assert_cut_off("the process had not ended after 2 s and was stopped", "endless_loop", WAITPOINT_TIME_LIMIT="2")

    def test_a_run_that_fails_in_one_process_only_is_told(self):
        status, output = self.check("exception")
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"not the same run: the run in a perturbed process parts from the first\n  event +\d+\n"
                                 r"  was  +0\.1\d+ s, robot gambler, .*\n  is   +0\.1\d+ s, robot gambler, ")

    def test_where_addresses_are_not_at_random_they_are_in_the_perturbed_process(self):
        program = self.compile("unrepeatable", *flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint-robots"),
                               "-pthread")
        done = subprocess.run(["setarch", "-R", program, "run", HERE / "unrepeatable/unrepeatable.yaml", "--check"],
                              capture_output=True, text=True, timeout=120)
        if "setarch" in done.stderr:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("not perturbed", done.stdout)


class LostLetter(Installed):
    """Tests of one's own threads need neither world nor modules."""

    def test_finds_the_lost_letter(self):
        needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint")
        self.assertFalse([flag for flag in needed if re.search("fcl|ccd|eigen|yaml|png|fmt|robots", flag.lower())], needed)
        program = self.compile("lost_letter", *needed, "-lgtest", "-lgtest_main")
        done = subprocess.run([program], capture_output=True, text=True, env={**os.environ, "GTEST_COLOR": "no"})
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("[       OK ] Letter.ArrivesInTheDefaultOrder", done.stdout)
        self.assertIn("[  FAILED  ] Letter.ArrivesInEverySchedule", done.stdout)
        self.assertIn("[       OK ] MendedLetter.ArrivesInEverySchedule", done.stdout)
        report = re.search(r"schedule \d+ of strategy portfolio, seed 1 failed: (deadlock at .*)", done.stdout, re.DOTALL)
        self.assertIsNotNone(report, done.stdout)
        self.assertIn('"bell"', report[1])
        self.assertIn("lost_letter.cpp:", report[1])

        # The line that the report prints repeats the run.
        line = re.search(r"replay: (WAITPOINT_REPLAY=\S+ .*)", report[1])[1]
        again = subprocess.run(["sh", "-c", line], capture_output=True, text=True)
        self.assertIn("the replayed schedule failed: deadlock at ", again.stdout)

    def test_a_process_that_dies_says_how_to_repeat_it(self):
        needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint")
        program = self.compile("sudden_death", *needed)
        for signal in "6", "9", "11":
            # The supervisor has the pipe open until it has told.
            done = subprocess.run([program, signal], capture_output=True, text=True)
            self.assertEqual(done.returncode, -int(signal), done.stderr)
            line = re.search(r"replay: (WAITPOINT_REPLAY=\S+ \S+)", done.stderr)
            self.assertIsNotNone(line, done.stderr)
            again = subprocess.run(["sh", "-c", f"{line[1]} {signal}"], capture_output=True, text=True)
            self.assertIn(again.returncode, (-int(signal), 128 + int(signal)), again.stderr)


class SharedCounter(Installed):
    """The installed library is not instrumented; a program built with a sanitizer is, and its threads are seen as such."""

    def outcome(self, sanitizer, how):
        program = self.folder / sanitizer
        if not program.exists():
            needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint")
            run("g++", "-std=c++20", "-O1", "-g", f"-fsanitize={sanitizer}", HERE / "shared_counter/shared_counter.cpp", "-o",
                program, *needed, cwd=self.folder)
        done = subprocess.run([program, how], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def test_thread_sanitizer_finds_the_race_of_two_simulated_threads(self):
        self.assertEqual(self.outcome("thread", "locked"), (0, "counted to 6\n"))
        status, output = self.outcome("thread", "unlocked")
        self.assertEqual(status, 66, output)
        self.assertRegex(output, r"data race.*\n.*by thread T\d+")
        for name in ["one", "two"]:
            self.assertRegex(output, rf"Thread T\d+ '{name}'")

    def test_address_sanitizer_knows_the_stacks_of_simulated_threads(self):
        self.assertEqual(self.outcome("address", "locked"), (0, "counted to 6\n"))
        status, output = self.outcome("address", "beyond")
        self.assertNotEqual(status, 0)
        self.assertIn("stack-buffer-overflow", output)


class RacyCounter(Installed):
    """Races are found in what one command compiles and links: the flags are those of the library's own compiler."""

    def outcome(self, *arguments):
        if not list(self.prefix.rglob("waitpoint-races.pc")):
            self.skipTest("the library waitpoint-races is not built")
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint-races")
        done = subprocess.run([self.compile("racy_counter", *needed), *arguments], capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    def test_a_race_is_two_accesses_with_their_calls(self):
        status, output = self.outcome("unlocked")
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"data race at 0x\w+")
        self.assertRegex(output, r"(?s)first: .* by task one.*racy_counter\.cpp:\d+.*second: .* by task two.*racy_counter\.cpp:\d+")
        self.assertIn("the default schedule failed: 2 data races", output)

    def test_none_is_found_under_a_lock(self):
        status, output = self.outcome("locked")
        self.assertEqual(status, 0, output)
        self.assertRegex(output, "^passed 301 schedules")


LARGE_FRAME = """
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>
int main() {
  waitpoint::simulate([] {
    waitpoint::thread glutton({.name = "glutton"}, [] {
      volatile char frame[1000000];
      frame[0] = 1;
    });
    glutton.join();
  });
}
"""


class LargeFrame(Installed):
    def test_does_not_step_over_the_guard_page(self):
        source = self.folder / "large_frame.cpp"
        source.write_text(LARGE_FRAME)
        program = self.folder / "large_frame"
        needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint")
        run("g++", "-std=c++20", "-O2", source, "-o", program, *needed, cwd=self.folder)
        done = subprocess.run([program], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"ran over the end of its stack\n.*in task glutton")


# The primitives as threads.hpp names them, on the standard library's threads.
REAL_THREADS = """
#include <waitpoint/fibers/sync/threads.hpp>
#include <waitpoint/modules/genom/client.hpp>
namespace threads = waitpoint::threads;
int main() {
  using namespace std::chrono_literals;
  threads::mutex door("door");
  threads::condition_variable bell("bell");
  threads::counting_semaphore<> read(0);
  bool delivered = false;
  threads::thread reader({.name = "reader"}, [&] {
    std::unique_lock lock(door);
    bell.wait(lock, [&] { return delivered; });
    read.release();
  });
  threads::periodic_timer(waitpoint::Period::every(1ms)).wait();
  {
    const std::lock_guard lock(door);
    delivered = true;
  }
  bell.notify_one();
  read.acquire();
  reader.join();
}
"""


class RealThreads(Installed):
    def test_the_same_source_runs_on_them(self):
        source = self.folder / "real.cpp"
        source.write_text(REAL_THREADS)
        needed = flags(self.prefix, "--cflags", "--libs", "--static", "waitpoint")
        run("g++", "-std=c++20", "-DWAITPOINT_REAL_THREADS", source, "-o", self.folder / "real", *needed, "-pthread")
        run(self.folder / "real", timeout=20)


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    if any((BUILD / "subprojects").glob("*")):
        print("libraries of subprojects/ are not installed: nothing can be linked outside of the build")
        sys.exit(77)
    unittest.main()
