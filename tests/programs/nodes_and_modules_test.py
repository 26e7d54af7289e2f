# SPDX-License-Identifier: BSD-3-Clause
"""Modules and nodes of ROS on one robot: nodes_and_modules_test.py BUILD.

Skipped where ROS is missing: `./dev ros` installs it.
"""

import re
import subprocess
import unittest

from nodes_case import BUILD, NodesCase, ROOT, WAITPOINT

SCENARIO = ROOT / "scenarios/office-ros-modules.yaml"


class NodesAndModules(NodesCase):
    def run_it(self, *options):
        return subprocess.run([WAITPOINT, "run", SCENARIO, *options], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=120)

    def digest(self, done):
        return re.search(r"  digest +(wp1:\w+)", done.stdout).group(1)

    def test_modules_drive_by_a_node_s_positions_and_nodes_read_their_posters(self):
        journal = self.folder / "journal"
        done = self.run_it("--until", "45", "--journal", journal)
        self.assertIn("goals reached     1 of 5", done.stdout, done.stderr)
        self.assertIn("collisions        0", done.stdout)
        positions, odometries, scans, off = map(float, re.search(
            r"monitor: (\d+) positions, (\d+) odometries, (\d+) scans, the position at most (\S+) m off", done.stderr).groups())
        self.assertGreater(min(positions, odometries), 800)
        self.assertGreater(scans, 350)
        self.assertLess(off, 0.15)
        error = float(re.search(r"position error +mean \S+ m, greatest (\S+) m", done.stdout).group(1))
        self.assertLess(error, 0.15)
        repeated = self.run_it("--until", "45", "--replay-journal", journal)
        self.assertNotIn("monitor", repeated.stderr)
        self.assertEqual(self.digest(repeated), self.digest(done))

    def test_posters_that_cannot_be_topics(self):
        def refused(assignment):
            done = self.run_it("--until", "1", "--set", assignment)
            self.assertEqual(done.returncode, 2, done.stderr)
            return done.stderr

        of = "robots.rackham.ros.publish"
        self.assertRegex(refused(f"{of}={{pom.nothing: a}}"), r"no module writes poster 'pom\.nothing'")
        self.assertRegex(refused(f"{of}={{sick.segments: a}}"), r"poster 'sick\.segments' cannot be a topic: expected a position, ")
        self.assertRegex(refused(f"{of}={{pom.position: a-b}}"), r"expected the topic of 'pom\.position' to be a name of ROS: ")


if __name__ == "__main__":
    unittest.main()
