# SPDX-License-Identifier: BSD-3-Clause
"""Lines of time of a viewed run, and what viewers see of changes: view_lines_test.py BUILD."""

import pathlib
import tempfile
import unittest

from installed import main
from viewed import OFFICE, PART, SECOND, Viewed, digest_in, run


class Lines(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_a_branch_is_another_run_which_its_journal_repeats(self):
        with Viewed(*PART, "--until", "20", "--serve-control") as viewed:
            viewed.wait_for_end_of_run()
            client = viewed.client()
            branch = client.ask("branch", line=0, time=5 * SECOND, interventions=["move rackham 20 6 90"])
            self.assertEqual(branch["line"], 1)
            moved = client.ask("seek", line=1, time=15 * SECOND)
            kept = client.ask("seek", line=0, time=15 * SECOND)
            self.assertEqual((moved["line"], kept["line"]), (1, 0))
            self.assertNotEqual(moved["robots"][0]["truth"], kept["robots"][0]["truth"])
            journal = client.ask("journal", line=1)
            different = client.ask("compare", line=0, **{"with": 1})
            self.assertTrue(5 * SECOND < different["time"] < 5.1 * SECOND, different)
            stopped = client.ask("branch", line=0, time=6 * SECOND, interventions=["request rackham ndd Stop"])["line"]
            client.ask("seek", line=stopped, time=8 * SECOND)
            different = client.ask("compare", line=0, **{"with": stopped})
            self.assertEqual((different["time"], different["b"]), (6_010_000_000, "operator of rackham: start"))
            same = client.ask("branch", line=0, time=5 * SECOND, interventions=[])["line"]
            client.ask("seek", line=same, time=12 * SECOND)
            self.assertEqual(client.ask("compare", line=0, **{"with": same}), {"id": client.asked, "event": None})
            self.assertIn("--replay-journal", journal["command"])
            refused = client.ask("branch", line=0, time=5 * SECOND, interventions=["move nobody 20 6 90"])
            self.assertIn("nobody", refused["error"])
        (self.folder / "journal").write_text(journal["text"])
        again = run(*PART, "--replay-journal", self.folder / "journal")
        self.assertNotIn("not the run of the journal", again.stderr)
        self.assertIn(digest_in(again.stdout), journal["text"])

    def test_a_branch_continues_beyond_the_run_with_the_results_of_its_interventions(self):
        with Viewed(*PART, "--until", "300", "--serve-control", "--speed", "1") as viewed:
            client = viewed.client()
            client.receive_until(lambda told: told.get("kind") == "status" and told.get("time", 0) > SECOND)
            line = client.ask("branch", line=0, time=SECOND, interventions=["move rackham 20 6 90", "move rackham 0 0"])["line"]
            self.assertEqual(client.ask("seek", line=line, time=100 * SECOND)["time"], 100 * SECOND)
            self.assertEqual(client.ask("counts", line=line)["periods"], 100)
            done, refused = [told["text"] for told in client.ask("journal", line=line)["outcomes"]]
            self.assertEqual(done, "operator: move rackham 20 6 90: done")
            self.assertRegex(refused, "operator: move rackham 0 0: refused, '.*' is in the way")

    def test_collisions_have_their_times(self):
        with Viewed("--until", "40", scenario=OFFICE.parent / "late-pom.yaml") as viewed:
            viewed.wait_for_end_of_run()
            (time, robot), = viewed.client().ask("counts", line=0)["collisions"]
            self.assertEqual(robot, 0)
            self.assertTrue(20 * SECOND < time < 40 * SECOND, time)

    def test_lines_of_one_run_are_compared_and_before_its_start_a_branch_is_the_line_that_it_leaves(self):
        def floor(line, second):
            frame = client.ask("seek", line=line, time=round(second * SECOND))
            return frame["events"], frame["robots"]

        with Viewed(*PART, "--until", "12", "--serve-control") as viewed:
            viewed.wait_for_end_of_run()
            client = viewed.client()
            branch = lambda line, second, *texts: client.ask("branch", line=line, time=second * SECOND,
                                                             interventions=list(texts))["line"]
            apart = lambda one, two: client.ask("compare", line=one, **{"with": two})
            stops = branch(0, 4, "request rackham ndd Stop")
            turns = branch(0, 6, "request rackham rflex GotoSpeed w_rad_s=0.5")
            later = branch(stops, 8, "request rackham rflex GotoSpeed w_rad_s=0.5")
            for line in (stops, turns, later):
                self.assertEqual(floor(line, 3), floor(0, 3))
                floor(line, 12)
            self.assertEqual(floor(later, 7), floor(stops, 7))
            self.assertNotEqual(floor(later, 7), floor(0, 7))
            self.assertNotEqual(floor(later, 9), floor(stops, 9))
            across = client.ask("events", line=later, **{"from": 3 * SECOND, "to": 9 * SECOND})
            self.assertEqual(across["first"] + len(across["t"]) - 1,
                             client.ask("seek", line=later, time=9 * SECOND - 1)["events"])
            for one, two, second in ((stops, turns, 4), (turns, later, 4), (later, stops, 8), (later, 0, 4)):
                self.assertTrue(second * SECOND < apart(one, two)["time"] < (second + 0.02) * SECOND, (one, two))
            self.assertIn("expected two lines", apart(stops, stops)["error"])
            early = client.ask("branch", line=later, time=2 * SECOND, interventions=[])
            self.assertEqual(client.receive_until(lambda pushed: len(pushed.get("lines", [])) > 4)["lines"][-1]["parent"], 0)
            self.assertEqual(early["line"], 4)
            client.ask("seek", line=later, time=3 * SECOND)
            self.assertNotIn("GotoSpeed", client.ask("journal", line=later)["text"])

    def test_a_branch_with_another_seed_is_another_run_which_its_journal_repeats(self):
        with Viewed(*PART, "--until", "12", "--serve-control") as viewed:
            viewed.wait_for_end_of_run()
            client = viewed.client()
            for seed in (7, 7, 8):
                client.ask("branch", line=0, time=5 * SECOND, interventions=[f"seed {seed}"])
            poses = [client.ask("seek", line=line, time=12 * SECOND)["robots"][0]["estimate"] for line in range(4)]
            self.assertEqual(poses[1], poses[2])
            self.assertEqual(len({tuple(pose) for pose in poses}), 3)
            self.assertEqual(client.ask("compare", line=1, **{"with": 2})["event"], None)
            journal = client.ask("journal", line=1)["text"]
        self.assertIn("at 5.010000000 seed 7", journal)
        (self.folder / "journal").write_text(journal)
        again = run(*PART, "--replay-journal", self.folder / "journal")
        self.assertNotIn("not the run of the journal", again.stderr)
        self.assertIn(digest_in(again.stdout), journal)

    def test_a_late_viewer_gets_all_earlier_changes(self):
        with Viewed(*PART, "--until", "8", "--serve-control") as viewed:
            viewed.wait_for_end_of_run()
            client = viewed.client()
            line = client.ask("branch", line=0, time=2 * SECOND, interventions=["move-obstacle crate 7 18 30"])["line"]
            crate = lambda line, second: next(
                (o for o in client.ask("seek", line=line, time=second * SECOND).get("obstacles", []) if o["name"] == "crate"),
                None)
            self.assertIsNone(crate(0, 6), "as in the header")
            self.assertIsNone(crate(line, 1))
            self.assertIsNotNone(crate(line, 6))
        with Viewed(*PART, "--until", "300", "--speed", "3") as viewed:
            early, late = viewed.client(), viewed.client()
            is_frame = lambda pushed: pushed.get("kind") == "frame"
            early.ask("follow", on=True)
            early.receive_until(lambda pushed: is_frame(pushed) and pushed["time"] > 4 * SECOND)
            late.ask("follow", on=True)
            first = late.receive_until(is_frame)
            self.assertTrue(first["whole"])
            self.assertTrue(first["robots"][0]["segments"] and first["robots"][0]["route"])


if __name__ == "__main__":
    main()
