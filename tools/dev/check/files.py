# SPDX-License-Identifier: BSD-3-Clause
"""Checks every text file of the repository: files.py ROOT.

Each source must have an SPDX licence line among its first two, no note of unfinished work, and no path of a particular
machine. Sources of more than 400 lines get a warning.
"""

import os
import pathlib
import re
import sys

TEXT = {".cpp", ".hpp", ".py", ".sh", ".build", ".md", ".yaml", ".wrap", ".table", ".in"}
LICENSED = {".cpp", ".hpp", ".py", ".sh"}
SCRIPTS = {"dev", ".ci/run"}
NAMED = SCRIPTS | {"meson_options.txt", ".clang-tidy", ".clang-format"}
LINES_MAX = 400
LEFT = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
MACHINE_PATH = re.compile(r"(?<![\w.$}/-])/(home|root|work|tmp|Users|mnt|media)/[\w.-]")


def text_files(root, suffixes=frozenset(TEXT)):
    """Paths of the repository's files of these suffixes, relative to its root, without built, fetched and hidden ones."""
    for folder, folders, names in os.walk(root):
        here = pathlib.Path(folder).relative_to(root)
        folders[:] = sorted(
            name
            for name in folders
            if (not name.startswith(".") or name == ".ci")
            and not (here == pathlib.Path() and name.startswith("build"))
            and name != "node_modules"
            and not (here == pathlib.Path("subprojects") and name != "packagefiles")
            and name != "__pycache__"
        )
        for name in sorted(names):
            path = here / name
            if path.suffix in suffixes or (suffixes == TEXT and str(path) in NAMED):
                yield path


def main():
    root = pathlib.Path(sys.argv[1])
    violations = []
    warnings = []
    count = 0
    for path in text_files(root):
        count += 1
        lines = (root / path).read_text().splitlines()
        licensed = path.suffix in LICENSED or str(path) in SCRIPTS
        if licensed and not path.is_relative_to("subprojects"):
            if not any("SPDX-License-Identifier: BSD-3-Clause" in line for line in lines[:2]):
                violations.append(f"{path}:1: no line SPDX-License-Identifier: BSD-3-Clause")
            if len(lines) > LINES_MAX:
                warnings.append(f"{path}: {len(lines)} lines: a file holds one concept, in at most {LINES_MAX} lines")
        for number, line in enumerate(lines, 1):
            if LEFT.search(line):
                violations.append(f"{path}:{number}: a note of unfinished work: {line.strip()}")
            if MACHINE_PATH.search(line):
                violations.append(f"{path}:{number}: a path of a particular machine: {line.strip()}")
    print("".join(f"warning: {warning}\n" for warning in warnings), end="")
    print(f"{count} files, {len(warnings)} warnings, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
