# SPDX-License-Identifier: BSD-3-Clause
"""Objects of a build folder: `compiled.py objects BUILD FOLDER` prints the objects compiled from the sources in FOLDER, as
named by Ninja."""

import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]


def commands(build):
    """The entries of the compile database for this repository's own sources, as (source, entry)."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = (build / entry["file"]).resolve()
        if source.is_relative_to(ROOT) and not source.is_relative_to(ROOT / "subprojects"):
            yield source.relative_to(ROOT), entry


def main():
    what, build, folder = sys.argv[1:]
    assert what == "objects", what
    print("\n".join(sorted(entry["output"] for source, entry in commands(pathlib.Path(build)) if str(source.parent) == folder)))


if __name__ == "__main__":
    main()
