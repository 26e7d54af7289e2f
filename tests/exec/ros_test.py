# SPDX-License-Identifier: BSD-3-Clause
"""ROS's master and nodes of Debian, in one simulation: ros_test.py BUILD [--long].

A shell script starts `rosmaster`, which is a Python program, and two nodes that are compiled here. Skipped where ROS is
missing. With --long: twenty runs of a seed, and their real time.
"""

import shutil
import socket
import statistics
import subprocess
import sys
import time
import unittest

from exec_case import ExecCase, HERE, Summary, WAITPOINT

LONG = "--long" in sys.argv and not sys.argv.remove("--long")
RUNS_OF_A_SEED = 20 if LONG else 2
NUMBERS = 100
SECONDS = 10


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Nodes(ExecCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if not shutil.which("rosmaster"):
            raise unittest.SkipTest("there is no rosmaster")
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "roscpp", "std_msgs"], capture_output=True, text=True)
        if flags.returncode != 0:
            raise unittest.SkipTest("there is no roscpp")
        for name in "talker", "listener":
            subprocess.run(["g++", "-O1", "-w", HERE / f"ros/{name}.cpp", "-o", cls.folder / name, *flags.stdout.split()], check=True)
        cls.port = free_port()

    def run_nodes(self, *command):
        shutil.rmtree(self.folder / "log", ignore_errors=True)
        words = [*command, "sh", HERE / "ros/launch.sh", self.folder, self.port]
        done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        heard = [int(line) for line in done.stdout.split()]
        # Nothing is lost once the listener is connected; before that, all is.
        self.assertEqual(heard, list(range(heard[0], NUMBERS)), done.stderr)
        self.assertGreater(heard[0], 0)
        self.assertLess(heard[0], 10)
        return done

    def simulate(self, seed):
        return self.run_nodes(WAITPOINT, "exec", "--seed", seed, "--")

    def test_run_in_virtual_time_and_repeat(self):
        real_seconds, digests = [], set()
        for _ in range(RUNS_OF_A_SEED):
            begin = time.monotonic()
            run = self.simulate(1)
            real_seconds.append(time.monotonic() - begin)
            summary = Summary(run.stderr)
            digests.add((summary.digest, run.stdout))
            self.assertGreater(summary.seconds, SECONDS)
            self.assertLess(summary.seconds, SECONDS + 1)
        self.assertEqual(len(digests), 1)
        digests.add((Summary(self.simulate(2).stderr).digest, run.stdout))
        self.assertEqual(len(digests), 2)
        if LONG:
            print(f"{RUNS_OF_A_SEED} runs of {SECONDS} s, {statistics.median(real_seconds):.2f} s each; first number heard: "
                  f"{run.stdout.split()[0]}", file=sys.stderr)

    @unittest.skipUnless(LONG, "takes ten seconds")
    def test_lose_as_many_numbers_natively(self):
        self.run_nodes()


if __name__ == "__main__":
    unittest.main()
