# SPDX-License-Identifier: BSD-3-Clause
"""Sources as code and comments, and tables of words, for the checks of names and words."""

import re
import sys

sys.dont_write_bytecode = True
from files import text_files  # noqa: E402

FOLDERS = ("core", "fibers", "world", "modules", "tools")
C_LIKE = {".cpp", ".hpp", ".c", ".h", ".js", ".mjs", ".css"}
# A literal, or a comment in group 1.
C_PARTS = re.compile(r'R"(?P<end>[^()\s\\]*)\(.*?\)(?P=end)"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|(//[^\n]*|/\*.*?\*/)', re.DOTALL)
SCRIPT_PARTS = re.compile(r'(?<![\w)\]])("""(?:.*?)"""|(?:(?<=\s)|^)#[^\n]*)', re.DOTALL | re.MULTILINE)


def sources(root, suffixes=C_LIKE):
    """(path relative to root, text) of the sources in the project's folders."""
    for path in text_files(root, suffixes):
        if path.parts[0] in FOLDERS:
            yield path, (root / path).read_text(errors="replace")


def comments(path, text):
    """The comments of a source, as one text."""
    if path.suffix in C_LIKE:
        return "\n".join(match[2] for match in C_PARTS.finditer(text) if match[2])
    return "\n".join(match[1] for match in SCRIPT_PARTS.finditer(text))


def code(text):
    """A C-like source without its comments, with the same number of lines."""
    return C_PARTS.sub(lambda match: "\n" * match[0].count("\n") if match[2] else match[0], text)


def rows(table, form):
    """The words of each row of a table; `form` says what a row is, "NAME NUMBER [NAME...]"."""
    expected = form.split()
    for number, line in enumerate(table.read_text().splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        is_open = expected[-1].endswith("...]")
        least = len(expected) - is_open
        numbers = [words[i] for i in range(min(least, len(words))) if expected[i] == "NUMBER"]
        if len(words) < least or (len(words) > least and not is_open) or not all(n.isdigit() for n in numbers):
            print(f"{table.name}:{number}: expected {form}, found '{line.strip()}'")
            sys.exit(1)
        yield words


def report(summary, violations):
    """Prints both; the exit status."""
    print(f"{summary}, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0
