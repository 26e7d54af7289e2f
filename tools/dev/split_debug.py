# SPDX-License-Identifier: BSD-3-Clause
"""Moves the debugging information of what was installed into files of its own: split_debug.py OBJCOPY LIBDIR BINDIR.

For each shared library and program X of waitpoint's below LIBDIR and BINDIR: `.debug/X.debug` beside it, in which gdb and
addr2line look, and X without it. A file that was split or stripped before stays as it is. Run by Meson at the end of an
installation.
"""

import os
import pathlib
import subprocess
import sys


def installed(folders):
    """The shared libraries and programs of waitpoint's, links left out."""
    for folder in folders:
        for pattern in ("*waitpoint*", "waitpoint/*"):
            for path in sorted(folder.glob(pattern)):
                if path.is_file() and not path.is_symlink() and path.suffix != ".a":
                    with open(path, "rb") as file:
                        if file.read(4) == b"\x7fELF":
                            yield path


def split(objcopy, path):
    sections = subprocess.run(["readelf", "--section-headers", "--wide", path], check=True, capture_output=True, text=True).stdout
    if ".debug_line" not in sections:
        return
    debug = path.parent / ".debug" / (path.name + ".debug")
    debug.parent.mkdir(exist_ok=True)
    # Each is written beside its place first: an interrupted installation leaves no half file.
    written, stripped = debug.with_name(debug.name + ".new"), path.with_name(path.name + ".stripped")
    subprocess.run([objcopy, "--only-keep-debug", "--compress-debug-sections", path, written], check=True)
    os.chmod(written, 0o644)
    os.replace(written, debug)
    subprocess.run([objcopy, "--strip-unneeded", f"--add-gnu-debuglink={debug}", path, stripped], check=True)
    os.replace(stripped, path)


def main():
    objcopy, *folders = sys.argv[1:]
    prefix = pathlib.Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"])
    for path in installed([prefix / folder for folder in folders]):
        split(objcopy, path)


if __name__ == "__main__":
    main()
