# SPDX-License-Identifier: BSD-3-Clause
"""Runs on a machine of their own, and their datagrams' losses and delays: own_machine_test.py BUILD."""

import shlex
import subprocess
import unittest

from exec_case import ExecCase, Summary, WAITPOINT, explore

NUMBER = 40
LIST_DEVICES = "import socket, os; print(*(name for _, name in socket.if_nameindex()), *os.listdir('/dev/shm'))"


def start(*words):
    command = [str(word) for word in (WAITPOINT, "exec", *words)]
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def run(*words):
    begun = start(*words)
    output, errors = begun.communicate(timeout=60)
    return begun.returncode, output, errors


class OwnMachine(ExecCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        status, _, errors = run("--own-machine", "--", "true")
        if status != 0:
            raise unittest.SkipTest(errors.splitlines()[0])

    def setUp(self):
        program = shlex.quote(str(self.compile("datagrams.c")))
        self.both = f"{program} receive & {program} send {NUMBER}; wait"
        self.three_ports = f"{program} port; {program} port; {program} port"

    def heard(self, *options):
        """Numbers and travelling times in microseconds, and the digest."""
        status, output, errors = run(*options, "--own-machine", "--", "sh", "-c", self.both)
        self.assertEqual(status, 0, errors)
        pairs = [line.split() for line in output.splitlines()]
        return [int(number) for number, _ in pairs], [float(time) for _, time in pairs], Summary(errors).digest

    def test_has_a_loopback_and_no_shared_memory_of_others(self):
        self.assertEqual(run("--own-machine", "--quiet", "--", "python3", "-c", LIST_DEVICES), (0, "lo\n", ""))

    def test_has_a_network_that_repeats(self):
        self.assertEqual(run("--strict", "--", "cat", "/proc/net/dev")[0], 125)
        status, output, errors = run("--strict", "--own-machine", "--", "cat", "/proc/net/dev")
        self.assertEqual(status, 0, errors)
        self.assertRegex(output, "(?s)^Inter-.* lo: *0 [^:]*$")

    def test_gives_ports_in_the_order_of_asking(self):
        _, output, _ = run("--own-machine", "--", "sh", "-c", self.three_ports)
        self.assertEqual(output.split(), ["32768", "32769", "32770"])

    def test_does_not_meet_another_run(self):
        alone = run("--own-machine", "--", "sh", "-c", self.both)
        together = [start("--own-machine", "--", "sh", "-c", self.both) for _ in range(2)]
        for each in together:
            output, errors = each.communicate(timeout=60)
            self.assertEqual((each.returncode, output, errors), alone)

    def test_is_new_in_each_explored_schedule(self):
        done = explore("--own-machine", "--iterations", 3, "--", "sh", "-c", ": & set -C; : > /dev/shm/made_once && wait")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, "^sh: [23] schedules")

    def test_loses_by_the_seed(self):
        self.assertEqual(self.heard()[0], list(range(NUMBER)))
        self.assertEqual(self.heard("--loss", 1)[0], [])
        some = self.heard("--loss", 0.5)
        self.assertGreater(len(some[0]), NUMBER / 5)
        self.assertLess(len(some[0]), NUMBER * 4 / 5)
        self.assertEqual(some, self.heard("--loss", 0.5))
        self.assertNotEqual(some[0], self.heard("--loss", 0.5, "--seed", 2)[0])

    def test_delays_within_the_interval(self):
        numbers, times, _ = self.heard("--delay", "200..700")
        # The last one arrives at its sender's end.
        self.assertEqual(numbers, list(range(NUMBER)))
        self.assertLess(times.pop(), 10)
        self.assertGreater(min(times), 200)
        self.assertLess(max(times), 710)
        self.assertGreater(max(times) - min(times), 300)

    def test_delays_change_the_order(self):
        numbers, _, _ = self.heard("--delay", "0..5000")
        self.assertEqual(sorted(numbers), list(range(NUMBER)))
        self.assertNotEqual(numbers, list(range(NUMBER)))

    def test_refuses_impossible_values(self):
        for option, value, expected in (("--loss", "1.5", "expected a probability from 0 to 1, found '1.5'"),
                                        ("--delay", "5..2", "expected microseconds from 0 to 1e9, or an interval US..US, found '5..2'"),
                                        ("--delay", "soon", "expected microseconds from 0 to 1e9, or an interval US..US, found 'soon'")):
            self.assertEqual(run(option, value, "--", "true"), (125, "", f"waitpoint: {option}: {expected}\n"))


if __name__ == "__main__":
    unittest.main()
