# SPDX-License-Identifier: BSD-3-Clause
"""Limits the number of sources that name each sensor: sensors.py ROOT [TABLE].

A sensor is one declaration: what iterates the list of sensors names none of them. The table (sensors.table) has a limit
and the names of each sensor. Comments do not count.
"""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
from texts import code, report, rows, sources  # noqa: E402


def main():
    root = pathlib.Path(sys.argv[1])
    table = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("sensors.table"))
    sensors = [(name, int(limit), re.compile("|".join(names))) for name, limit, *names in rows(table, "SENSOR NUMBER PATTERN [PATTERN...]")]
    files = {name: [] for name, _, _ in sensors}
    for path, text in sources(root, {".cpp", ".hpp", ".js"}):
        text = code(text)
        for name, _, pattern in sensors:
            if pattern.search(text):
                files[name].append(str(path))
    violations = []
    for name, limit, _ in sensors:
        if not files[name]:
            violations.append(f"{table.name}: {name}: a sensor that no source names")
        if len(files[name]) > limit:
            violations.append(f"{name} is named in {len(files[name])} sources, at most {limit}: {' '.join(files[name])}")
    return report("".join(f"{name} in {len(found)} sources, " for name, found in files.items()) + f"{len(sensors)} sensors", violations)


if __name__ == "__main__":
    sys.exit(main())
