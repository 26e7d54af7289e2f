# SPDX-License-Identifier: BSD-3-Clause
"""Software in other processes drives robots in the world of a run, and its journal repeats it: served_world_test.py BUILD."""

import re
import socket
import subprocess
import unittest

from installed import BUILD, main
from partners import MIXED, PATIENCE_S, External

NATIVE = BUILD / "tools/waitpoint-native"


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
        client.lines.write("sensor battery on\n")
        client.lines.flush()
        battery = self.until(client, "reading")
        self.assertEqual((battery["sensor"], battery["empty"]), ("battery", "0"))
        self.assertEqual(battery["volts"][:2], "25")
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

    @unittest.skipUnless(NATIVE.exists(), "the build has no native library")
    def test_native_modules_end_at_a_scan_with_other_beams_than_the_lasers(self):
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(str(self.path))
            server.listen()
            server.settimeout(PATIENCE_S)
            native = subprocess.Popen([NATIVE, "run", MIXED, "--world", f"unix:{self.path}", "--until", str(PATIENCE_S)],
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.addCleanup(native.kill)
            client, _ = server.accept()
            with client:
                ranges = ",".join(["1"] * 5000)
                client.sendall(f"waitpoint world 1 mixed step_s=0.01\nattached rackham\n"
                               f"scan laser=laser number=1 first_angle_rad=0 angle_step_rad=0.1 range_max_m=8 range_m={ranges}\n"
                               "step 0.01\n".encode())
                client.shutdown(socket.SHUT_WR)
                _, errors = native.communicate(timeout=PATIENCE_S)
        self.assertEqual(native.returncode, 1, errors)
        self.assertRegex(errors, r"^waitpoint: the world's server:3: expected range_m with the \d+ ranges of laser 'laser', found 5000\n$")

    def test_bad_requests_are_refused(self):
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
                             ("fly", "expected 'robot', 'command' or 'sensor', found 'fly'")]:
            client.lines.write(line + "\n")
            client.lines.flush()
            while not (answer := client.lines.readline()).startswith("refused"):
                self.assertTrue(answer)
            self.assertIn(reason, answer)
        self.assertEqual(run.end(), 0, run.told())
        self.assertEqual(run.told().count(": expected 'robot NAME' before 'command'"), 1)
        self.assertIn("world: 2 connections, 0 commands, 10 malformed\n", run.output)


if __name__ == "__main__":
    main()
