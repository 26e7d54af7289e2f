# SPDX-License-Identifier: BSD-3-Clause
"""The page of the view in Chromium: browser_test.py BUILD [--install].

Needs node, Chromium, and the packages of package.json, which --install gets by npm.
"""

import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def main(build, *options):
    if "--install" in options:
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=HERE, check=True)
    missing = [name for name in ("node", "chromium") if not shutil.which(name)]
    if not (HERE / "node_modules").exists():
        missing.append("packages of npm")
    if missing:
        print(f"not there: {', '.join(missing)}; ./dev test --view installs them")
        return 77
    program = pathlib.Path(build).resolve() / "tools/waitpoint"
    tests = sorted(str(path) for path in HERE.glob("*.test.mjs"))
    return subprocess.run(["node", "--test", *tests], env={**os.environ, "WAITPOINT_PROGRAM": str(program)}, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
