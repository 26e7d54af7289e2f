# SPDX-License-Identifier: BSD-3-Clause
"""Checks the density of assertions: assertions.py ROOT [TABLE]. The table (assertions.table) has
the folders and their bounds."""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
from dependencies import sources  # noqa: E402
from functions import blank  # noqa: E402

ASSERTION = re.compile(r"\b(WAITPOINT_CHECK|WAITPOINT_REQUIRE|WAITPOINT_FAST_CHECK|static_assert)\s*\(")


def bounds(table):
    """[(folder, assertions per 1 000 lines)] of the table's lines."""
    for number, line in enumerate(table.read_text().splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        if len(words) != 2 or not words[1].isdigit():
            print(f"{table.name}:{number}: expected FOLDER NUMBER, found '{line.strip()}'")
            sys.exit(1)
        yield pathlib.PurePath(words[0]), int(words[1])


def main():
    root = pathlib.Path(sys.argv[1])
    folders = list(bounds(pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("assertions.table"))))
    counts = {folder: [0, 0] for folder, _ in folders}
    for source in sources(root):
        text = (root / source).read_text()
        for folder in counts:
            if pathlib.PurePath(source).is_relative_to(folder):
                counts[folder][0] += len(ASSERTION.findall(blank(text)))
                counts[folder][1] += text.count("\n")
    violations = []
    for folder, bound in folders:
        assertions, lines = counts[folder]
        if not lines:
            violations.append(f"{folder}: a folder without sources")
            continue
        density = 1000 * assertions / lines
        print(f"{folder}: {assertions} assertions in {lines} lines, {density:.1f} per 1 000")
        if density < bound:
            violations.append(f"{folder}: {density:.1f} assertions per 1 000 lines; at least {bound}")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
