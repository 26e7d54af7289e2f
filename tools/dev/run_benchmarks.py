# SPDX-License-Identifier: BSD-3-Clause
"""Runs every benchmark that Meson knows in a build folder, one after the other, with nothing beside it."""

import json
import os
import subprocess
import sys


def main():
    build, options = sys.argv[1], sys.argv[2:]
    description = subprocess.run(["meson", "introspect", "--benchmarks", build], check=True, capture_output=True).stdout
    benchmarks = json.loads(description)
    if not benchmarks:
        print("dev: there are no benchmarks in this build", file=sys.stderr)
        return 1
    failed = []
    for benchmark in benchmarks:
        print(f"== {benchmark['name']}", flush=True)
        environment = {**os.environ, **benchmark["env"]}
        if subprocess.run(benchmark["cmd"] + options, env=environment, cwd=benchmark["workdir"]).returncode:
            failed.append(benchmark["name"])
    for name in failed:
        print(f"failed: {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
