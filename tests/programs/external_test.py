# SPDX-License-Identifier: BSD-3-Clause
"""Robots outside take part in a run by reports of their positions, and its journal repeats it: external_test.py BUILD."""

import json
import pathlib
import re
import socket
import subprocess
import tempfile
import unittest

from installed import BUILD, HERE, main

WAITPOINT = BUILD / "tools/waitpoint"
NATIVE = BUILD / "tools/waitpoint-native"
MIXED = HERE / "mixed/mixed.yaml"
PATIENCE_S = 120


class Run:
    """A paced run that waits for commands: `go` began it, `quit` ends it."""

    def __init__(self, folder, *options, scenario=MIXED):
        self.folder = folder
        self.errors = open(folder / "errors", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [WAITPOINT, "run", scenario, "--speed", "1", "--interactive", "--journal", folder / "journal", "--summary",
             folder / "summary.json", *options],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.type("go")

    def type(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def end(self):
        """Returns the exit status."""
        if self.process.poll() is None:
            try:
                self.type("quit")
            except BrokenPipeError:
                pass
        return self.wait()

    def wait(self):
        self.output, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode

    def told(self):
        """What the run has told on standard error, without the times."""
        self.errors.flush()
        return re.sub(r"(?m)^ *\d+\.\d+ s  ", "", (self.folder / "errors").read_text())

    def digest(self):
        return re.search(r"digest +(wp1:\w+)", self.output)[1]

    def summary(self, robot):
        robots = json.loads((self.folder / "summary.json").read_text())["robots"]
        return next(each for each in robots if each["name"] == robot)


class Source:
    """Connects to a run as soon as it listens."""

    def __init__(self, path, run):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(PATIENCE_S)
        while True:
            try:
                self.socket.connect(str(path))
                break
            except (FileNotFoundError, ConnectionRefusedError):
                if run.process.poll() is not None:
                    raise AssertionError(run.told()) from None
        self.lines = self.socket.makefile("rw", encoding="utf-8")
        self.greeting = self.lines.readline()

    def say(self, text):
        """Returns the answer to the last line."""
        self.lines.write(text + "\n")
        self.lines.flush()
        return self.lines.readline().strip()

    def report(self, stamp_s, x_m, y_m, more=""):
        return self.say(f"report stamp_s={stamp_s} x_m={x_m} y_m={y_m} heading_rad=0 {more}")

    def close(self):
        self.lines.close()
        self.socket.close()


def waitpoint(*words, **options):
    return subprocess.run([WAITPOINT, *map(str, words)], capture_output=True, text=True, timeout=PATIENCE_S, **options)


class External(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "ada"

    def start(self, *options, robots=("ada",), **more):
        addresses = [word for robot in robots for word in ("--external", f"{robot}=unix:{self.folder / robot}")]
        run = Run(self.folder, *addresses, *options, **more)
        self.addCleanup(run.errors.close)
        self.addCleanup(lambda: run.process.poll() is None and run.process.kill())
        return run

    def connect(self, run, endpoint="ada"):
        source = Source(self.folder / endpoint, run)
        self.addCleanup(source.close)
        return source

    def replay(self, *options):
        return waitpoint("run", MIXED, "--replay-journal", self.folder / "journal", *options)

    def refused(self, *words, scenario=MIXED, command="run"):
        done = waitpoint(command, scenario, *words)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr


class Reports(External):
    def test_move_a_body_and_the_journal_repeats_the_run_without_them(self):
        run = self.start(robots=("ada", "bob"))
        ada, bob = self.connect(run), self.connect(run, "bob")
        self.assertEqual(ada.greeting, "waitpoint reports 1 ada\n")
        for i in range(20):
            self.assertRegex(ada.report(i / 10, 10 - i / 10, 3, "v_m_s=-1"), rf"^taken {i / 10:g} at \d+\.\d+$")
            self.assertRegex(bob.report(1e9 + i, 12, 8), r"^taken \d+ at \d+\.\d+$")
        self.assertEqual(run.end(), 0, run.told())
        self.assertEqual(run.summary("ada")["external"]["reports"], 20)
        lag = run.summary("ada")["external"]
        self.assertTrue(0 <= lag["lag_min_s"] <= lag["lag_median_s"] <= lag["lag_max_s"], lag)
        self.assertRegex(run.output, r"ada: external: 20 reports, \d+ late, lag least \d")
        self.assertIn("bob: 1 connection, 20 reports", run.output)

        journal = (self.folder / "journal").read_text()
        self.assertEqual(len(re.findall(r"(?m)^at [\d.]+ report ada date_s=", journal)), 20, journal)
        for options in [], ["--speed", "50"]:
            again = self.replay(*options)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertIn(run.digest(), again.stdout)
            self.assertIn("ada: external: 20 reports", again.stdout)

    def test_are_seen_by_lasers_and_met_by_bodies(self):
        """The reported place is in front of the simulated robot, whose digest differs from then on."""
        run = self.start()
        ada = self.connect(run)
        ada.report(1, 5, 5)
        run.type("pause\nrun +0.5")
        self.assertEqual(run.end(), 0, run.told())
        seen = re.search(r"(?m)^  rackham .* (wp1:\w+)$", run.output)[1]
        until = re.search(r"(?m)^end ([\d.]+)", (self.folder / "journal").read_text())[1]
        alone = waitpoint("run", MIXED, "--until", until)
        self.assertNotEqual(seen, re.search(r"(?m)^  rackham .* (wp1:\w+)$", alone.stdout)[1])

    def test_end_at_contacts(self):
        run = self.start("--reports", "jump_m=20")
        ada = self.connect(run)
        ada.report(1, 0.6, 2)
        ada.report(2, 0.3, 2)
        ada.report(3, 0.6, 2)
        ada.report(4, 0.6, 2)
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: stopped by a contact at (0.50, 2.00)\n", run.told())

    def test_of_a_jump_and_of_a_place_that_is_taken_are_told(self):
        run = self.start()
        ada = self.connect(run)
        ada.report(1, 15, 2)
        ada.report(2, 12, 8)
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: jump of 5.00 m to (15.00, 2.00)\n", run.told())
        self.assertIn("ada: stays at (15.00, 2.00): 'bob' is in the way at the reported place (12.00, 8.00)\n", run.told())

    def test_of_the_unix_clock_and_of_the_runs_own_have_their_lags(self):
        run = self.start("--reports", "late_s=0.05", "--reports", "between=stay")
        ada = self.connect(run)
        date = float(ada.report(1, 10, 2).split()[-1])
        self.assertRegex(ada.say(f"clock run\nreport stamp_s={date - 5} x_m=10 y_m=2 heading_rad=0"), "^taken")
        self.assertRegex(ada.say("report stamp_s=1e9 x_m=10 y_m=2 heading_rad=0"), "from the future")
        self.assertRegex(ada.say("clock unix\nreport stamp_s=1e9 x_m=10 y_m=2 heading_rad=0"), "^taken")
        self.assertEqual(run.end(), 0, run.told())
        self.assertRegex(run.told(), r"ada: reports are late: by 5\.\d+ s, more than 0.05 s\n")
        self.assertEqual(run.summary("ada")["external"]["late"], 2)
        self.assertGreater(run.summary("ada")["external"]["lag_max_s"], 1e8)


class Faults(External):
    """None ends the run, and each is one line."""

    def test_malformed_reports_and_such_from_the_past(self):
        run = self.start()
        ada = self.connect(run)
        self.assertRegex(ada.say("hello"), r"refused: .*ada:1: expected 'report' or 'clock', found 'hello'$")
        self.assertRegex(ada.report(1, "nan", 2), r"refused: .*:2: expected 'x_m' to be a number of at most 100000, found 'nan'$")
        self.assertRegex(ada.report(1, 10, 2), "^taken")
        self.assertRegex(ada.report(1, 10, 2), r"refused: .*:4: report from the past: stamp 1 s after 1 s$")
        self.assertRegex(ada.say("report"), r"refused: .*:5: expected stamp_s=NUMBER$")
        self.assertRegex(ada.say("clock sundial"), r"refused: .*:6: expected clock own, unix or run, found 'sundial'$")
        self.assertRegex(ada.report(2, 10, 2), "^taken")
        self.assertEqual(run.end(), 0, run.told())
        self.assertEqual(run.told().count("malformed"), 0)
        self.assertEqual(run.told().count("expected"), 1, "the first is told")
        self.assertIn("ada: 1 connection, 2 reports, 1 from the past, 4 malformed", run.output)

    def test_a_flood_counts_as_its_newest_report(self):
        run = self.start()
        ada = self.connect(run)
        count = 500
        flood = "".join(f"report stamp_s={i} x_m=10 y_m=2 heading_rad=0\n" for i in range(1, count + 1))
        answer = ada.say(flood.strip())
        answers = [answer]
        while not answers[-1].startswith("taken 500 "):
            answers.append(ada.lines.readline().strip())
        self.assertEqual(run.end(), 0, run.told())
        self.assertEqual(sum(each.startswith(("taken", "superseded")) for each in answers), count)
        self.assertRegex(run.told(), r"ada: flood: \d+ lines in one step of the world; the newest report counts\n")

    def test_a_connection_that_breaks_and_one_that_was_never_made(self):
        run = self.start(robots=("ada", "bob"))
        ada = self.connect(run)
        ada.report(1, 10, 2)
        second = self.connect(run)
        self.assertEqual(second.greeting, "refused: another source is connected\n")
        ada.close()
        third = self.connect(run)
        while third.greeting.startswith("refused"):
            third = self.connect(run)
        third.report(1, 10, 2)
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: the connection to the source ended after 1 report\n", run.told())
        self.assertIn("bob: no source of reports has connected to unix:", run.output)

    def test_silence_is_told_and_the_body_stays(self):
        run = self.start("--reports", "silent_s=0.05")
        ada = self.connect(run)
        ada.report(1, 10, 2, "v_m_s=0.5")
        run.type("pause\nrun +0.2\nstatus")
        self.assertEqual(run.end(), 0, run.told())
        self.assertRegex(run.told(), r"ada: no report for 0.05 s: it stays at \(10.0\d, 2.00\)\n")
        self.assertIn("  ada: 0 of 0 goals, at (10.0", run.output)

    def test_the_first_ends_the_run_if_asked(self):
        run = self.start("--outside-faults-end")
        ada = self.connect(run)
        ada.say("hello")
        self.assertEqual(run.wait(), 1, run.told())
        self.assertRegex(run.told(), r"\nwaitpoint: ended at a fault outside: ada: .*:1: expected 'report' or 'clock', found 'hello'\n")
        self.assertIn("left after", run.output)
        self.assertEqual(self.replay().returncode, 0)

    def test_the_speed_cannot_be_changed(self):
        run = self.start()
        ada = self.connect(run)
        ada.report(1, 10, 2)
        run.type("speed 3")
        self.assertEqual(run.end(), 0)
        self.assertIn("standard input:2: expected no change of the speed: partners outside live in real time\n", run.told())


class ServedWorld(External):
    def serve(self, *options, robots=()):
        run = self.start("--serve-world", f"unix:{self.folder / 'world'}", *options, robots=robots)
        return run, self.connect(run, "world")

    def until(self, client, word):
        """The next line that begins with this word; its KEY=VALUE pairs by key."""
        while not (line := client.lines.readline()).startswith(word + " "):
            self.assertTrue(line, "the connection ended")
        return dict(pair.split("=", 1) for pair in line.split() if "=" in pair)

    def test_software_outside_drives_a_base_and_reads_a_laser_and_the_journal_repeats_it(self):
        run, client = self.serve(robots=("ada",))
        self.assertEqual(client.greeting, "waitpoint world 1 mixed step_s=0.01\n")
        ada = self.connect(run, "ada")
        self.assertEqual(client.say("robot bob"), "attached bob")
        before = self.until(client, "truth")
        self.assertEqual((before["x_m"], before["y_m"]), ("12", "8"))
        client.lines.write("laser eye on\ncommand v_m_s=0.5\n")
        client.lines.flush()
        self.until(client, "taken")
        ada.report(1, 18, 8)
        ranges = [self.until(client, "scan")["range_m"].split(",") for _ in range(20)]
        self.assertLess(float(ranges[-1][1]), 6, "ada is seen, in front of the east wall")
        self.assertLess(float(ranges[-1][1]), float(ranges[5][1]))
        self.assertGreater(int(self.until(client, "base")["travel_units"]), 0)
        self.assertGreater(float(self.until(client, "truth")["x_m"]), 12)
        client.close()
        run.type("pause\nrun +3\nstatus")
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("bob: the connection of its software ended: it stops\n", run.told())
        self.assertRegex(run.output, r"world: 1 connection, 1 command\n")
        self.assertLess(float(re.search(r"bob: 0 of 0 goals, at \(([\d.]+)", run.output)[1]), 13.5)
        again = self.replay()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn(run.digest(), again.stdout)

    @unittest.skipUnless(NATIVE.exists(), "the build has no native library")
    def test_native_modules_in_another_process_drive_a_robot_to_its_goal(self):
        body_only = [word for part in ("modules", "bridge", "goals") for word in ("--set", f"robots.rackham.{part}=[]")]
        run = self.start("--serve-world", f"unix:{self.folder / 'world'}", *body_only, robots=("ada",))
        self.connect(run).report(1, 10, 2)
        native = subprocess.run([NATIVE, "run", MIXED, "--world", f"unix:{self.folder / 'world'}",
                                 "--until", str(PATIENCE_S), "--set", "robots.rackham.goals=[[4.8, 5]]"],
                                capture_output=True, text=True, timeout=2 * PATIENCE_S)
        self.assertEqual(native.returncode, 0, native.stdout + native.stderr)
        self.assertIn("goals reached     1 of 1", native.stdout)
        run.type("pause\nstatus")
        self.assertEqual(run.end(), 0, run.told())
        self.assertGreater(float(re.search(r"rackham: 0 of 0 goals, at \(([\d.]+)", run.output)[1]), 4.4)
        again = self.replay(*body_only)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn(run.digest(), again.stdout)

    @unittest.skipUnless(NATIVE.exists(), "the build has no native library")
    def test_native_modules_without_a_world_that_fits_are_refused(self):
        def refused(*words):
            done = subprocess.run([NATIVE, "run", MIXED, *words], capture_output=True, text=True,
                                  timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 2, done.stdout)
            return done.stderr

        self.assertIn("--world: expected unix:PATH or tcp:PORT, found 'here'\n", refused("--world", "here"))
        self.assertIn("--world: cannot connect to unix:", refused("--world", f"unix:{self.path}"))
        run, _ = self.serve()
        world = f"unix:{self.folder / 'world'}"
        self.assertIn("'rackham' is driven by its modules in this run", refused("--world", world))
        self.assertIn("--world: expected a world with step_s=0.005", refused("--world", world, "--set", "world.step_ms=5"))
        self.assertEqual(run.end(), 0, run.told())

    def test_what_it_lacks_is_refused_and_told_once(self):
        run, client = self.serve(robots=("ada",))
        for line, reason in [("command v_m_s=1", "expected 'robot NAME' before 'command'"),
                             ("robot eve", "there is no robot 'eve'"),
                             ("robot rackham", "'rackham' is driven by its modules in this run: see "),
                             ("robot ada", "'ada' is moved by position reports")]:
            self.assertRegex(client.say(line), "^refused: .*world:[1-4]: " + re.escape(reason))
        self.assertEqual(client.say("robot bob"), "attached bob")
        other = self.connect(run, "world")
        self.assertRegex(other.say("robot bob"), "'bob' is attached to another connection$")
        for line, reason in [("laser eyes on", "'bob' has no laser 'eyes'"), ("laser eye maybe", "expected on or off, found 'maybe'"),
                             ("command v=1", "unknown key 'v'"), ("command v_m_s=nan", "expected 'v_m_s' to be a number"),
                             ("fly", "expected 'robot', 'command' or 'laser', found 'fly'")]:
            client.lines.write(line + "\n")
            client.lines.flush()
            while not (answer := client.lines.readline()).startswith("refused"):
                self.assertTrue(answer)
            self.assertIn(reason, answer)
        self.assertEqual(run.end(), 0, run.told())
        self.assertEqual(run.told().count(": expected 'robot NAME' before 'command'"), 1)
        self.assertIn("world: 2 connections, 0 commands, 10 malformed\n", run.output)


class Refusals(External):
    def test_without_real_time(self):
        external = ["--external", f"ada=unix:{self.path}"]
        self.assertEqual(self.refused(*external),
                         "waitpoint: --external: expected --speed 1: processes outside live in real time, found 'a run as "
                         "fast as possible'\n")
        self.assertIn("expected --speed 1", self.refused(*external, "--speed", "2"))
        for other in ["--ranks", "2"], ["--seeds", "1..2"], ["--check"]:
            self.assertIn(" cannot be used together with ", self.refused(*external, "--speed", "1", *other))
        (self.folder / "journal").write_text("")
        self.assertIn("repeats what came from outside",
                      self.refused(*external, "--speed", "1", "--replay-journal", self.folder / "journal"))
        self.assertIn("--external: expected waitpoint run: processes outside live in real time", self.refused(*external, command="explore"))
        self.assertFalse(self.path.exists())

    def test_of_names_and_addresses(self):
        def refused(*words):
            return self.refused("--speed", "1", *words)

        self.assertIn("--external: expected a robot of the scenario (rackham, ada, bob), found 'eve'\n",
                      refused("--external", f"eve=unix:{self.path}"))
        self.assertIn("expected ROBOT=unix:PATH or ROBOT=tcp:PORT, found 'ada'\n", refused("--external", "ada"))
        self.assertIn("expected unix:PATH or tcp:PORT, found 'udp:1'\n", refused("--external", "ada=udp:1"))
        self.assertIn("expected unix:PATH or tcp:PORT, found 'tcp:70000'\n", refused("--external", "ada=tcp:70000"))
        self.assertIn("expected each robot once, found 'ada' twice",
                      refused("--external", f"ada=unix:{self.path}", "--external", f"ada=unix:{self.folder / 'other'}"))
        self.assertIn("cannot listen at unix:/nowhere/at/all: No such file", refused("--external", "ada=unix:/nowhere/at/all"))
        self.assertIn("--reports: expected 'between' to be move or stay, found 'fly'\n",
                      refused("--external", f"ada=unix:{self.path}", "--reports", "between=fly"))
        self.assertIn("--reports: unknown key 'jump', did you mean 'jump_m'?\n",
                      refused("--external", f"ada=unix:{self.path}", "--reports", "jump=1"))
        self.assertIn("expected --external, whose reports they concern\n", refused("--reports", "jump_m=1"))
        self.assertIn("expected engine fcl or slice",
                      refused("--external", f"ada=unix:{self.path}", "--set", "world.engine=bullet"))

    def test_an_address_in_use_is_refused_and_one_left_behind_is_not(self):
        with socket.socket(socket.AF_UNIX) as left:
            left.bind(str(self.path))
            left.listen()
            self.assertIn("Address already in use", self.refused("--speed", "1", "--external", f"ada=unix:{self.path}"))
        run = self.start()
        self.assertRegex(self.connect(run).report(1, 10, 2), "^taken")
        self.assertEqual(run.end(), 0, run.told())
        self.assertFalse(self.path.exists())

    def test_tcp_listens_on_the_loopback_only(self):
        run = Run(self.folder, "--external", "ada=tcp:0")
        self.addCleanup(run.errors.close)
        while not (found := re.search(r"awaits position reports at tcp:(\d+)\n", run.told())):
            self.assertIsNone(run.process.poll(), run.told())
        port = int(found[1])
        with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S) as source:
            self.assertEqual(source.makefile().readline(), "waitpoint reports 1 ada\n")
        listening = [line.split()[1] for line in pathlib.Path("/proc/net/tcp").read_text().splitlines() if f":{port:04X} " in line
                     and line.split()[3] == "0A"]
        self.assertEqual(listening, [f"0100007F:{port:04X}"])
        self.assertEqual(run.end(), 0, run.told())


if __name__ == "__main__":
    main()
