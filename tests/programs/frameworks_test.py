# SPDX-License-Identifier: BSD-3-Clause
"""Tests of users' threads by Catch2 and doctest: frameworks_test.py BUILD."""

import os
import re
import shlex
import subprocess
import unittest

from installed import HERE, Installed, flags, main, run

HEADERS = {"catch2": "catch2/catch.hpp", "catch2_3": "catch2/catch_test_macros.hpp", "doctest": "doctest/doctest.h"}
LIBRARIES = {"catch2_3": ["-lCatch2Main", "-lCatch2"]}


class Frameworks(Installed):
    def program(self, framework, source=None):
        included = subprocess.run(["g++", "-std=c++20", "-fsyntax-only", "-x", "c++", "-"], text=True, capture_output=True,
                                  input=f"#if !__has_include(<{HEADERS[framework]}>)\n#error\n#endif\n")
        if included.returncode != 0:
            self.skipTest(f"{framework} is not installed")
        source = source or HERE / f"frameworks/{framework}.cpp"
        program = self.folder / source.stem
        run("g++", "-std=c++20", "-g", f"-I{HERE.parents[1]}", source, "-o", program,
            *LIBRARIES.get(framework, []), *flags(self.prefix, "--cflags", "--libs", "waitpoint"))
        return program

    def check(self, framework, only, *options, end=""):
        """Failures within the body are shown once, in the report of the test, without the exception that REQUIRE ends the body
        with; the report's line repeats the schedule; the framework adds `end` to a report."""
        program = self.program(framework)
        done = subprocess.run([program, *options], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        for expectation in (r"REQUIRE\( count_by_two_threads\(\) == 2 \): 1 == 2",
                            r"CHECK_FALSE\( count_by_two_threads\(\) < 2 \): .*1 <  ?2"):
            self.assertEqual(len(re.findall(r"seed 1 failed: expectation at .*" + expectation, done.stdout)), 1, done.stdout)
        self.assertNotIn("an exception escaped", done.stdout)
        replays = re.findall(r"replay: (WAITPOINT_REPLAY=\S+) (.*)" + end, done.stdout)
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

    def test_catch2_3(self):
        """Its usual reporter breaks lines at the 80th column."""
        self.check("catch2_3", ["passes"], "--reporter", "compact", end="'")

    def test_catch2_3_skips_no_test_from_within_a_body(self):
        skipping = self.folder / "skipping.cpp"
        skipping.write_text(f"""
#include <{HEADERS["catch2_3"]}>
#include <waitpoint/fibers/explore/explore.hpp>
TEST_CASE("skips") {{
  const auto report = waitpoint::explore([] {{ SKIP("too slow"); }});
  INFO(report);
  CHECK(report.passed);
}}
""")
        program = self.program("catch2_3", skipping)
        done = subprocess.run([program], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("too slow", done.stdout)

    def test_doctest(self):
        self.check("doctest", ["--test-case=passes*"])


if __name__ == "__main__":
    main()
