# SPDX-License-Identifier: BSD-3-Clause
"""Nodes of rclcpp in one simulation: rclcpp_test.py BUILD FOLDER.

FOLDER is a workspace in which the nodes of examples/ros2 are installed (docs/ros2.md).
"""

import pathlib
import re
import subprocess
import sys
import unittest

FOLDER = pathlib.Path(sys.argv.pop(2)).resolve()
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"
NODES = FOLDER / "install/lib/example_ros2_nodes"
IN_ENVIRONMENT = ("sh", "-c", '. "$0/install/setup.sh" && exec "$@"', FOLDER)
RUNS_OF_A_SEED = 5


class Nodes(unittest.TestCase):
    def run_nodes(self, seed, *words, options=()):
        """What the nodes print, the seconds of virtual time and the digest."""
        command = [*IN_ENVIRONMENT, WAITPOINT, "exec", "--own-machine", "--seed", seed, *options, "--", *words]
        done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.search("([0-9.]+) s of virtual time, digest (wp1:[0-9a-f]{16})", done.stderr)
        return done.stdout.splitlines(), float(found[1]), found[2]

    def test_a_talker_is_heard_in_virtual_time(self):
        pair = f"listener={NODES}/listener", "::", f"talker={NODES}/talker", 20
        runs = [self.run_nodes(1, *pair) for _ in range(RUNS_OF_A_SEED)]
        self.assertEqual(runs, [runs[0]] * RUNS_OF_A_SEED)
        lines, _, digest = runs[0]
        self.assertEqual([line.split(" ", 1)[1] for line in lines], [f"sentence {i}" for i in range(20)])
        for i, line in enumerate(lines):
            self.assertAlmostEqual(float(line.split()[0]), 0.1 * (i + 1), delta=0.001)
        self.assertNotEqual(self.run_nodes(2, *pair)[2], digest)

    def test_a_managed_node_speaks_while_it_is_active(self):
        three = (f"listener={NODES}/listener", "::", f"talker={NODES}/managed_talker", "::", f"manager={NODES}/manager")
        for options in ((), ("--loss", 0.05, "--delay", "100..400")):
            runs = [self.run_nodes(1, *three, options=options) for _ in range(RUNS_OF_A_SEED)]
            self.assertEqual(runs, [runs[0]] * RUNS_OF_A_SEED)
            lines = runs[0][0]
            self.assertEqual([line for line in lines if line.startswith("transition")],
                             [f"transition {number}: done" for number in (1, 3, 4, 2, 5)])
            heard = [line for line in lines if "managed sentence" in line]
            self.assertGreater(len(heard), 5)
            self.assertLess(len(heard), 12)


if __name__ == "__main__":
    unittest.main()
