# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a concept has one home: names.py ROOT [TABLE].

The table (names.table) has names with the only folders in which they may stand, or `-` for a name that has given way to
another one, and, as `type NAME NUMBER`, the names of types that are declared in several headers, with how many. Comments
do not count.
"""

import collections
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from texts import code, report, rows, sources  # noqa: E402

TYPE = re.compile(r"^(?:class|struct|union|enum class|enum)\s+(?:\[\[\w+\]\] )?(\w+)(?:\s+final)?\s*(?::(?!:)[^;{]*)?\{", re.MULTILINE)


def main():
    root = pathlib.Path(sys.argv[1])
    table = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("names.table"))
    all_rows = list(rows(table, "NAME WORD [FOLDER...]"))
    limits = {name: int(limit) for kind, name, limit in (row for row in all_rows if row[0] == "type")}
    homes = [(name, re.compile(rf"(?<!\w){re.escape(name)}(?!\w)"), folders) for name, *folders in all_rows if name != "type"]
    types = collections.defaultdict(list)
    violations, named = [], set()
    for path, text in sources(root):
        text = code(text)
        for name, pattern, folders in homes:
            if match := pattern.search(text):
                named.add(name)
                if not any(path.is_relative_to(folder) for folder in folders):
                    violations.append(f"{path}:{text[:match.start()].count(chr(10)) + 1}: " + (
                        f"{name} has given way to another name" if folders == ["-"] else f"{name} stands in {' '.join(folders)} only"))
        if path.suffix == ".hpp":
            for name in set(TYPE.findall(text)):
                types[name].append(str(path))
    violations += [f"{table.name}: {name}: a name that stands nowhere" for name, _, folders in homes if name not in named and folders != ["-"]]
    for name, headers in sorted(types.items()):
        if len(headers) > limits.get(name, 1):
            violations.append(f"{name} is declared in {len(headers)} headers, at most {limits.get(name, 1)}: {' '.join(headers)}")
    for name, limit in limits.items():
        if len(types[name]) < limit:
            print(f"warning: {table.name}: type {name} {limit}: it is declared in {len(types[name])} headers only")
    return report(f"{len(types)} types, {len(homes)} names with a home", violations)


if __name__ == "__main__":
    sys.exit(main())
