# SPDX-License-Identifier: BSD-3-Clause
"""Makes the library waitpoint-races: own_copies.py NM LD OBJCOPY AR OUTPUT ARCHIVE...

Of an inline function, a program keeps one copy for all: of one that the library uses too, it may be the user's, which
is compiled with -fsanitize=thread. Then the library's own steps would count as accesses of the task that takes them, and
would be torn apart by switches. So all of the library becomes one object, whose copies of inline functions are its own,
and whose use of memcpy is not told of.
"""

import pathlib
import subprocess
import sys
import tempfile


def main():
    nm, ld, objcopy, ar, output, *archives = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        whole, own, inline, unique = (
            pathlib.Path(folder) / name for name in ("whole.o", "waitpoint-races.o", "inline", "unique")
        )
        run(ld, "-r", "--force-group-allocation", "-o", whole, "--whole-archive", *archives)
        symbols = [line.split() for line in run(nm, "--defined-only", whole).splitlines()]
        # Weak functions; what is weak in C is meant to be replaced.
        inline.write_text("".join(f"{name}\n" for _, kind, name in symbols if kind == "W" and name.startswith("_Z")))
        # What inline functions keep stays one for all: the user's copies come with others, ours must give way.
        unique.write_text("".join(f"{name}\n" for _, kind, name in symbols if kind == "u"))
        copies = [f"--redefine-sym={name}=__real_{name}" for name in ("memcpy", "memmove", "memset")]
        run(objcopy, f"--localize-symbols={inline}", f"--weaken-symbols={unique}", *copies, whole, own)
        pathlib.Path(output).unlink(missing_ok=True)
        run(ar, "rcs", output, own)


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


if __name__ == "__main__":
    main()
