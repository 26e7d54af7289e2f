# SPDX-License-Identifier: BSD-3-Clause
"""What a build folder compiles: `compiled.py sources BUILD` prints this repository's sources, each once;
`compiled.py objects BUILD FOLDER` the objects made of the sources in FOLDER, as Ninja names them."""

import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]


def main():
    what, build = sys.argv[1], pathlib.Path(sys.argv[2])
    found = set()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = (build / entry["file"]).resolve()
        if not source.is_relative_to(ROOT) or source.is_relative_to(ROOT / "subprojects"):
            continue
        if what == "sources":
            found.add(str(source.relative_to(ROOT)))
        elif source.parent == ROOT / sys.argv[3]:
            found.add(entry["output"])
    print("\n".join(sorted(found)))


if __name__ == "__main__":
    main()
