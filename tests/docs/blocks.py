# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of the documents, and what the comments before them say about running them.

A block has a language. `console` is a session and `sh` a script: both are run. `text` shows an output or a drawing. The other
languages are data. An HTML comment before a block, which no page shows, says more:

    <!-- not run: REASON -->       the block is not run
    <!-- long: REASON -->          it is run only on demand (pages_test.py --long)
    <!-- output of: COMMAND -->    a text block: what the command prints; `...` matches as in sessions
    <!-- status: N -->             the exit status of a script, if not 0

and between blocks:

    <!-- run: COMMAND -->              run if the next block is, before it, and must succeed
    <!-- not rendered FILE: REASON --> no command of the documents draws this picture
"""

import dataclasses
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMANDS = ("console", "sh")
DATA = ("c", "cmake", "cpp", "ctl", "diff", "gen", "meson", "tcl", "walls", "yaml")
MARKS = ("not run", "long", "output of", "status")

ITEM = re.compile(
    r"^<!-- (?P<name>not run|long|output of|status|run|not rendered [^ :]+): (?P<said>.*?) -->$"
    r"|^(?P<indent> *)```(?P<language>[a-z0-9]*)\n(?P<text>.*?)^ *```$",
    re.MULTILINE | re.DOTALL)


@dataclasses.dataclass
class Step:
    """A block, or a command in a comment (language `run`), of a page."""

    page: str
    line: int
    language: str
    text: str
    marks: dict

    def __str__(self):
        return f"{self.page}:{self.line}"

    def verdict(self):
        """One of `run`, `long`, `not run`, `data`, `missing`."""
        if self.language in DATA:
            return "data"
        if "not run" in self.marks:
            return "not run"
        if self.language in (*COMMANDS, "run") or self.language == "text" and "output of" in self.marks:
            return "long" if "long" in self.marks else "run"
        return "missing"

    def words(self):
        """The text in which commands are."""
        return self.text + self.marks.get("output of", "")


def pages():
    """The documents, relative to the root."""
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    return [str(path.relative_to(ROOT)) for path in sorted(found)]


def steps(page, text=None):
    """The page's steps in their order, and the reasons of pictures that are not rendered by name."""
    text = (ROOT / page).read_text() if text is None else text
    found, marks, not_rendered, end = [], {}, {}, 0
    for item in ITEM.finditer(text):
        if text[end:item.start()].strip():
            marks = {}  # a mark is of the block right below it
        end = item.end()
        line = text.count("\n", 0, item.start()) + 1
        name, said = item["name"], re.sub(r"\s+", " ", item["said"] or "")
        if name and name.startswith("not rendered "):
            not_rendered[name.split()[-1]] = said
        elif name == "run":
            found.append(Step(page, line, "run", item["said"], {}))
        elif name:
            marks[name] = item["said"] if name == "output of" else said
        else:
            lines = [each.removeprefix(item["indent"]) for each in item["text"].splitlines()]
            found.append(Step(page, line, item["language"], "\n".join(lines) + "\n", marks))
            marks = {}
    return found, not_rendered


def chosen(page, long):
    """The page's steps that are run, with those that take long or without."""
    all_steps, wanted = steps(page)[0], []
    last = True
    for step in reversed(all_steps):
        if step.language != "run" and step.verdict() != "data":
            last = step.verdict() == "run" or long and step.verdict() == "long"
        if last:
            wanted.insert(0, step)
    return [step for step in wanted if step.verdict() != "data"]


def table():
    """A line for each block of all pages: place, language, verdict, reason."""
    rows = [(str(step), step.language or "-", step.verdict(), next(iter(step.marks.values()), ""))
            for page in pages() for step in steps(page)[0]]
    return "".join(f"{place:40} {language:8} {verdict:8} {reason.splitlines()[0] if reason else ''}".rstrip() + "\n"
                   for place, language, verdict, reason in rows)
