# SPDX-License-Identifier: BSD-3-Clause
"""Files of a test in a folder of its own, on which a checker of tools/dev/check runs."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class InATemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def check(self, part, *arguments):
        """Runs one checker on the folder; returns (status, output)."""
        command = [sys.executable, str(ROOT / f"tools/dev/check/{part}.py"), *(arguments or [str(self.folder)])]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout
