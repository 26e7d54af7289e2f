# SPDX-License-Identifier: BSD-3-Clause
"""A robot whose software is the navigation stack of ROS, as a workspace has it: move_base_test.py BUILD.

A test is skipped where its packages are not in ROS_PACKAGE_PATH (docs/ros-navigation.md).
"""

import pathlib
import re
import subprocess
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "scenarios/office-move-base.yaml"
MISSING = "(there is no package|the package .* has no executable) .*"


def run(*options):
    words = [BUILD / "tools/waitpoint", "run", SCENARIO, "--until", "25", "--set", "robots.0.goals=[[20,9.5]]", *options]
    return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)


def digests(done):
    return re.findall("wp1:[0-9a-f]{16}", done.stdout + done.stderr)


class MoveBase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (BUILD / "libwaitpoint-nodes.so").exists():
            raise unittest.SkipTest("this build has no nodes of ROS: ./dev ros")

    def drive(self, *options):
        first = run(*options)
        if missing := re.search(MISSING, first.stderr):
            self.skipTest(missing[0])
        self.assertIn("goals reached     1 of 1", first.stdout, first.stderr)
        self.assertIn("collisions        0", first.stdout)
        return first

    def test_drive_by_amcl_on_the_map_of_map_server(self):
        self.assertEqual(digests(self.drive()), digests(run()))

    # One run in sixty differs from the others (docs/ros-navigation.md): digests are not compared.
    def test_drive_on_the_map_that_gmapping_makes(self):
        self.drive("--set", "robots.0.launch.args.slam=true")


if __name__ == "__main__":
    unittest.main()
