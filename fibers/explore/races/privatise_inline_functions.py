# SPDX-License-Identifier: BSD-3-Clause
"""Makes the library waitpoint-races: privatise_inline_functions.py NM LD OBJCOPY AR OUTPUT ARCHIVE...

A program has one copy of each inline function. If the library uses it too, that copy may be the user's, compiled with
-fsanitize=thread: the library's own accesses would count as the running task's, and switches could interrupt them. So
the library is linked into one object with private copies of inline functions and uninstrumented calls of memcpy.
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
        # Weak functions of C++; weak C functions are meant to be replaced.
        inline.write_text("".join(f"{name}\n" for _, kind, name in symbols if kind == "W" and name.startswith("_Z")))
        # The statics of inline functions stay unique: the user's copies have others beside them, so ours must yield.
        unique.write_text("".join(f"{name}\n" for _, kind, name in symbols if kind == "u"))
        copies = [f"--redefine-sym={name}=__real_{name}" for name in ("memcpy", "memmove", "memset")]
        run(objcopy, f"--localize-symbols={inline}", f"--weaken-symbols={unique}", *copies, whole, own)
        pathlib.Path(output).unlink(missing_ok=True)
        run(ar, "rcs", output, own)


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


if __name__ == "__main__":
    main()
