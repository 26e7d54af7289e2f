# SPDX-License-Identifier: BSD-3-Clause
"""Programs on the transports of ROS 2, Cyclone DDS and Fast DDS, in one simulation: dds_test.py BUILD.

Skipped where they are missing: `./dev ros2` installs them and builds examples/dds.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"
PROGRAMS = BUILD / "examples/dds"
NUMBER = 30
MAP = (f"server={PROGRAMS}/cyclone_map", "server"), (f"robot={PROGRAMS}/cyclone_map", "robot")

BY_UDP = [("FASTRTPS_DEFAULT_PROFILES_FILE", str(pathlib.Path(__file__).resolve().parents[2] / "examples/dds/udp.xml"))]
SLOW = "--own-machine", "--delay", "1000..20000"  # that messages overtake each other is likely then


def waitpoint(*words, environment=()):
    return subprocess.run([str(word) for word in (WAITPOINT, *words)], env={**os.environ, **dict(environment)}, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=120)


class Transports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (PROGRAMS / "cyclone_talker").exists() or not (PROGRAMS / "fast_talker").exists():
            raise unittest.SkipTest("no programs on DDS were built: ./dev ros2 does")
        if waitpoint("exec", "--own-machine", "--", "true").returncode != 0:
            raise unittest.SkipTest("the system allows no machine of its own")

    def heard(self, talker, listener, *options, quality=(), environment=()):
        """The numbers that the listener prints, and the digest."""
        done = waitpoint("exec", "--own-machine", *options, "--", f"talker={PROGRAMS}/{talker}_talker", NUMBER, "::",
                         f"listener={PROGRAMS}/{listener}_listener", NUMBER, *quality, environment=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line.split() for line in done.stdout.splitlines() if line != "nothing for 10 s"]
        for number, range_m in lines:
            self.assertEqual(float(range_m), 0.5 * int(number))
        return [int(number) for number, _ in lines], re.search("digest (wp1:[0-9a-f]{16})", done.stderr)[1]

    def test_one_seed_is_one_run_with_each_pair(self):
        for talker in ("cyclone", "fast"):
            for listener in ("cyclone", "fast"):
                with self.subTest(talker=talker, listener=listener):
                    first = self.heard(talker, listener, "--seed", 1)
                    # What is published before the two know each other is lost, nothing after that.
                    self.assertEqual(first[0], list(range(first[0][0], NUMBER)))
                    self.assertLess(first[0][0], 5)
                    self.assertEqual(self.heard(talker, listener, "--seed", 1), first)
                    self.assertNotEqual(self.heard(talker, listener, "--seed", 2)[1], first[1])

    def test_losses_are_seen_by_best_effort_readers(self):
        lossy = ("--loss", 0.1, "--delay", "100..400")
        for name, environment in (("cyclone", ()), ("fast", BY_UDP)):
            with self.subTest(name=name):
                some = self.heard(name, name, *lossy, environment=environment)
                self.assertNotEqual(some[0], list(range(some[0][0], NUMBER)))
                self.assertEqual(self.heard(name, name, *lossy, environment=environment), some)
                numbers, _ = self.heard(name, name, *lossy, quality=["reliable"], environment=environment)
                self.assertEqual(numbers, list(range(numbers[0], NUMBER)))

    def test_a_map_that_is_published_too_early_is_found_missing(self):
        programs = [*MAP[0], "::", *MAP[1]]
        found = waitpoint("explore", *SLOW, "--no-minimize", "--iterations", 100, "--", *programs)
        self.assertEqual(found.returncode, 1, found.stderr)
        self.assertIn("cyclone_map: the robot has no map", found.stdout)
        again = shlex.split(re.search(r"^replay: \S+ (.*)$", found.stdout, re.M)[1])
        self.assertIn("the same run as in the record", waitpoint(*again).stderr)

    def test_a_map_that_is_kept_for_late_subscribers_is_not_missed(self):
        programs = [*MAP[0], "mended", "::", *MAP[1], "mended"]
        found = waitpoint("explore", *SLOW, "--iterations", 10, "--", *programs)
        self.assertEqual(found.returncode, 0, found.stdout)


if __name__ == "__main__":
    unittest.main()
