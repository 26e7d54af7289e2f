# SPDX-License-Identifier: BSD-3-Clause
"""Tests of users' threads by Catch2 and doctest: frameworks_test.py BUILD."""

import os
import pathlib
import re
import shlex
import subprocess
import unittest

from installed import HERE, Installed, flags, main, run

HEADERS = {"catch2": "catch2/catch.hpp", "doctest": "doctest/doctest.h"}


class Frameworks(Installed):
    def program(self, framework):
        if not pathlib.Path("/usr/include", HEADERS[framework]).exists():
            self.skipTest(f"{framework} is not installed")
        program = self.folder / framework
        run("g++", "-std=c++20", "-g", f"-I{HERE.parents[1]}", HERE / f"frameworks/{framework}.cpp", "-o", program,
            *flags(self.prefix, "--cflags", "--libs", "waitpoint"))
        return program

    def check(self, framework, only):
        """Failures within the body are shown once, in the report of the test, whose line repeats the schedule."""
        program = self.program(framework)
        done = subprocess.run([program], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        for expectation in (r"REQUIRE\( count_by_two_threads\(\) == 2 \): 1 == 2",
                            r"CHECK_FALSE\( count_by_two_threads\(\) < 2 \): .*1 <  ?2"):
            self.assertEqual(len(re.findall(r"seed 1 failed: expectation at .*" + expectation, done.stdout)), 1, done.stdout)
        replays = re.findall(r"replay: (WAITPOINT_REPLAY=\S+) (.*)", done.stdout)
        self.assertEqual(len(replays), 2, done.stdout)
        for token, command in replays:
            variable, value = token.split("=", 1)
            again = subprocess.run(shlex.split(command), capture_output=True, text=True, timeout=120, cwd=self.folder,
                                   env={**os.environ, variable: value})
            self.assertIn("failed: expectation at", again.stdout)
            self.assertIn(f"{token} ", again.stdout)
        passing = run(program, *only, timeout=120)
        self.assertNotIn("FAILED", passing)

    def test_catch2(self):
        self.check("catch2", ["passes"])

    def test_doctest(self):
        self.check("doctest", ["--test-case=passes"])


if __name__ == "__main__":
    main()
