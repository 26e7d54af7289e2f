# SPDX-License-Identifier: BSD-3-Clause
"""Limits the share of vague words in comments: words.py ROOT [TABLE].

A comment that says "what is measured" in place of "the measured time" makes its reader solve a riddle. The table
(words.table) has the limit of each folder.
"""

import collections
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from texts import C_LIKE, comments, report, rows, sources  # noqa: E402

VAGUE = re.compile(r"\b(what|who|whom|whose|whether|nobody|somebody)\b", re.IGNORECASE)
WORD = re.compile(r"[A-Za-z][A-Za-z'-]*")
WORDS_MIN = 250  # in fewer words a share says nothing


def folder_of(path):
    return "/".join(path.parts[:2]) if len(path.parts) > 2 else path.parts[0]


def main():
    root = pathlib.Path(sys.argv[1])
    table = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("words.table"))
    limits = {folder: int(limit) for folder, limit in rows(table, "FOLDER NUMBER")}
    counts = collections.defaultdict(lambda: [0, 0])
    for path, text in sources(root, C_LIKE | {".py", ".sh"}):
        said = comments(path, text)
        counts[folder_of(path)][0] += len(VAGUE.findall(said))
        counts[folder_of(path)][1] += len(WORD.findall(said))
    violations = [f"{table.name}: {folder}: a folder without comments" for folder in limits if folder not in (*counts, "*")]
    for folder, (vague, words) in sorted(counts.items()):
        limit = limits.get(folder, limits["*"])
        if words >= WORDS_MIN and 1000 * vague > limit * words:
            violations.append(f"{folder}: {1000 * vague / words:.1f} of 1 000 words of comments are what, who, whether, "
                              f"nobody, ...; at most {limit}")
    vague, words = (sum(each) for each in zip(*counts.values()))
    return report(f"{words} words of comments, {1000 * vague / max(words, 1):.1f} of 1 000 vague", violations)


if __name__ == "__main__":
    sys.exit(main())
