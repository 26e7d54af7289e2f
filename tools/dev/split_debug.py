# SPDX-License-Identifier: BSD-3-Clause
"""Moves the debugging information of what was installed into files of its own: split_debug.py OBJCOPY LIBDIR BINDIR.

For each shared library and program X of waitpoint's below LIBDIR and BINDIR: `.debug/X.debug` beside it, in which gdb and
addr2line look, and X without it. Nothing is left to do after `meson install --strip`. Run by Meson at the end of an installation.
"""

import os
import pathlib
import subprocess
import sys


def installed(folders):
    """The shared libraries and programs of waitpoint's, links left out."""
    for folder in folders:
        for pattern in ("*waitpoint*", "waitpoint/*.so*"):
            for path in sorted(folder.glob(pattern)):
                if path.is_file() and not path.is_symlink() and path.suffix != ".a":
                    with open(path, "rb") as file:
                        if file.read(4) == b"\x7fELF":
                            yield path


def split(objcopy, path):
    sections = subprocess.run([objcopy, "--dump-section", ".debug_line=/dev/null", path, "/dev/null"], capture_output=True)
    if sections.returncode != 0:
        return  # it has no debugging information
    debug = path.parent / ".debug" / (path.name + ".debug")
    debug.parent.mkdir(exist_ok=True)
    subprocess.run([objcopy, "--only-keep-debug", "--compress-debug-sections", path, debug], check=True)
    # Into a file beside it and then in its place: the installed one is never half written.
    stripped = path.with_name(path.name + ".stripped")
    subprocess.run([objcopy, "--strip-unneeded", f"--add-gnu-debuglink={debug}", path, stripped], check=True)
    os.chmod(debug, 0o644)
    os.replace(stripped, path)


def main():
    objcopy, *folders = sys.argv[1:]
    prefix = pathlib.Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"])
    for path in installed([prefix / folder for folder in folders]):
        split(objcopy, path)


if __name__ == "__main__":
    main()
