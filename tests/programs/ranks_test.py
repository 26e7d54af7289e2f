# SPDX-License-Identifier: BSD-3-Clause
"""A run of several processes joined by MPI is the run of one process: ranks_test.py BUILD [--long]."""

import collections
import functools
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

from installed import BUILD, HERE, Installed, flags, main
from two_hosts import TwoHosts

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
ROOT = HERE.parents[1]
WAITPOINT = BUILD / "tools/waitpoint"
MPIRUN = shutil.which("mpirun")
# As `waitpoint run --ranks` starts it.
AS_RANKS = [MPIRUN, "--mca", "orte_execute_quiet", "1", "--map-by", ":oversubscribe", "--bind-to", "none",
            *(["--allow-run-as-root"] if os.geteuid() == 0 else [])]

Run = collections.namedtuple("Run", "status output errors files")


def setUpModule():
    if MPIRUN is None or not (BUILD / "libwaitpoint-mpi.so").exists():
        raise unittest.SkipTest("there is no Open MPI")


@functools.lru_cache(maxsize=None)
def folder():
    made = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(made.cleanup)
    return pathlib.Path(made.name)


def repeatable(text):
    """Without the wall clock's figures."""
    text = re.sub(r'(?s) +"ranks": \[.*?\],\n', "", text)
    return re.sub(r'(?m)^ *(speed |ranks |"wall_s":|"real_time_factor":).*\n', "", text)


def run(ranks, scenario, *options, launcher=(), program=WAITPOINT, input=""):
    """A run with all its output files, by the ending of their names."""
    with tempfile.TemporaryDirectory(dir=folder()) as here:
        files = ["--summary", f"{here}/s.json", "--picture", f"{here}/p.svg", "--trajectory", f"{here}/t.tum",
                 "--digests", f"{here}/d.txt", "--journal", f"{here}/j.txt"]
        number = [] if ranks is None or launcher else ["--ranks", str(ranks)]
        done = subprocess.run([*launcher, program, "run", scenario, *number, *files, *options], capture_output=True, text=True,
                              input=input, timeout=300)
        contents = {path.name: repeatable(path.read_text()) for path in sorted(pathlib.Path(here).iterdir())}
        return Run(done.returncode, repeatable(done.stdout), done.stderr, contents)


def digest(done):
    return re.search(r"digest +(wp1:\w+)", done.output).group(1)


