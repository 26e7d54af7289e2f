# SPDX-License-Identifier: BSD-3-Clause
"""Paced runs in which processes outside take part, and these processes."""

import json
import pathlib
import re
import socket
import subprocess
import tempfile
import unittest

from installed import BUILD, HERE

WAITPOINT = BUILD / "tools/waitpoint"
MIXED = HERE / "mixed/mixed.yaml"
PATIENCE_S = 120


class Run:
    """A paced run that waits for commands: `go` began it, `quit` ends it."""

    def __init__(self, folder, *options, scenario=MIXED):
        self.folder = folder
        self.errors = open(folder / "errors", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [WAITPOINT, "run", scenario, "--speed", "1", "--interactive", "--journal", folder / "journal", "--summary",
             folder / "summary.json", *options],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.type("go")

    def type(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def end(self):
        """Returns the exit status."""
        if self.process.poll() is None:
            try:
                self.type("quit")
            except BrokenPipeError:
                pass
        return self.wait()

    def wait(self):
        self.output, _ = self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode

    def told(self):
        """What the run has told on standard error, without the times."""
        self.errors.flush()
        return re.sub(r"(?m)^ *\d+\.\d+ s  ", "", (self.folder / "errors").read_text())

    def digest(self):
        return re.search(r"digest +(wp1:\w+)", self.output)[1]

    def summary(self, robot):
        robots = json.loads((self.folder / "summary.json").read_text())["robots"]
        return next(each for each in robots if each["name"] == robot)


class Source:
    """Connects to a run as soon as it listens."""

    def __init__(self, path, run, greeted=True):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(PATIENCE_S)
        while True:
            try:
                self.socket.connect(str(path))
                break
            except (FileNotFoundError, ConnectionRefusedError):
                if run.process.poll() is not None:
                    raise AssertionError(run.told()) from None
        self.lines = self.socket.makefile("rw", encoding="utf-8")
        self.greeting = self.lines.readline() if greeted else None

    def say(self, text):
        """Returns the answer to the last line."""
        self.lines.write(text + "\n")
        self.lines.flush()
        return self.lines.readline().strip()

    def report(self, stamp_s, x_m, y_m, more=""):
        return self.say(f"report stamp_s={stamp_s} x_m={x_m} y_m={y_m} heading_rad=0 {more}")

    def close(self):
        self.lines.close()
        self.socket.close()


def waitpoint(*words, **options):
    return subprocess.run([WAITPOINT, *map(str, words)], capture_output=True, text=True, timeout=PATIENCE_S, **options)


class External(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "ada"

    def start(self, *options, robots=("ada",), settings="", **more):
        addresses = [word for robot in robots
                     for word in ("--external", f"{robot}=unix:{self.folder / robot} {settings}".strip())]
        run = Run(self.folder, *addresses, *options, **more)
        self.addCleanup(run.errors.close)
        self.addCleanup(lambda: run.process.poll() is None and run.process.kill())
        return run

    def connect(self, run, endpoint="ada"):
        source = Source(self.folder / endpoint, run)
        self.addCleanup(source.close)
        return source

    def replay(self, *options):
        return waitpoint("run", MIXED, "--replay-journal", self.folder / "journal", *options)

    def refused(self, *words, scenario=MIXED, command="run"):
        done = waitpoint(command, scenario, *words)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr
