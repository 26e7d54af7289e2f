# SPDX-License-Identifier: BSD-3-Clause
"""All campaigns on data from outside the project, with their tables: campaign.py BUILD [--data FOLDER] [--brief].

Without the folder of data only what needs none runs: generated fields of cylinders. The last line sums the last lines of the
parts, "N passed, M failed".
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def parts(build, data, brief):
    waitpoint = build / "tools" / "waitpoint"
    if data.is_dir():
        yield "Rounds of six goals on real maps, by locate", ["maps.py", build, "--data", data, *(["--seeds", "1..3"] if brief else [])]
        yield "Logs of real robots", ["logs.py", build, "--data", data]
        yield "The BARN worlds", ["barn.py", "--waitpoint", waitpoint, "--seeds", "3" if brief else "20", "--brief"]
    yield "Generated fields of cylinders", ["barn.py", "--waitpoint", waitpoint, "--no-barn", "--generated",
                                            "10" if brief else "30", "--seeds", "1", "--brief"]
    for title, varied in ("Moving cylinders", []), ("Moving cylinders, varied", ["--varied"]):
        yield title, ["moving_cylinders.py", "--waitpoint", waitpoint, "--seeds", "3" if brief else "20", *varied]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path(os.environ.get("WAITPOINT_DATA", ROOT.parent / "shared" / "data")))
    parser.add_argument("--brief", action="store_true", help="fewer seeds")
    arguments = parser.parse_args()
    passed = failed = 0
    for title, command in parts(arguments.build, arguments.data.resolve(), arguments.brief):
        print(f"\n== {title}", flush=True)
        last = ""
        with subprocess.Popen([sys.executable, ROOT / "tests" / "real" / command[0], *command[1:]], stdout=subprocess.PIPE,
                              text=True) as run:
            for line in run.stdout:
                print(line, end="", flush=True)
                last = line.strip() or last
        counts = re.fullmatch(r"(\d+) passed, (\d+) failed", last)
        if counts is None:
            print(f"{command[0]} ended with status {run.returncode}")
            failed += 1
        else:
            passed, failed = passed + int(counts[1]), failed + int(counts[2])
    print(f"\n{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
