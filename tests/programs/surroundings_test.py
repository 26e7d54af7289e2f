# SPDX-License-Identifier: BSD-3-Clause
"""What a module changes in the process is restored and named, and no other robot notices: surroundings_test.py BUILD."""

import os
import re
import subprocess

from installed import HERE, Installed, flags, main

FLOATS = {"rounding": "rounding of floating-point numbers",
          "flushing": "flushing of small numbers to zero of floating-point numbers",
          "exceptions": "enabled exceptions of floating-point numbers"}
OTHERS = {"locale": "the locale", "locale of C++": "the locale", "mask": "the signal mask",
          "closed output": "the descriptors of the standard streams", "other output": "the descriptors of the standard streams",
          "format": "the formats of the standard streams", "buffer": "the formats of the standard streams",
          "folder": "the current folder", "permissions": r"the mask of permissions \(umask\)"}
PHASES = {"constructor": "constructing module meddler of robot first", "destructor": "destroying module meddler of robot first"}
CODEL = "a permanent codel of main of module meddler"


class Surroundings(Installed):
    def setUp(self):
        self.program = self.compile("meddling", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        self.outputs = self.folder / self.id().rpartition(".")[2]
        self.outputs.mkdir()

    def run_with(self, change, place="constructor", *options, **environment):
        """In a folder of its own, where it leaves an output."""
        words = [self.program, "run", HERE / "meddling/meddling.yaml", "--set", f"robots.0.modules.meddler.change={change}",
                 "--set", f"robots.0.modules.meddler.place={place}", *options]
        return subprocess.run(words, cwd=self.outputs, capture_output=True, text=True, timeout=120, env={**os.environ, **environment})

    def digest(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return re.search(r"(?m)^  digest +(\S+)$", done.stdout)[1]

    def warnings(self, done):
        return re.findall(r"(?m)^waitpoint: warning: (.*)$", done.stderr)

    def test_changed_by_a_module_are_restored_and_named(self):
        usual = self.digest(self.run_with("none"))
        for place, phase in PHASES.items():
            for change, words in (FLOATS | OTHERS).items():
                with self.subTest(change=change, place=place):
                    done = self.run_with(change, place, "--events", f"{change} {place}")
                    self.assertEqual(self.digest(done), usual)
                    self.assertEqual(len(self.warnings(done)), 1, done.stderr)
                    self.assertRegex(self.warnings(done)[0], rf"^{phase} changes {words}; restored$")
                    self.assertTrue(os.access(self.outputs / f"{change} {place}", os.R_OK))

    def test_changed_by_a_constructor_that_throws_are_restored(self):
        done = self.run_with("closed output", "throwing constructor")
        self.assertEqual(done.returncode, 1)
        self.assertIn("descriptors of the standard streams; restored", done.stderr)

    def test_floating_point_modes_are_restored_after_codels(self):
        usual = self.digest(self.run_with("none"))
        for change, words in FLOATS.items():
            with self.subTest(change=change):
                done = self.run_with(change, "codel")
                self.assertEqual(self.digest(done), usual)
                self.assertEqual(self.warnings(done), [f"{CODEL} changes {words}; restored"])

    def test_changed_before_main_are_restored_and_named(self):
        usual = self.digest(self.run_with("none"))
        done = self.run_with("none", MEDDLING_EARLY="1")
        self.assertEqual(self.digest(done), usual)
        self.assertRegex(self.warnings(done)[0], "^the program, or a library that it loads, before main\\(\\) changes flushing")

    def test_changed_by_codels_are_named_by_a_verified_run(self):
        for change in "locale", "format", "folder", "permissions", "other output":
            with self.subTest(change=change):
                self.assertEqual(self.warnings(self.run_with(change, "codel")), [])
                done = self.run_with(change, "codel", "--verify")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(set(self.warnings(done)), {f"{CODEL} changes {OTHERS[change]}; restored".replace("\\", "")})

    def test_read_by_a_module_make_a_verified_run_differ(self):
        done = self.run_with("none", "codel", "--verify", "--set", "robots.1.modules.computer.reads_format=true")
        self.assertEqual(done.returncode, 1)
        self.assertIn("not the same run: the run in a perturbed process differs from the first", done.stdout)


if __name__ == "__main__":
    main()
