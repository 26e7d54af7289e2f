# SPDX-License-Identifier: BSD-3-Clause
"""Logs of real robots through the modules: logs.py BUILD [--data FOLDER].

MIT CSAIL's log has an answer: the poses of its scans as GMapping corrected them. The displacements between them are the
relations: between a scan and the next ones within 20 s, and between scans at one place, nearer than 3 m and more than 20 s
apart, which are right only if the map closes. Of the Intel log only the trajectory's scans are counted.
"""

import argparse
import gzip
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Metres: the greatest mean errors of segloc with which the log passes.
WITHIN_20_S_M, AT_ONE_PLACE_M = 0.2, 0.1


def records(file, kind):
    with gzip.open(file, "rt") as lines:
        return [line.split() for line in lines if line.startswith(kind)]


def relations(data):
    stamps = [float(words[-1]) for words in records(data / "logs" / "mit_csail.gfs.gz", "LASER_READING")]
    poses = [tuple(map(float, words[363:366])) for words in records(data / "logs" / "mit_csail.corrected.log.gz", "FLASER")]
    assert len(stamps) == len(poses)

    def relation(i, j):
        (ax, ay, a), (bx, by, b) = poses[i], poses[j]
        dx, dy = bx - ax, by - ay
        turn = math.atan2(math.sin(b - a), math.cos(b - a))
        return (f"{stamps[i]:.6f} {stamps[j]:.6f} {dx * math.cos(a) + dy * math.sin(a):.6f} "
                f"{dy * math.cos(a) - dx * math.sin(a):.6f} 0 0 0 {turn:.6f}")

    pairs = [(i, j) for i in range(len(poses)) for j in range(i + 1, len(poses))]
    apart_m = lambda i, j: math.dist(poses[i][:2], poses[j][:2])
    return {"within 20 s": [relation(i, j) for i, j in pairs if stamps[j] - stamps[i] <= 20],
            "at one place": [relation(i, j) for i, j in pairs if stamps[j] - stamps[i] > 20 and apart_m(i, j) < 3]}


def replay(build, log, *options):
    run = subprocess.run([build / "tools" / "waitpoint", "play", log, "--summary", "-", *options], capture_output=True,
                         text=True)
    return json.loads(run.stdout) if run.returncode == 0 else {"failure": run.stderr.strip().splitlines()[-1]}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("--data", type=pathlib.Path, default=pathlib.Path(os.environ.get("WAITPOINT_DATA", ROOT.parent / "shared" / "data")))
    arguments = parser.parse_args()
    if not (arguments.data / "logs").is_dir():
        print(f"skipped: no folder {arguments.data / 'logs'}\n0 passed, 0 failed")
        return 0
    passed = failed = 0
    print(f"{'log':10} {'relations':14} {'pose':9} {'number':>7} {'mean m':>8} {'deviation m':>12} {'mean deg':>9} {'wall s':>7}")
    with tempfile.TemporaryDirectory() as folder:
        for name, rows in relations(arguments.data).items():
            file = pathlib.Path(folder) / "relations"
            file.write_text("\n".join(rows) + "\n")
            for pose in "segloc", "odometry":
                result = replay(arguments.build, arguments.data / "logs" / "mit_csail.gfs.gz", "--pose", pose,
                                "--relations", file)
                if "failure" in result:
                    failed += 1
                    print(f"{'mit_csail':10} {name:14} {pose:9} {result['failure']}")
                    continue
                found = result["relations"]
                error_m = found["translation_mean_m"]
                good = pose != "segloc" or error_m <= (WITHIN_20_S_M if "20" in name else AT_ONE_PLACE_M)
                passed, failed = passed + good, failed + (not good)
                print(f"{'mit_csail':10} {name:14} {pose:9} {found['relations']:7} {error_m:8.3f} "
                      f"{found['translation_deviation_m']:12.3f} {math.degrees(found['rotation_mean_rad']):9.2f} {result['wall_s']:7.1f}{'' if good else '  FAILED'}", flush=True)
    result = replay(arguments.build, arguments.data / "logs" / "intel_lab.clf.gz")
    good = result.get("scans") == 8894
    passed, failed = passed + good, failed + (not good)
    print(f"{'intel_lab':10} {result.get('scans', result.get('failure'))} scans, {result.get('simulated_s', 0):.0f} s, "
          f"{result.get('wall_s', 0):.1f} s of computing, digest {result.get('digest')}{'' if good else '  FAILED'}")
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
