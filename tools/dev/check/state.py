# SPDX-License-Identifier: BSD-3-Clause
"""Checks the process-wide state of the libraries: state.py ARCHIVE...

Simulations run in several threads of a process at once. So a variable that can be written is the thread's own
(thread_local), a member of what a simulation owns, or listed in state.table with the reason why threads may share it.
"""

import fnmatch
import pathlib
import re
import subprocess
import sys

TABLE = pathlib.Path(__file__).with_name("state.table")
SECTION = re.compile(r"^\s*\[\s*(\d+)\]\s+(\S+)\s+\S+\s+\S+\s+\S+\s+\S+\s+\S+\s+([A-Za-z]*)\s+\d+\s+\d+\s+\d+$")


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def shared_variables(object_file):
    """The names of variables in writable sections that are not a thread's own; those of the compiler's are left out."""
    writable = set()
    for line in output_of("readelf", "-SW", object_file).splitlines():
        match = SECTION.match(line)
        if match and "W" in match[3] and "T" not in match[3] and not match[2].startswith((".data.rel.ro", ".init_array")):
            writable.add(match[1])
    for line in output_of("readelf", "-sW", "-C", object_file).splitlines():
        words = line.split(maxsplit=7)
        if len(words) == 8 and words[3] == "OBJECT" and words[6] in writable:
            if not words[7].startswith(("guard variable for ", "DW.ref.", "std::__ioinit", "vtable for ", "typeinfo for ")):
                yield words[7]


def read_table():
    """(pattern, reason) of each line."""
    rows = []
    for number, line in enumerate(TABLE.read_text().splitlines(), 1):
        if line.strip() and not line.startswith("#"):
            pattern, _, reason = line.partition("  ")
            if not reason.strip():
                sys.exit(f"{TABLE}:{number}: expected a pattern, two blanks and a reason")
            rows.append((pattern, reason.strip()))
    return rows


def main():
    objects = sorted({name for archive in sys.argv[1:] for name in output_of("ar", "t", archive).split()})
    if not objects:
        sys.exit("no objects of the libraries given")
    rows, used, violations = read_table(), set(), []
    variables = {(name, object_file) for object_file in objects for name in shared_variables(object_file)}
    for name, object_file in sorted(variables):
        row = next((pattern for pattern, _ in rows if fnmatch.fnmatchcase(name, pattern.replace("[", "[[]"))), None)
        used.add(row)
        if row is None:
            violations.append(f"{pathlib.Path(object_file).name}: all threads share the variable {name}")
    # Other libraries are optional.
    own = [pattern for pattern, _ in rows if pattern.startswith("waitpoint::")]
    violations += [f"{TABLE.name}: no variable matches {pattern}" for pattern in own if pattern not in used]
    print(f"{len(objects)} objects, {len(variables)} variables that threads share, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
