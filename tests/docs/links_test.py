# SPDX-License-Identifier: BSD-3-Clause
"""Each link of the documents to a file of the tree leads to one, and to a heading if it names one: links_test.py [--outside].

--outside lists the links to other sites, with their pages; nothing is fetched.
"""

import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^ *```.*?^ *```$|<!--.*?-->", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"\[(?:[^\[\]]|\[[^\[\]]*\](?:\([^()]*\))?)*\]\(([^()\s]+)\)")
PICTURE = re.compile(r"!\[[^\[\]]*\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#{1,6} (.+)$", re.MULTILINE)


def pages():
    return [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "tests").glob("*/README.md")]


def prose(text):
    """The text without blocks and comments."""
    return FENCE.sub("", text)


def links(text):
    """Targets of the text's links and pictures, those of pictures within links included."""
    plain = CODE.sub("", prose(text))
    return sorted({*LINK.findall(plain), *PICTURE.findall(plain)})


def anchors(text):
    """The anchors that GitHub gives the text's headings."""
    found = set()
    for heading in HEADING.findall(prose(text)):
        name = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        name = re.sub(r"[^\w\- ]", "", name).replace(" ", "-")
        number = sum(1 for each in found if each == name or re.fullmatch(re.escape(name) + r"-\d+", each))
        found.add(f"{name}-{number}" if number else name)
    return found


def mistake(page, target):
    """What is wrong with the link from a page, or an empty text."""
    path, _, anchor = target.partition("#")
    file = (page.parent / path).resolve() if path else page
    if not file.is_relative_to(ROOT):
        return "leads out of the tree"
    if not file.exists():
        return "no such file"
    if anchor and (file.suffix != ".md" or anchor not in anchors(file.read_text())):
        return "no such heading"
    return ""


def is_outside(target):
    return re.match(r"[a-z]+:", target)


class Links(unittest.TestCase):
    def test_links_within_the_tree_lead_somewhere(self):
        wrong = [f"{page.relative_to(ROOT)}: {target}: {what}" for page in pages() for target in links(page.read_text())
                 if not is_outside(target) and (what := mistake(page, target))]
        self.assertEqual(wrong, [])

    def test_headings_have_githubs_anchors(self):
        self.assertEqual(anchors("# The `back` command: *limits*\n## A, b & c\n## A, b & c\n"),
                         {"the-back-command-limits", "a-b--c", "a-b--c-1"})

    def test_pictures_within_links_are_links_too(self):
        self.assertEqual(links("[![a](b.svg)](c.html), `[no](x)`, [d](e.md#f)"), ["b.svg", "c.html", "e.md#f"])

    def test_a_wrong_link_is_reported(self):
        page = ROOT / "README.md"
        self.assertEqual(mistake(page, "docs/none.md"), "no such file")
        self.assertEqual(mistake(page, "docs/gdb.md#none"), "no such heading")
        self.assertEqual(mistake(page, "../x"), "leads out of the tree")
        self.assertEqual(mistake(page, "docs/view.md#a-finding"), "")

    def test_each_page_is_reached_from_the_readme(self):
        reached, ahead = set(), [ROOT / "README.md"]
        while ahead:
            page = ahead.pop()
            if page in reached or page.suffix != ".md":
                continue
            reached.add(page)
            ahead += [(page.parent / target.partition("#")[0]).resolve() for target in links(page.read_text())
                      if not is_outside(target) and not mistake(page, target)]
        missing = [str(page.relative_to(ROOT)) for page in (ROOT / "docs").rglob("*.md") if page not in reached]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    if "--outside" in sys.argv:
        for page in pages():
            for target in sorted(set(filter(is_outside, links(page.read_text())))):
                print(f"{page.relative_to(ROOT)}: {target}")
        sys.exit(0)
    unittest.main()
