# SPDX-License-Identifier: BSD-3-Clause
"""Installs headers for users' code: install_headers.py [--stamp FILE --depfile FILE] --to FOLDER ROOT FOLDER...

Each header of the FOLDERs of the tree ROOT is copied to TO/waitpoint/PATH-IN-THE-TREE, and its includes of the tree become
<waitpoint/...>: users need one include folder, and a `core/` of their own does not conflict. Headers that need the headers of FCL,
Bullet, Boost.Asio, Boost.Beast, yaml-cpp, nlohmann_json, zlib, Tcl or ROS are left out, as are those in tools/dev. A relative TO is one of
Meson's installation.
"""

import argparse
import os
import pathlib
import re

OWN = re.compile(r'^(\s*#\s*include\s*)"([^"]+)"', re.MULTILINE)
OF_OTHERS = re.compile(r"^\s*#\s*include\s*<(fcl|ccd|assimp|boost/(asio|beast)|bt|Bullet|LinearMath|yaml-cpp|nlohmann|zlib\.h|tcl\.h|"
                       r"ros/|xmlrpcpp/|[a-z0-9]+_msgs/)", re.MULTILINE)


def is_public(header, root, known):
    """True if neither the header nor its includes need a library that users may lack."""
    if header not in known:
        text = (root / header).read_text()
        known[header] = True  # breaks cycles
        known[header] = not OF_OTHERS.search(text) and all(is_public(name, root, known) for _, name in OWN.findall(text))
    return known[header]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--to", type=pathlib.Path, required=True)
    parser.add_argument("--stamp", type=pathlib.Path)
    parser.add_argument("--depfile", type=pathlib.Path)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("folders", nargs="+")
    arguments = parser.parse_args()
    root, known = arguments.root.resolve(), {}
    to = pathlib.Path(os.environ.get("MESON_INSTALL_DESTDIR_PREFIX", "")) / arguments.to
    found = sorted(path.relative_to(root) for folder in arguments.folders for path in (root / folder).rglob("*.h*"))
    headers = [header for header in found if not header.is_relative_to("tools/dev")]
    for header in headers:
        if not is_public(str(header), root, known):
            continue
        text = OWN.sub(r"\1<waitpoint/\2>", (root / header).read_text())
        copy = to / "waitpoint" / header
        copy.parent.mkdir(parents=True, exist_ok=True)
        if not copy.exists() or copy.read_text() != text:
            copy.write_text(text)
    if arguments.stamp:
        arguments.stamp.write_text("#pragma once\n")
        arguments.depfile.write_text(f"{arguments.stamp}: {' '.join(str(root / header) for header in headers)}\n")


if __name__ == "__main__":
    main()
