# SPDX-License-Identifier: BSD-3-Clause
"""What tests of programs under waitpoint have in common. The first argument of the test program is the build folder."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"


class ExecCase(unittest.TestCase):
    """`folder` is one for all tests, and gone behind them."""

    @classmethod
    def setUpClass(cls):
        if not (BUILD / "libwaitpoint-exec.so").exists():
            raise unittest.SkipTest("this build has no library for programs")
        if not hasattr(ExecCase, "folder"):
            folder = tempfile.TemporaryDirectory()
            unittest.addModuleCleanup(folder.cleanup)
            ExecCase.folder = pathlib.Path(folder.name)

    def compile(self, source, *options):
        """The program of a source beside this file, for nothing but the system."""
        program = self.folder / pathlib.Path(source).stem
        compiler = "gcc" if source.endswith(".c") else "g++"
        if not program.exists():
            done = subprocess.run([compiler, "-O1", "-pthread", HERE / source, "-o", program, *options],
                                  capture_output=True, text=True)
            if done.returncode != 0:
                self.skipTest(done.stderr.splitlines()[0])
        return program
