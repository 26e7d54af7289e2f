# SPDX-License-Identifier: BSD-3-Clause
"""Robots outside take part in a run by reports of their positions, and its journal repeats it: external_test.py BUILD."""

import os
import pathlib
import re
import socket

from installed import main
from partners import MIXED, PATIENCE_S, External, Run, Source, waitpoint


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
        run = self.start(settings="jump_m=20")
        ada = self.connect(run)
        ada.report(1, 0.6, 2)
        ada.report(2, 0.3, 2)
        ada.report(3, 0.6, 2)
        ada.report(4, 0.6, 2)
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: stopped by a contact at (0.50, 2.00)\n", run.told())

    def test_jumps_and_occupied_places_are_reported(self):
        run = self.start()
        ada = self.connect(run)
        ada.report(1, 15, 2)
        ada.report(2, 12, 8)
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: jump of 5.00 m to (15.00, 2.00)\n", run.told())
        self.assertIn("ada: stays at (15.00, 2.00): 'bob' is in the way at the reported place (12.00, 8.00)\n", run.told())

    def test_reports_by_unix_and_virtual_time_have_their_lags(self):
        run = self.start(settings="late_s=0.05 between=stay")
        ada = self.connect(run)
        date = float(ada.report(1, 10, 2).split()[-1])
        self.assertRegex(ada.say(f"clock run\nreport stamp_s={date - 5} x_m=10 y_m=2 heading_rad=0"), "^taken")
        self.assertRegex(ada.say("report stamp_s=1e9 x_m=10 y_m=2 heading_rad=0"), "from the future")
        self.assertRegex(ada.say("clock unix\nreport stamp_s=1e9 x_m=10 y_m=2 heading_rad=0"), "^taken")
        self.assertEqual(run.end(), 0, run.told())
        self.assertRegex(run.told(), r"ada: reports are late: by 5(\.\d+)? s, more than 0.05 s\n")
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

    def test_a_source_that_connects_again_within_a_step_is_accepted(self):
        """A paused run takes in nothing: all of it comes before the next step."""
        run = self.start()
        ada = self.connect(run)
        self.assertRegex(ada.report(1, 10, 2), "^taken")
        run.type("pause\nstatus")
        while "ada: " not in run.process.stdout.readline():
            self.assertIsNone(run.process.poll(), run.told())
        ada.lines.write("report stamp_s=2 x_m=10 y_m=2 heading_rad=0\n")
        ada.close()
        again = Source(self.path, run, greeted=False)
        self.addCleanup(again.close)
        run.type("go")
        self.assertEqual(again.lines.readline(), "waitpoint reports 1 ada\n")
        self.assertRegex(again.report(1, 10, 2), "^taken")
        self.assertEqual(run.end(), 0, run.told())
        self.assertIn("ada: the connection to the source ended after 2 reports\nada: a source of reports is connected\n", run.told())

    def test_silence_is_reported_and_the_body_stays(self):
        run = self.start(settings="silent_s=0.05")
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


class Refusals(External):
    def test_without_real_time(self):
        external = ["--external", f"ada=unix:{self.path}"]
        self.assertEqual(self.refused(*external, "--speed", "max"),
                         "waitpoint: --external: expected --speed 1: processes outside live in real time\n")
        self.assertIn("expected --speed 1", self.refused(*external, "--speed", "2"))
        for other in ["--ranks", "2"], ["--seeds", "1..2"], ["--verify"]:
            self.assertIn(" cannot be used together with ", self.refused(*external, "--speed", "1", *other))
        (self.folder / "journal").write_text("")
        self.assertIn("repeats what came from outside",
                      self.refused(*external, "--speed", "1", "--replay-journal", self.folder / "journal"))
        self.assertIn("--external: is not an option of explore, but of run\n", self.refused(*external, command="explore"))
        self.assertFalse(self.path.exists())

    def test_refuses_bad_names_and_addresses(self):
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
        self.assertIn("--external: expected 'between' to be move or stay, found 'fly'\n",
                      refused("--external", f"ada=unix:{self.path} between=fly"))
        self.assertIn("--external: unknown key 'jump', did you mean 'jump_m'?\n",
                      refused("--external", f"ada=unix:{self.path} jump=1"))
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

    def test_the_address_of_a_regular_file_is_refused_and_the_file_stays(self):
        self.path.write_text("precious")
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for option in f"--external=ada=unix:{self.path}", f"--external=ada=unix:{pipe}", f"--serve-world=unix:{self.path}":
            self.assertIn("Address already in use", self.refused("--speed", "1", "--until", "0.1", option))
        self.assertEqual(self.path.read_text(), "precious")
        self.assertTrue(pipe.is_fifo())

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
