# SPDX-License-Identifier: BSD-3-Clause
"""The templates for continuous integration, examples/ci: ci_test.py BUILD."""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
SCRIPT = ROOT / "examples/ci/simulate.sh"
OFFICE = ROOT / "scenarios/office.yaml"


@unittest.skipUnless(shutil.which("jq"), "jq is not installed")
class Templates(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {**os.environ, "PATH": f"{BUILD / 'tools'}{os.pathsep}{os.environ['PATH']}"}

    def shell(self, *words, status=0):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300, cwd=self.folder,
                              env=self.environment, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout

    def test_a_summary_of_passing_schedules(self):
        summary = self.shell(SCRIPT, OFFICE, "--until", "60", "--iterations", "2", "--set", "expect.goals_reached=1")
        self.assertRegex(summary, r"\| 1 of 9 \| 0 \| 0\.\d{1,3} m \| `wp1:[0-9a-f]{16}` \|")
        self.assertIn("2 schedules passed.", summary)

    def test_options_of_a_run_are_for_the_run_and_the_exploration(self):
        shorter = ["--until=5", "--seed", "7", "--set", "expect.goals_reached=0"]
        summary = self.shell(SCRIPT, OFFICE, "--iterations", "1", *shorter, "--confined")
        run = json.loads((self.folder / "run.json").read_text())["result"]
        self.assertEqual((run["seed"], run["simulated_s"], run["unmet"]), (7, 5, []))
        self.assertIn("1 schedule passed.", summary)

    def test_a_failed_schedule_is_repeated_by_the_line_of_the_summary(self):
        summary = self.shell(SCRIPT, OFFICE, "--until", "5", "--iterations", "3", "--property", "position_error_max_m=0.0001",
                             status=1)
        self.assertIn("fails:** position error of", summary)
        replay = re.search(r"^    (waitpoint explore .*)$", summary, re.MULTILINE)[1]
        self.assertIn("the same run as in the record", self.shell(*shlex.split(replay), status=1))

    def test_a_failed_run_is_repeated_by_the_line_of_the_summary(self):
        scenario = self.folder / "hasty.yaml"
        for file in OFFICE.parent.glob("*.yaml"):
            shutil.copy(file, self.folder)
        scenario.write_text(re.sub(r"^until_s: .*$", "until_s: 5", OFFICE.read_text(), flags=re.MULTILINE))
        summary = self.shell(SCRIPT, scenario, "--iterations", "1", status=1)
        self.assertIn("**The run failed:** 0 of 9 goals reached", summary)
        replay = re.search(r"^    (waitpoint run .*)$", summary, re.MULTILINE)[1]
        self.assertIn("0 of 9", self.shell(*shlex.split(replay), status=1))

    def test_an_interrupted_exploration_is_reported(self):
        stand_in = self.folder / "bin/waitpoint"
        stand_in.parent.mkdir()
        stand_in.write_text(f"#!/bin/sh\n[ $1 = explore ] && set -- timeout 2 {BUILD}/tools/waitpoint \"$@\" || "
                            f"set -- {BUILD}/tools/waitpoint \"$@\"\nexec \"$@\"\n")
        stand_in.chmod(0o755)
        self.environment["PATH"] = f"{stand_in.parent}{os.pathsep}{self.environment['PATH']}"
        summary = self.shell(SCRIPT, OFFICE, "--until", "5", "--set", "expect.goals_reached=0", "--iterations", "1000000", status=1)
        self.assertRegex(summary, r"\*\*Exploring ended early:\*\* interrupted, after \d+ schedules\.")

    def test_bad_input_is_reported(self):
        (self.folder / "bad.yaml").write_text("nonsense: 1\n")
        self.assertIn("bad.yaml:1: expected key 'format: 1'", self.shell(SCRIPT, "bad.yaml", status=2))

    def test_the_templates_call_it(self):
        github = (ROOT / "examples/ci/github.yml").read_text()
        gitlab = (ROOT / "examples/ci/gitlab-ci.yml").read_text()
        self.assertIn('./simulate.sh scenarios/office.yaml --iterations 20 --jobs 2 >> "$GITHUB_STEP_SUMMARY"', github)
        self.assertIn("./simulate.sh scenarios/office.yaml --iterations 20 --jobs 2 > summary.md", gitlab)


if __name__ == "__main__":
    unittest.main()
