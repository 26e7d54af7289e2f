# SPDX-License-Identifier: BSD-3-Clause
"""Brings debian/libwaitpoint1.symbols up to a library: symbols.py LIBRARY VERSION [FILE].

Each function and object that LIBRARY (libwaitpoint.so.1) defines has a line with the first version that has it; new ones get VERSION.
Inline functions and instances of templates are in users' programs, too, and have one line for all. A name that is gone is
told, with status 1: programs that use it need another major version.
"""

import pathlib
import re
import subprocess
import sys

OF_PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "debian/libwaitpoint1.symbols"
HEAD = "libwaitpoint.so.1 libwaitpoint1 #MINVER#\n* Build-Depends-Package: libwaitpoint-dev\n"
TAIL = ' (regex|optional)"@Base$" 1.0.0~rc1\n'
LINE = re.compile(r'^ (?:\(c\+\+\)"(.+)@Base"|(\w+)@Base) (\S+)$')


def defined(library):
    """The names of strong symbols, demangled; those of C as they are."""
    listed = subprocess.run(["nm", "--dynamic", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    strong = "".join(f"{line[19:]}\n" for line in listed.splitlines() if line[17] in "TDBR")
    # As dpkg-gensymbols does; nm's own demangling abbreviates other types.
    return set(subprocess.run(["c++filt"], input=strong, check=True, capture_output=True, text=True).stdout.splitlines())


def main():
    library, version = sys.argv[1:3]
    file = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else OF_PACKAGE
    known = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if found := LINE.match(line):
            known[found[1] or found[2]] = found[3]
    names = defined(library)
    lines = []
    for name in sorted(names):
        written = f'(c++)"{name}@Base"' if "waitpoint::" in name else f"{name}@Base"
        lines.append(f" {written} {known.get(name, version)}\n")
    file.write_text(HEAD + "".join(lines) + TAIL)
    gone = sorted(set(known) - names)
    for name in gone:
        print(f"gone: {name}")
    sys.exit(1 if gone else 0)


if __name__ == "__main__":
    main()
