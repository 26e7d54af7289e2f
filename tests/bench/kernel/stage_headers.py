# SPDX-License-Identifier: BSD-3-Clause
"""Copies headers as an installation would lay them out: stage_headers.py ROOT STAMP HEADER...

The folder `installed` beside STAMP gets waitpoint/PATH-IN-THE-TREE for each. STAMP becomes a header that a program
includes, so that it is compiled again when one of them has changed.
"""

import pathlib
import shutil
import sys


def main():
    root, stamp = map(pathlib.Path, sys.argv[1:3])
    installed = stamp.parent / "installed" / "waitpoint"
    for header in map(pathlib.Path, sys.argv[3:]):
        copy = installed / header.resolve().relative_to(root.resolve())
        copy.parent.mkdir(parents=True, exist_ok=True)
        if not copy.exists() or copy.read_bytes() != header.read_bytes():
            shutil.copyfile(header, copy)
    stamp.write_text("#pragma once\n")


if __name__ == "__main__":
    main()