def crowd(robots, goals=True):
    """Robots in one hall, close enough to meet and to collide."""
    lines = ["format: 1", "name: crowd", "until_s: 6", "world:", "  step_ms: 10", "  shapes:",
             "    - {corners_m: [-1, -1, 61, -0.8]}", "    - {corners_m: [-1, 60, 61, 60.2]}",
             f"robot_types: {{include: {ROOT}/scenarios/rackham.yaml}}", "robots:"]
    for i in range(robots):
        x, y = 2 + 2.2 * (i % 15), 2 + 2.2 * (i // 15)
        lines += [f"  - name: r{i}", "    type: rackham", f"    start: [{x:.2f}, {y:.2f}, {i * 37 % 360}]"]
        if goals and i % 3 != 0:
            lines.append(f"    goals: [[{x + 1.5:.2f}, {y:.2f}]]")
    file = folder() / f"crowd-{robots}-{goals}.yaml"
    file.write_text("\n".join(lines) + "\n")
    return file


class EqualRuns(unittest.TestCase):
    def assert_equal(self, scenario, rank_counts, *options, **more):
        alone = run(None, scenario, *options, **{key: value for key, value in more.items() if key != "launcher"})
        self.assertIn("digest", alone.output, alone.errors)
        for ranks in rank_counts:
            with self.subTest(ranks=ranks, options=options):
                several = run(ranks, scenario, *options, **more)
                self.assertEqual(several.output, alone.output, several.errors)
                self.assertEqual(several.files.keys(), alone.files.keys())
                for name in alone.files:
                    self.assertEqual(several.files[name], alone.files[name], name)
                self.assertEqual(several.status, alone.status, several.errors)
        return alone

    def test_an_office(self):
        self.assert_equal(ROOT / "scenarios/office-10.yaml", (2, 3, 8) if LONG else (3,))

    def test_a_part_of_a_run_that_ends_within_a_step_in_another_order(self):
        self.assert_equal(ROOT / "scenarios/office-10.yaml", (2, 4) if LONG else (2,), "--until", "12.3456", "--strategy", "random", "--seed", "7")

    def test_a_crowd_with_robots_without_goals(self):
        self.assert_equal(crowd(60), (2, 4) if LONG else (4,), "--until", "3")
        self.assert_equal(crowd(9, goals=False), (2,), "--until", "2")

    def test_more_robots_than_a_task_may_pass_waitpoints_at_an_instant(self):
        lines = ["format: 1", "name: many", "until_s: 1", "world: {step_ms: 10}", "robots:"]
        lines += [f"  - {{name: r{i}, shape: {{radius_m: 0.2, height_m: 0.5}}, start: [{i % 40}, {i // 40}, 0], modules: []}}"
                  for i in range(1200)]
        scenario = folder() / "many.yaml"
        scenario.write_text("\n".join(lines) + "\n")
        self.assert_equal(scenario, (2,), "--until", "0.1")

    def test_a_dynamic_world_and_aerial_robots(self):
        self.assert_equal(ROOT / "scenarios/office-dynamic.yaml", (2,), "--until", "20")
        self.assert_equal(ROOT / "scenarios/office-air.yaml", (2,), "--until", "20")

    def test_over_tcp(self):
        launcher = [*AS_RANKS, "--mca", "btl", "tcp,self", "--mca", "btl_tcp_if_include", "lo", "-n", "2"]
        self.assert_equal(ROOT / "scenarios/office-10.yaml", (2,), "--until", "5", launcher=launcher)

    def test_two_hosts_a_millisecond_apart(self):
        with TwoHosts(folder(), delay_s=0.001) as hosts:
            launcher = hosts.launcher(AS_RANKS, 2)
            self.assert_equal(ROOT / "scenarios/office-10.yaml", (2,), "--until", "0.5", launcher=launcher)
            if LONG:
                launcher = hosts.launcher(AS_RANKS, 5)
                self.assert_equal(ROOT / "scenarios/office-10.yaml", (5,), "--until", "5", "--strategy", "random", launcher=launcher)
                self.assert_equal(crowd(60), (5,), "--until", "3", launcher=launcher)

    def test_a_robot_with_commands(self):
        programs = 'robots.4.programs=[{name: clock, command: [sh, -c, "sleep 1; date; sleep 1; exit 3"]}]'
        alone = self.assert_equal(ROOT / "scenarios/office-10.yaml", (2,), "--until", "4", "--set", programs)
        self.assertIn("program clock ended with exit status 3", alone.output)

    def test_interventions_and_their_journal(self):
        commands = "run 1\nmove jan 30 6 90\nrequest ines ndd Stop\nrequest nobody rflex Stop\nrun +1.5\nstatus\n" \
                   "tasks\nidle 0.1\nuntil ada.travelled_m > 0.5\nquit\n"
        office = ROOT / "scenarios/office-10.yaml"
        alone, several = (run(ranks, office, "--interactive", input=commands) for ranks in (None, 3))
        self.assertIn("there is no robot 'nobody'", alone.errors)
        self.assertEqual([line for line in several.errors.splitlines() if "nobody" in line],
                         [line for line in alone.errors.splitlines() if "nobody" in line])
        journal = folder() / "journal"
        journal.write_text(several.files["j.txt"])
        self.assertRegex(journal.read_text(), r"(?m)^at 1\.000000000 move jan 30 6 90$")
        for ranks in (None, 2):
            replayed = run(ranks, office, "--replay-journal", journal)
            self.assertEqual(digest(replayed), digest(several), replayed.errors)
            # One process says when the last event was, several where the window ends.
            ends = [re.sub(r"(?m)^end [0-9.]+", "end", each.files["j.txt"]) for each in (replayed, several)]
            self.assertEqual(*ends)

    def test_events_of_each_robot_are_in_order(self):
        def events(ranks):
            file = folder() / "events"
            run(ranks, ROOT / "scenarios/office-10.yaml", "--until", "1", "--events", file)
            robots = collections.defaultdict(list)
            times = []
            for line in file.read_text().splitlines()[1:]:
                times.append(float(line.split()[0]))
                robots[line.split()[1]].append(line)
            self.assertEqual(times, sorted(times))
            return robots
        self.assertEqual(events(3), events(None))


class Recordings(unittest.TestCase):
    """Bytes are equal, lines of modules between the last step and the end included."""

    def recorded(self, ranks, file, *options, **more):
        done = run(ranks, ROOT / "scenarios/office-10.yaml", "--record", file, *options, **more)
        self.assertIn("digest", done.output, done.errors)
        return file.read_bytes()

    def test_each_format(self):
        bags = subprocess.run([WAITPOINT, "run", ROOT / "scenarios/office.yaml", "--until", "0.1", "--record", folder() / "no.bag"],
                              capture_output=True, text=True, timeout=60)
        endings = [".mcap", ".log"] if "without rosbag_storage" in bags.stderr else [".mcap", ".log", ".bag"]
        for ending in endings:
            with self.subTest(ending):
                alone, several = (self.recorded(ranks, folder() / f"record{ending}", "--until", "3.2046") for ranks in (None, 3))
                self.assertGreater(len(alone), 100_000)
                self.assertTrue(several == alone)

    def test_obstacles_that_are_moved_and_pauses(self):
        commands = "run 1.033\nobstacle {name: box, centre_m: [22, 6], size_m: [0.5, 0.5]}\nrun +0.5\nrequest ines ndd Stop\n" \
                   "run +0.7\nremove-obstacle box\nrun +0.501\nquit\n"
        alone, several = (self.recorded(ranks, folder() / "moved.mcap", "--interactive", input=commands) for ranks in (None, 4))
        self.assertGreaterEqual(alone.count(b"Stop:"), 2)
        self.assertTrue(several == alone)


class Media(Installed):
    def test_messages_between_robots_on_different_ranks(self):
        program = self.compile("two_robots", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        scenario = HERE / "two_robots/two_robots.yaml"
        alone, several = (run(ranks, scenario, program=program) for ranks in (None, 2))
        # The lines of each robot are printed where its tasks are.
        self.assertEqual(sorted(several.output.splitlines()), sorted(alone.output.splitlines()), several.errors)
        self.assertEqual(several.files, alone.files)


class Series(unittest.TestCase):
    def test_runs_at_once_are_the_runs_in_turn(self):
        def rows(*options):
            done = subprocess.run([WAITPOINT, "run", ROOT / "scenarios/office.yaml", "--seeds", "3..8", "--until", "5", *options],
                                  capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 1)  # not all goals are reached by then
            return re.sub(r" +[0-9.]+(  wp1:)", r"\1", done.stdout)
        alone = rows()
        self.assertEqual([line.split()[0] for line in alone.splitlines()[1:7]], list("345678"))
        self.assertRegex(alone, r"\n +simulated_s( +5\.000){5}\n$")
        self.assertEqual(rows("--jobs", "3"), alone)


class Refusals(unittest.TestCase):
    def assert_refused(self, words, *options, scenario="office-10.yaml", ranks=2):
        done = run(ranks, ROOT / "scenarios" / scenario, *options)
        self.assertEqual(done.status, 2, done.errors)
        self.assertRegex(done.errors, words)
        self.assertEqual(len(done.errors.splitlines()), 1, done.errors)
        self.assertEqual(done.files, {})

    def test_bad_options_are_one_line(self):
        self.assert_refused("expected a whole number from 1 to 4096, found '0'", ranks=0)
        self.assert_refused(r"office-programs.yaml:27: expected no program that is a shared object", scenario="office-programs.yaml")
        self.assert_refused(r"office-measured.yaml:26: expected a clock that is not measured", scenario="office-measured.yaml")
        self.assert_refused("cannot be read: No such file", scenario="nowhere.yaml")
        self.assert_refused("unknown module type 'none'", "--set", "robots.9.modules=[{name: x, type: none}]")

    def test_ranks_of_different_runs_do_not_start(self):
        command = f'exec {WAITPOINT} run {ROOT}/scenarios/office-10.yaml --seed 1$OMPI_COMM_WORLD_RANK'
        done = subprocess.run([*AS_RANKS, "-n", "2", "sh", "-c", command], capture_output=True, text=True, timeout=60)
        self.assertRegex(done.stderr, r"rank 1 on .*: expected the same seed on all ranks, '10', found '11'")
        self.assertEqual(done.returncode, 2)


class Faults(Installed):
    """A run goes at real time, so that it lasts for as long as is needed."""

    def start(self, *options, rest="go"):
        self.begin([WAITPOINT, "run", "--ranks", "3"], *options, rest=rest)
        self.assertEqual(len(self.ranks()), 3)

    def begin(self, command, *options, rest="go"):
        """Returns when the first second of virtual time is over; standard input ends the run."""
        self.process = subprocess.Popen(
            [*command, ROOT / "scenarios/office-10.yaml", "--speed", "1", "--seed", "4", "--interactive", *options], text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for ending in (self.process.stdin.close, self.process.stdout.close, self.process.stderr.close, self.process.wait,
                       self.process.kill):
            self.addCleanup(ending)
        self.process.stdin.write(f"run 1\n{rest}\n")
        self.process.stdin.flush()
        self.assertRegex(self.process.stdout.readline(), r"^at 1\.0+ s after")

    def ranks(self):
        return self.ranks_with(b"WAITPOINT_LAUNCHER=/proc/%d/" % self.process.pid)

    def ranks_with(self, variable):
        """The processes, by rank, whose environment has this variable."""
        found = {}
        for entry in pathlib.Path("/proc").glob("[0-9]*/environ"):
            try:
                words = entry.read_bytes().split(b"\0")
            except OSError:
                continue
            rank = [word for word in words if word.startswith(b"OMPI_COMM_WORLD_RANK=")]
            if rank and any(word.startswith(variable) for word in words):
                found[int(rank[0].partition(b"=")[2])] = int(entry.parent.name)
        return found

    def wait(self):
        self.output, errors = self.process.communicate(timeout=60)
        return errors

    REPLAY = r"in window \d+, from \d+\.\d+ s of virtual time on\n  replay: waitpoint run .*office-10.yaml --seed 4( .*)?\n"

    def test_a_killed_rank_ends_the_run(self):
        picture = folder() / "killed.svg"
        self.start("--picture", picture)
        os.kill(self.ranks()[1], signal.SIGKILL)
        self.assertRegex(self.wait(), r"the run failed: rank 1 has ended, " + self.REPLAY)
        self.assertIn("cut off", picture.read_text())

    def test_a_killed_leader_is_reported_by_another(self):
        self.start()
        os.kill(self.ranks()[0], signal.SIGKILL)
        self.assertRegex(self.wait(), r"the run failed: rank 0 has ended, " + self.REPLAY)

    def test_a_stopped_rank_is_reported_and_continues(self):
        self.start(rest="run 3\nquit")
        stopped = self.ranks()[2]
        os.kill(stopped, signal.SIGSTOP)
        self.assertRegex(self.process.stderr.readline(), r"waitpoint: rank 2 has not answered for 5 s, in window ")
        os.kill(stopped, signal.SIGCONT)
        self.wait()
        self.assertRegex(self.output, r"at 3\.0+ s after")

    def test_a_stopped_leader_is_reported_by_another_rank(self):
        self.start(rest="run 3\nquit")
        stopped = self.ranks()[0]
        os.kill(stopped, signal.SIGSTOP)
        self.assertRegex(self.process.stderr.readline(), r"waitpoint: rank 0 has not answered for 5 s, in window ")
        os.kill(stopped, signal.SIGCONT)
        self.wait()
        self.assertRegex(self.output, r"at 3\.0+ s after")

    def test_an_interrupted_run_ends_in_order(self):
        for who in ("the first rank", "the process that has started them"):
            with self.subTest(who):
                self.start()
                os.kill(self.ranks()[0] if who == "the first rank" else self.process.pid, signal.SIGTERM)
                self.wait()
                self.assertIn("digest", self.output)
                self.assertEqual(self.process.returncode, 130)

    @unittest.skipUnless(LONG, "takes long: --long")
    def test_a_killed_rank_on_another_host_ends_the_run(self):
        with TwoHosts(folder(), delay_s=0.001) as hosts:
            self.begin([*hosts.launcher(AS_RANKS, 2), WAITPOINT, "run"])
            far = self.ranks_with(b"PMIX_HOSTNAME=far")
            self.assertEqual(list(far), [1])
            os.kill(far[1], signal.SIGKILL)
            self.assertRegex(self.wait(), r"the run failed: rank 1 has ended or does not answer, " + self.REPLAY)

    def test_an_exception_or_a_deadlock_on_any_rank_is_reported_once(self):
        program = self.compile("deaths", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        text = (HERE / "deaths/deaths.yaml").read_text()
        text += text[text.index("  - name: doomed"):].replace("doomed", "second").replace("[0, 0, 0]", "[5, 0, 0]")
        scenario = folder() / "deaths.yaml"
        scenario.write_text(text)
        def events(robot):
            text = (folder() / "events").read_text()
            return [line for line in text.splitlines() if f" {robot} " in line], re.search(r"(?m)^# cut off: .*", text)
        for number, robot in enumerate(("doomed", "second")):
            for end, words in (("exception", "an exception escaped from task mortal.main"), ("deadlock", "a task waits for itself")):
                with self.subTest(robot=robot, end=end):
                    options = ["--set", f"robots.{number}.modules.mortal.end={end}", "--events", folder() / "events"]
                    alone, alone_events = run(None, scenario, *options, program=program), events(robot)
                    several, several_events = run(2, scenario, *options, program=program), events(robot)
                    self.assertRegex(alone.output + alone.errors, words)
                    self.assertEqual(re.sub(r"tmp\w+", "", several.errors), re.sub(r"tmp\w+", "", alone.errors))
                    self.assertEqual([line for line in several.output.splitlines() if words in line],
                                     [line for line in alone.output.splitlines() if words in line])
                    self.assertEqual(several.status, 1)
                    self.assertEqual(several_events[0], alone_events[0])  # up to the failure
                    self.assertEqual(several_events[1] is None, alone_events[1] is None)


if __name__ == "__main__":
    main()
