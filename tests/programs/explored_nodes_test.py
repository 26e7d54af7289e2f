# SPDX-License-Identifier: BSD-3-Clause
"""Orders of nodes of ROS 1 are explored: explored_nodes_test.py BUILD.

Each planted bug of scenarios/nodes/planted passes in the default order, and fails in few others. Skipped where ROS is
missing: `./dev ros` installs it and builds these nodes.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
WAITPOINT = BUILD / "tools/waitpoint"
PLANTED = ROOT / "scenarios/nodes/planted"


def waitpoint(*words, cwd=None):
    return subprocess.run([WAITPOINT, *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, cwd=cwd)


class ExploredNodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (BUILD / "libwaitpoint-nodes.so").exists() or not (BUILD / "scenarios/nodes/locking_mapper").exists():
            raise unittest.SkipTest("no nodes of ROS were built: ./dev ros does")

    def passes_by_default(self, scenario):
        done = waitpoint("run", scenario, "--brief")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def find(self, scenario, *options):
        """The report of a search, and what the replay line of its finding says."""
        done = waitpoint("explore", scenario, "--iterations", "60", *options)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        line = re.search(r"^replay: .*?(explore .*)$", done.stdout, re.M)
        again = waitpoint(*[word.strip("'") for word in line[1].split(" ")])
        self.assertEqual(again.returncode, 1)
        self.assertIn("waitpoint: the same run as in the record", again.stderr)
        return done.stdout, again.stdout + again.stderr

    def test_a_lookup_at_start_throws(self):
        scenario = PLANTED / "early-lookup.yaml"
        self.passes_by_default(scenario)
        report, again = self.find(scenario, "--no-minimize")
        self.assertRegex(report, r"failed at [\d.]+ s: node /localisation ended by signal 6")
        self.assertIn("LookupException", again)

    def test_a_latched_map_is_missed(self):
        scenario = PLANTED / "missed-map.yaml"
        self.passes_by_default(scenario)
        report, again = self.find(scenario, "--no-minimize")
        self.assertRegex(report, r"failed at [\d.]+ s: 0 of 1 goals reached, expected all")
        self.assertIn("goals reached     0 of 1", again)

    def test_a_call_within_a_lock_is_a_deadlock(self):
        scenario = PLANTED / "lock-in-call.yaml"
        self.passes_by_default(scenario)
        report, again = self.find(scenario, "--no-minimize")
        self.assertRegex(report, r"/localiser: thread \d+ waits for the service /map_at, for 0\.")
        self.assertRegex(report, r"/mapper: thread \d+ waits for the service /where, for 0\.")
        self.assertRegex(again, r"/mapper: thread \d+ waits for a mutex that /mapper: thread \d+ holds")
        self.assertRegex(again, r"/localiser: thread \d+ waits for a mutex that /localiser: thread \d+ holds")

    def test_the_value_of_a_topic_is_a_property(self):
        scenario = PLANTED / "missed-map.yaml"
        report, again = self.find(scenario, "--no-minimize", "--property", "topic:/odom.pose.pose.position.x<=0.3")
        self.assertRegex(report, r"failed at [\d.]+ s: topic /odom is 0\.3\d*, expected /odom\.pose\.pose\.position\.x<=0\.3")
        self.assertIn("waitpoint: failed: topic /odom is 0.3", again)

    def test_tests_of_a_launch_file_take_part(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "package.xml").write_text("<package><name>checks</name></package>")
            check = folder / "check"
            check.write_text("#!/bin/sh\nexit $1\n")
            check.chmod(0o755)
            (folder / "checks.launch").write_text(
                '<launch><test test-name="it" name="it" pkg="checks" type="check" args="0"/>'
                '<test test-name="other" name="other" pkg="checks" type="check" args="3"/></launch>')
            text = (PLANTED / "early-lookup.yaml").read_text().replace("../../rackham.yaml", str(ROOT / "scenarios/rackham.yaml"))
            (folder / "checked.yaml").write_text(re.sub(r"    nodes:\n.*", "    launch: checks.launch\n", text))
            environment = dict(os.environ, ROS_PACKAGE_PATH=str(folder))
            done = subprocess.run([WAITPOINT, "run", "checked.yaml", "--set", "expect.tests=passed"], capture_output=True,
                                  text=True, cwd=folder, env=environment, stdin=subprocess.DEVNULL, timeout=300)
            self.assertEqual(done.returncode, 1)
            self.assertIn("not as expected: test /other ended with status 3", done.stderr)
            self.assertNotIn("test /it", done.stderr)
            self.assertIn("left after 0.0", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
