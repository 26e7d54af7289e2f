# SPDX-License-Identifier: BSD-3-Clause
"""Checks the names of tests: test_names.py ROOT.

A GoogleTest case is PascalCase and states a behaviour: `Children.AreKilledAtTheirTimeLimits`. A name that begins with a
clause (What..., Who..., Of..., That...) or has Nobody in the place of a noun is a riddle, also in Python.
"""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
from files import text_files  # noqa: E402
from texts import report  # noqa: E402

CASE = re.compile(r"^\s*(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
METHOD = re.compile(r"^\s*def (test_\w+)\(", re.MULTILINE)
PASCAL = re.compile(r"(DISABLED_)?[A-Z][A-Za-z0-9]*")
RIDDLE = re.compile(r"(What|Who|Whom|Whose|Whether|Which|Of|That)[A-Z]|.*(Who|Whom|Nobody|Somebody)([A-Z]|$)")
METHOD_RIDDLE = re.compile(r"test_(what|who|whom|whose|whether|which|of|that)_|test_(\w+_)?(who|whom|nobody|somebody)(_|$)")


def violation_of(suite, case):
    if not PASCAL.fullmatch(case):
        return f"{suite}.{case}: expected PascalCase"
    if RIDDLE.match(case):
        return f"{suite}.{case}: expected a behaviour, with a noun in place of the clause"
    return None


def main():
    root = pathlib.Path(sys.argv[1])
    violations, count = [], 0
    for path in text_files(root, {".cpp", ".hpp", ".py"}):
        if path.parts[0] != "tests":
            continue
        text = (root / path).read_text()
        if path.suffix == ".py":
            names = METHOD.findall(text)
            found = [f"{name}: expected a behaviour, with a noun in place of the clause" for name in names if METHOD_RIDDLE.match(name)]
        else:
            names = CASE.findall(text)
            found = [violation for case in names if (violation := violation_of(*case))]
        count += len(names)
        violations += [f"{path}: {violation}" for violation in found]
    return report(f"{count} tests", violations)


if __name__ == "__main__":
    sys.exit(main())
