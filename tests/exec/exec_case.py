# SPDX-License-Identifier: BSD-3-Clause
"""Shared parts of the tests of programs under waitpoint. The first argument of a test program is the build folder."""

import hashlib
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"


class Summary:
    """The summary line of a run."""

    def __init__(self, text):
        found = re.search(r"waitpoint: (\S+|\d+ programs): (?:\d+ processes, )?(\d+) threads?, (\d+) at once, (\d+) events?, (\d+) switch(?:es)?, "
                          r"([0-9.]+) s of virtual time, digest (wp1:[0-9a-f]{16})", text)
        if not found:
            raise AssertionError(f"no line about the run in: {text}")
        self.at_once, self.switches = int(found[3]), int(found[5])
        self.seconds, self.digest = float(found[6]), found[7]


def execute(seed, *command, stdin=None):
    """Returns the exit status, a hash of standard output, and the text of standard error."""
    words = [WAITPOINT, "exec", "--seed", seed, "--", *command]
    done = subprocess.run([str(word) for word in words], stdin=stdin, capture_output=True, timeout=300)
    return done.returncode, hashlib.sha256(done.stdout).hexdigest(), done.stderr.decode(errors="replace")


def explore(*words, stdin=subprocess.DEVNULL):
    command = [str(word) for word in (WAITPOINT, "explore", *words)]
    return subprocess.run(command, stdin=stdin, capture_output=True, text=True, timeout=300)


def replay_words(text):
    """The arguments of the last replay line of a report."""
    return shlex.split(re.findall(r"^replay: \S+ explore (.*)$", text, re.M)[-1])


COUNTER = """
#include <sys/prctl.h>
#include <x86intrin.h>
int main(void) {
  prctl(PR_SET_TSC, PR_TSC_SIGSEGV);
  __rdtsc();
  return 0;
}
"""


class ExecCase(unittest.TestCase):
    """`folder` is shared by all tests, and removed after them."""

    @classmethod
    def setUpClass(cls):
        if not (BUILD / "libwaitpoint-exec.so").exists():
            raise unittest.SkipTest("this build has no library for programs")
        if not hasattr(ExecCase, "folder"):
            folder = tempfile.TemporaryDirectory()
            unittest.addModuleCleanup(folder.cleanup)
            ExecCase.folder = pathlib.Path(folder.name)
            # A run's input is its working directory, too, if the program lists it, as Python does: nobody else changes this one.
            working = ExecCase.folder / "working"
            working.mkdir()
            os.chdir(working)
            unittest.addModuleCleanup(os.chdir, "/")

    def require_trapped_counter(self):
        """Skips the test on machines whose system does not trap the processor's counter, as some virtual ones."""
        program = self.folder / "counter"
        subprocess.run(["gcc", "-x", "c", "-", "-o", program], input=COUNTER, text=True, check=True)
        if subprocess.run([program]).returncode == 0:
            self.skipTest("PR_SET_TSC has no effect on this machine")

    def compile(self, source, *options):
        """The program compiled from a source beside this file, without waitpoint."""
        program = self.folder / pathlib.Path(source).stem
        compiler = "gcc" if source.endswith(".c") else "g++"
        if not program.exists():
            done = subprocess.run([compiler, "-O1", "-pthread", HERE / source, "-o", program, *options],
                                  capture_output=True, text=True)
            if done.returncode != 0:
                self.skipTest(done.stderr.splitlines()[0])
        return program
