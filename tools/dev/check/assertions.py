# SPDX-License-Identifier: BSD-3-Clause
"""Checks the density of assertions: assertions.py ROOT. assertions.table has the folders and their bounds."""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
from dependencies import sources  # noqa: E402
from functions import blank  # noqa: E402

ASSERTION = re.compile(r"\b(WAITPOINT_CHECK|WAITPOINT_FAST_CHECK|static_assert)\s*\(")


def bounds(table):
    """[(folder, assertions per 1 000 lines)] of the table's lines."""
    for line in table.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            folder, bound = line.split()
            yield pathlib.PurePath(folder), int(bound)


def main():
    root = pathlib.Path(sys.argv[1])
    folders = list(bounds(pathlib.Path(__file__).with_name("assertions.table")))
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
        density = 1000 * assertions / lines if lines else 0
        print(f"{folder}: {assertions} assertions in {lines} lines, {density:.1f} per 1 000")
        if density < bound:
            violations.append(f"{folder}: {density:.1f} assertions per 1 000 lines; at least {bound}")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
