# SPDX-License-Identifier: BSD-3-Clause
"""Runs of several processes, which must repeat, and be as natively."""

import re
import subprocess

from exec_case import ExecCase, Summary, WAITPOINT

PYTHON = "/usr/bin/python3"


class Run:
    def __init__(self, seed, *command, options=(), **more):
        words = [WAITPOINT, "exec", "--seed", seed, *options, "--", *command]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=120, **more)
        self.status, self.output, self.errors = done.returncode, done.stdout, done.stderr
        self.digest = Summary(self.errors).digest
        self.processes = int((re.search(r"(\d+) processes", self.errors) or [0, 1])[1])


class Families(ExecCase):
    def assertRepeats(self, *command, seeds=(1, 2, 3), **more):
        """The runs, two of each seed, which must be equal."""
        runs = []
        for seed in seeds:
            one, other = Run(seed, *command, **more), Run(seed, *command, **more)
            self.assertEqual((one.status, one.output, one.digest), (other.status, other.output, other.digest), one.errors)
            runs.append(one)
        return runs

    def assertNative(self, *command, **more):
        """Repeats, with the native output and status."""
        native = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120, **more)
        runs = self.assertRepeats(*command, **more)
        for run in runs:
            self.assertEqual((run.status, run.output), (native.returncode, native.stdout), run.errors)
        return runs
