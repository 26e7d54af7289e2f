# SPDX-License-Identifier: BSD-3-Clause
"""The time to the first failure of a program: by `waitpoint explore -- PROGRAM`, natively in a loop, and under rr's chaos mode.

A native run fails by a signal, by a status, or by hanging for HANG_S. The status 3 is a program's own for a library call that is
refused, such as one for a port that is still in use: that run is not counted.
"""

import contextlib
import functools
import shutil
import statistics
import subprocess
import sys
import time

LIMIT_S = 60
HANG_S = 5
REFUSED = 3

COLUMNS = ("program", "explore", "native loop", "beside `stress-ng --cpu 4`", "`rr record --chaos`")


def seconds(value):
    return f"{value:.2f} s" if value is not None else f"none in {LIMIT_S} s"


def explored(waitpoint, program, seeds):
    """The median of the seeds' times up to the line that tells of the first failure."""
    times = []
    for seed in seeds:
        begun = time.monotonic()
        command = [waitpoint, "explore", "--switch-at", "calls", "--iterations", "1000000", "--seed", str(seed), "--", program]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
            for line in process.stdout:
                if ": schedule " in line or line.startswith(("the default order failed", "waitpoint: the default order")):
                    times.append(time.monotonic() - begun)
                    break
            process.terminate()
    return seconds(statistics.median(times)) if times else seconds(None)


def looped(command):
    """The time to the run that fails, without that of its hanging; None if none does."""
    begun = time.monotonic()
    while time.monotonic() - begun < LIMIT_S:
        start = time.monotonic()
        try:
            status = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                    timeout=HANG_S).returncode
        except subprocess.TimeoutExpired:
            return start - begun
        if status not in (0, REFUSED):
            return time.monotonic() - begun
    return None


@contextlib.contextmanager
def stress():
    with subprocess.Popen(["stress-ng", "--quiet", "--cpu", "4"]) as process:
        try:
            yield
        finally:
            process.terminate()


@functools.cache
def rr_records():
    """False, with a line that says why, if rr is not installed or the machine has no counters for it."""
    if shutil.which("rr") is None:
        print("rr is not installed", file=sys.stderr)
        return False
    done = subprocess.run(["rr", "record", "--chaos", "true"], capture_output=True, text=True)
    if done.returncode != 0:
        print(f"rr cannot record here: {done.stderr.strip()}", file=sys.stderr)
    return done.returncode == 0


def row(waitpoint, program, native, seeds):
    cells = [native.name, explored(waitpoint, program, seeds), seconds(looped([native]))]
    if shutil.which("stress-ng") is None:
        cells.append("not installed")
    else:
        with stress():
            cells.append(seconds(looped([native])))
    cells.append(seconds(looped(["rr", "record", "--chaos", native])) if rr_records() else "not available")
    return "| " + " | ".join(cells) + " |"
