# SPDX-License-Identifier: BSD-3-Clause
"""Bugs in programs that users build outside the tree are found: mistakes_test.py BUILD."""

import os
import re
import shlex
import shutil
import subprocess

from installed import BUILD, HERE, Installed, flags, main, run


class Mast(Installed):
    """A robot moves while its mast is deployed, in some schedules; rules of execution control keep it from that in all."""

    def waitpoint(self, command, *options):
        program = self.compile("mast", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        done = subprocess.run([program, command, HERE / "mast/mast.yaml", *options], capture_output=True, text=True, timeout=300)
        return done.returncode, done.stdout + done.stderr

    def test_it_moves_in_some_schedules_without_rules(self):
        without_rules = ["--set", "robots.rackham.control=~"]
        status, output = self.waitpoint("run", *without_rules)
        self.assertEqual(status, 0, output)
        status, output = self.waitpoint("explore", "--no-minimize", "--jobs", "2", *without_rules)
        self.assertEqual(status, 1, output)
        self.assertIn("the robot moves while the mast is deployed", output)

    def test_it_never_moves_with_rules(self):
        decisions = self.folder / "decisions"
        status, output = self.waitpoint("run", "--decisions", decisions)
        self.assertEqual(status, 0, output)
        self.assertRegex(decisions.read_text(), r"(?m)^[\d.]+ rackham mast\.Deploy #\d+ accepted$")
        status, output = self.waitpoint("explore", "--iterations", "60", "--jobs", "2")
        self.assertEqual(status, 0, output)

    def test_the_digest_has_the_decisions(self):
        digests = {re.search("wp1:[0-9a-f]+", self.waitpoint("run", *options)[1])[0]
                   for options in [[], [], ["--set", "robots.rackham.control=~"]]}
        self.assertEqual(len(digests), 2)


class LatePom(Installed):
    """A module with a bug that the default order does not show; `waitpoint explore` finds it."""

    def explore(self, *options):
        program = self.compile("late_pom", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        return subprocess.run([program, "explore", HERE / "late_pom/late_pom.yaml", "--until", "15", *options],
                              capture_output=True, text=True, timeout=300)

    def test_is_found_minimised_explained_and_replayed(self):
        schedule = self.folder / "schedule"
        found = self.explore("--jobs", "2", "--schedule", schedule)
        self.assertEqual(found.returncode, 1, found.stdout + found.stderr)
        self.assertIn("expected at most 0.06 m", found.stdout)
        self.assertRegex(found.stdout, r"(?m)^1 switch away from the default order fails")
        self.assertRegex(found.stdout, r"could still have passed: number \d+, at [\d.]+ s: ")
        here, passing = re.search(r"first in the failing run: +([^$]*?)\n  first in a passing run: +([^$]*?)\n\S",
                                  found.stdout).groups()
        reads, gives = (here, passing) if "pom.fusing" in here else (passing, here)
        self.assertRegex(reads, r"s: pom\.fusing#\d+ of rackham, about to lock mutex #\d+ \"poster\"\n")
        self.assertIn("at Pom<true>::fuse() at ", reads)
        self.assertRegex(gives, r"s: segloc\.slam#\d+ of rackham, about to lock mutex #\d+ \"poster\"\n")
        self.assertIn("waitpoint::posters::Localisation const&", gives)
        digest = re.search(r"(?m)^digest: (\S+)", found.stdout).group(1)
        for record in [re.search(r"--replay (wx1\S+)", found.stdout).group(1), schedule]:
            replayed = self.explore("--replay", record)
            self.assertEqual(replayed.returncode, 1)
            self.assertIn("the same run", replayed.stdout, replayed.stderr)
        self.assertIn(digest, replayed.stdout)

        # A record with another mark: the replay leaves it from there on.
        token = re.search(r"--replay (wx1\S+)", found.stdout).group(1)
        begin, marks, end = re.fullmatch(r"(wx1\.0\.)[0-9a-f]{8}-(\w+)(\..*)", token).groups()
        for mark, which in (5, r"at one of its events \d+ to \d+"), (1, r"at one of its events 1 to \d+"):
            other = marks[:mark] + ("z" if marks[mark] != "z" else "y") + marks[mark + 1:]
            refused = self.explore("--replay", f"{begin}00000001-{other}{end}")
            self.assertEqual(refused.returncode, 2)
            self.assertRegex(refused.stderr, rf"^waitpoint: --replay: this is not the run of the record: it had \d+ events and "
                                             rf"a digest that .*: it left the record {which}\n$")

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

    def test_is_found_below_a_temporal_plan(self):
        def below_a_plan(kind, *options):
            program = self.compile("late_pom", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
            modules = ("[{name: segloc, tasks: {slam: {period_ms: 100, clock: {kind: interval, cost_us: [25000, 90000]}}}}, "
                       f"{{name: pom, type: {kind}}}]")
            return subprocess.run([program, "explore", HERE.parents[1] / "scenarios/laas.yaml", "--set",
                                   f"robots.0.modules={modules}", "--property", "position_error_max_m=0.12", "--jobs", "2",
                                   "--no-minimize", *options], capture_output=True, text=True, timeout=300)

        found = below_a_plan("late_pom")
        self.assertEqual(found.returncode, 1, found.stdout + found.stderr)
        self.assertIn("expected at most 0.12 m", found.stdout)
        mended = below_a_plan("mended_pom", "--iterations", "20")
        self.assertEqual(mended.returncode, 0, mended.stdout + mended.stderr)

    def test_its_mended_twin_passes(self):
        passed = self.explore("--jobs", "2", "--iterations", "40", "--set", "robots.0.modules.pom.type=mended_pom")
        self.assertEqual(passed.returncode, 0, passed.stdout + passed.stderr)


class Unrepeatable(Installed):
    """A self-check finds every value that a module takes from outside the simulation, and names the first event that differs."""

    SECOND, PERTURBED = "the second run in this process", "the run in a perturbed process"

    def check(self, source, *more, **surroundings):
        program = self.compile("unrepeatable", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"),
                               "-pthread")
        entries = self.folder / "entries"  # more than fit into one page, or into one read
        if not entries.exists():
            entries.mkdir()
            for number in range(1000):
                (entries / f"entry {number}").touch()
        command = [program, "run", HERE / "unrepeatable/unrepeatable.yaml", "--verify", "--set",
                   f"robots.0.modules.unrepeatable.source={source}", *more]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=entries,
                              env={**os.environ, **surroundings})
        return done.returncode, done.stdout + done.stderr

    def assert_caught(self, source, *runs):
        """Found by one of the runs, at the event after the value was written to the poster."""
        status, output = self.check(source)
        self.assertEqual(status, 1, output)
        told = re.fullmatch(r"""unrepeatable, seed 1: not the same run: (?P<run>.*) differs from the first
  event             (?P<number>\d+)
  was               (?P<was>[0-9.]+ s, robot gambler, task unrepeatable\.main: \w+.*), digest (?P<digest>[0-9a-f]{16})
  is                (?P<is>.*), digest (?P<other>[0-9a-f]{16})
  differs in        values recorded by the robot since its previous event
  previous event    [0-9.]+ s, robot gambler, task unrepeatable\.main: .*
(?P<threads>(?:  OS thread         .*
)*)  replay            \S*unrepeatable run .*unrepeatable.yaml --seed 1 --set 'robots.0.modules.unrepeatable.source=\w+' --verify
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
        """The process ended or was terminated in the first period: the report names the event that is missing."""
        status, output = self.check(source, **surroundings)
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"not the same run: the run in a perturbed process differs from the first\n"
                                 r"  event             \d+\n  was               0\.\d+ s, robot gambler, task .*\n"
                                 rf"  is                no event: {how}\n  differs in        the presence of the event\n"
                                 r"  previous event    0\.\d+ s, robot gambler, task unrepeatable\.main: ")

    def test_a_perturbed_process_that_dies_is_reported_with_the_event_it_did_not_reach(self):
        self.assert_cut_off(r"the process was terminated by signal 4 \(Illegal instruction\)", "crash")

    def test_a_perturbed_process_is_not_waited_for_without_end(self):
        self.assert_cut_off("the process exceeded 2 s and was stopped", "endless_loop", WAITPOINT_TIME_LIMIT="2")

    def test_a_failure_in_one_process_only_is_reported(self):
        status, output = self.check("exception")
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"not the same run: the run in a perturbed process differs from the first\n  event +\d+\n"
                                 r"  was  +0\.1\d+ s, robot gambler, .*\n  is   +0\.1\d+ s, robot gambler, ")

    def test_perturbed_process_randomises_addresses(self):
        program = self.compile("unrepeatable", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"),
                               "-pthread")
        done = subprocess.run(["setarch", "-R", program, "run", HERE / "unrepeatable/unrepeatable.yaml", "--verify"],
                              capture_output=True, text=True, timeout=120)
        if "setarch" in done.stderr:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("not perturbed", done.stdout)


class LostLetter(Installed):
    """Tests of a user's own threads need neither world nor modules."""

    def test_finds_the_lost_letter(self):
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint")
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

        # A token with a call that no test has is an error.
        other = re.search(r"wx1\.1\.(\S+)", line)[1]
        for which in "MendedLetter.*", "*", "No.Such":
            refused = subprocess.run([program, f"--gtest_filter={which}"], capture_output=True, text=True,
                                     env={**os.environ, "WAITPOINT_REPLAY": f"wx1.7.{other}"})
            self.assertEqual((refused.returncode, refused.stderr),
                             (2, f"waitpoint: WAITPOINT_REPLAY: expected a token of this program, found 'wx1.7.{other}': "
                                 "no test that ran makes such a call\n"))
            self.assertNotIn("PASSED", refused.stdout)

    def test_a_process_that_dies_says_how_to_repeat_it(self):
        needed = flags(self.prefix, "--cflags", "--libs", "waitpoint")
        program = self.compile("sudden_death", *needed)
        for signal in "6", "9", "11":
            # The supervisor keeps the pipe open until it has printed its message.
            done = subprocess.run([program, signal], capture_output=True, text=True)
            self.assertEqual(done.returncode, -int(signal), done.stderr)
            line = re.search(r"replay: (WAITPOINT_REPLAY=\S+ \S+)", done.stderr)
            self.assertIsNotNone(line, done.stderr)
            again = subprocess.run(["sh", "-c", f"{line[1]} {signal}"], capture_output=True, text=True)
            self.assertIn(again.returncode, (-int(signal), 128 + int(signal)), again.stderr)


class SharedQueue(Installed):
    """A user's container is compared with a sequential model."""

    def test_is_no_queue_and_the_mended_one_is(self):
        program = self.compile("shared_queue", *flags(self.prefix, "--cflags", "--libs", "waitpoint"), "-lgtest", "-lgtest_main")
        done = subprocess.run([program], capture_output=True, text=True, env={**os.environ, "GTEST_COLOR": "no"})
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("[  FAILED  ] SharedQueue.IsAQueue", done.stdout)
        self.assertIn("[       OK ] MendedQueue.IsAQueue", done.stdout)
        table = re.search(r"(?s)\nplace .*?\^ end of the prefix\n", done.stdout)
        self.assertIsNotNone(table, done.stdout)
        document = (HERE.parents[1] / "docs/explore.md").read_text()
        self.assertIn(table[0], document, "docs/explore.md shows another table")


class SharedCounter(Installed):
    """The installed library is not instrumented; a sanitizer in the user's program sees tasks as threads."""

    def outcome(self, sanitizer, how):
        program = self.folder / sanitizer
        if not program.exists():
            needed = flags(self.prefix, "--cflags", "--libs", "waitpoint")
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
    """Races are found in a program compiled and linked by one command, with the flags of the library's own compiler."""

    def outcome(self, *arguments, package="waitpoint-races", compiler=None, races="report"):
        if not list(self.prefix.rglob(f"{package}.pc")):
            self.skipTest(f"the library waitpoint-races is not built, or its compiler is that of {package}")
        needed = flags(self.prefix, "--cflags", "--libs", package)
        program = self.compile("racy_counter", *needed, program=f"racy_counter-{package}", compiler=compiler)
        done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=60,
                              env={**os.environ, "WAITPOINT_RACES": races})
        return done.returncode, done.stdout + done.stderr

    def test_a_race_is_two_accesses_with_their_calls(self):
        status, output = self.outcome("unlocked")
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"data race at 0x\w+")
        self.assertRegex(output, r"(?s)first: .* by task one#1.*racy_counter\.cpp:\d+.*second: .* by task two#2.*racy_counter\.cpp:\d+")
        self.assertRegex(output, r"waitpoint: the default order: data race of the write at .*racy_counter\.cpp:\d+ and the ")
        self.assertRegex(output, "schedule \\d+ of .* failed: a check failed in task main of .*: an increment is lost\n")
        self.assertIn("also found, by the default order: data race at", output)
        self.assertEqual(output.count("data race at"), 1, output)

    def test_the_first_one_may_end_the_campaign(self):
        status, output = self.outcome("unlocked", races="fail")
        self.assertEqual(status, 1, output)
        self.assertIn("the default order failed: a data race\n", output)
        self.assertEqual(output.count("data race at"), 1, output)

    def test_none_is_found_under_a_lock(self):
        status, output = self.outcome("locked")
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r"^passed \d+ schedules, 4 distinct: exhausted")

    def test_they_are_found_in_the_code_of_another_compiler(self):
        if shutil.which("clang++") is None:
            self.skipTest("there is no clang++ here")
        other = {"package": "waitpoint-races-clang", "compiler": "clang++"}
        status, output = self.outcome("unlocked", **other)
        self.assertEqual(status, 1, output)
        self.assertRegex(output, r"(?s)first: .* by task one#1.*racy_counter\.cpp:\d+.*second: .* by task two#2.*racy_counter\.cpp:\d+")
        status, output = self.outcome("locked", **other)
        self.assertEqual(status, 0, output)


if __name__ == "__main__":
    main()
