# SPDX-License-Identifier: BSD-3-Clause
"""Limits the length of C++ functions: functions.py ROOT. A body of more than LINES_MAX lines does more than one step.

A body is the text between the braces after a head with a parenthesis; comments, strings and characters are blanked first.
Lambdas count as functions, and as lines of the enclosing function.
"""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
from dependencies import sources  # noqa: E402

LINES_MAX = 70
# Heads of blocks that are not functions.
NO_FUNCTION = re.compile(
    r"\s*(\}|if\b|for\b|while\b|do\b|switch\b|else\b|case\b|default\b|namespace\b|class\b|struct\b|union\b|enum\b|extern\b|try\b)"
)
BLANKED = re.compile(
    r'R"(?P<end>[^()\s\\]*)\(.*?\)(?P=end)"|//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"|\b\d[\w\']*|\'(?:[^\'\\\n]|\\.)+\'', re.DOTALL
)


def blank(text):
    """The text without comments and literals, with the same number of lines."""
    return BLANKED.sub(lambda match: "\n" * match[0].count("\n"), text)


def closing_lines(lines):
    """{line with a trailing opening brace: line of its closing brace}, for blanked lines."""
    closed, opened = {}, []
    for at, line in enumerate(lines):
        for place, letter in enumerate(line):
            if letter == "{":
                opened.append(at if not line[place + 1 :].strip() else None)
            elif letter == "}" and opened:
                begin = opened.pop()
                if begin is not None:
                    closed[begin] = at
    return closed


def functions(text):
    """(number of the first line, lines of the body) of each function."""
    lines = blank(text).splitlines()
    for at, end in sorted(closing_lines(lines).items()):
        first = at  # of a head over several lines
        while first > 0 and lines[first - 1].strip() and not re.search(r"[;{}:]\s*$|^\s*#", lines[first - 1]):
            first -= 1
        head = " ".join(lines[first : at + 1])
        if not NO_FUNCTION.match(head) and ")" in head:
            yield first + 1, end - at - 1


def main():
    root = pathlib.Path(sys.argv[1])
    violations, count = [], 0
    for source in sources(root):
        for number, length in functions((root / source).read_text()):
            count += 1
            if length > LINES_MAX:
                violations.append(f"{source}:{number}: a function of {length} lines; at most {LINES_MAX}")
    print(f"{count} functions, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
