# SPDX-License-Identifier: BSD-3-Clause
"""Brings debian/*.symbols up to libraries that were built: symbols.py ROOT VERSION [FOLDER].

ROOT is a folder in which the libraries of one build are, at any depth: packages that were unpacked, or debian/tmp. Each function
and object of the interface has a line with the first version that has it; new ones get VERSION. One line covers the rest, inline
functions and instances of templates among it; a program that uses some of it needs VERSION. A name of the interface that is gone is
told, with status 1: programs that use it need another major version. The files are those in debian/, or in FOLDER.
"""

import pathlib
import re
import subprocess
import sys

OF_PACKAGES = pathlib.Path(__file__).resolve().parents[2] / "debian"
# Names in waitpoint itself, and in those namespaces below it that pages of the documentation use.
OF_ROBOTS = re.compile(r"waitpoint::(?:[A-Z~]|\w+(?:\[abi:\w+\])?\(|operator\b|(?:genom|ndd|pom|posters|run)::)")
EVERYTHING = re.compile("")
LIBRARIES = {
    "libwaitpoint1": {"libwaitpoint.so.1": EVERYTHING},
    "libwaitpoint-robots1": {"libwaitpoint-robots-native.so.1": OF_ROBOTS, "libwaitpoint-robots.so.1": OF_ROBOTS},
}
LINE = re.compile(r'^ (?:\(c\+\+\)"(.+)@Base"|(\w+)@Base) (\S+)$')


def defined(library):
    """The names of strong symbols, demangled; those of C as they are."""
    listed = subprocess.run(["nm", "--dynamic", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    strong = "".join(f"{line[19:]}\n" for line in listed.splitlines() if line[17] in "TDBR")
    # As dpkg-gensymbols does; nm's own demangling abbreviates other types.
    return set(subprocess.run(["c++filt"], input=strong, check=True, capture_output=True, text=True).stdout.splitlines())


def known(file):
    """The first version of each name, by library."""
    found, of_library = {}, {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if named := LINE.match(line):
            of_library[named[1] or named[2]] = named[3]
        elif line.startswith("lib"):
            of_library = found[line.split()[0]] = {}
    return found


def found_below(root, library):
    file = next(root.rglob(library), None)
    if file is None:
        sys.exit(f"{root}: expected {library} in it, found none")
    return file


def section(package, library, names, versions, version):
    """The lines of a library."""
    lines = [f"{library} {package} #MINVER#", f"* Build-Depends-Package: {package.removesuffix('1')}-dev"]
    for name in sorted(names):
        written = f'(c++)"{name}@Base"' if "waitpoint::" in name else f"{name}@Base"
        lines.append(f" {written} {versions.get(name, version)}")
    lines.append(f' (regex|optional)"@Base$" {version}')
    return "".join(f"{line}\n" for line in lines)


def main():
    root, version = pathlib.Path(sys.argv[1]), sys.argv[2]
    folder = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else OF_PACKAGES
    gone = 0
    for package, libraries in LIBRARIES.items():
        file = folder / f"{package}.symbols"
        earlier, text = known(file), ""
        for library, interface in libraries.items():
            names = {name for name in defined(found_below(root, library)) if interface.match(name)}
            versions = earlier.get(library, {})
            text += section(package, library, names, versions, version)
            for name in sorted(set(versions) - names):
                gone += 1
                print(f"gone: {name} of {library}")
        file.write_text(text)
    sys.exit(1 if gone else 0)


if __name__ == "__main__":
    main()
