# SPDX-License-Identifier: BSD-3-Clause
"""Runs all benchmarks of a Meson build folder, one at a time.

`--json FILE` receives the rows of all of them. Other options go to the benchmarks that know them.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile


def known(command, options):
    """The options that `command --help` mentions, with their values."""
    text = subprocess.run([*command, "--help"], check=True, capture_output=True, text=True).stdout
    words, is_known = [], True
    for option in options:
        if option.startswith("-"):
            is_known = option.split("=")[0] in text.replace(",", " ").split()
        if is_known:
            words.append(option)
    return words


def main():
    build, options = sys.argv[1], sys.argv[2:]
    rows_file = None
    if "--json" in options[:-1]:
        at = options.index("--json")
        rows_file = pathlib.Path(options[at + 1])
        del options[at : at + 2]
    description = subprocess.run(["meson", "introspect", "--benchmarks", build], check=True, capture_output=True).stdout
    benchmarks = json.loads(description)
    if not benchmarks:
        print("dev: this build has no benchmarks", file=sys.stderr)
        return 1
    failed, rows = [], []
    with tempfile.TemporaryDirectory() as folder:
        for benchmark in benchmarks:
            name, command = benchmark["name"], benchmark["cmd"]
            print(f"== {name}", flush=True)
            environment = {**os.environ, **benchmark["env"]}
            own = pathlib.Path(folder) / f"{name}.json"
            options_of_it = known(command, options) + (["--json", str(own)] if rows_file else [])
            if subprocess.run(command + options_of_it, env=environment, cwd=benchmark["workdir"]).returncode:
                failed.append(name)
            elif rows_file:
                rows += json.loads(own.read_text())
    if rows_file:
        rows_file.write_text(json.dumps(rows, indent=1) + "\n")
    for name in failed:
        print(f"failed: {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
