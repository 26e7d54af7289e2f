# SPDX-License-Identifier: BSD-3-Clause
"""Checks a built site: check.py FOLDER.

Each link within it leads to a file and, if it names one, to an anchor there. No page, style or script needs anything from
the network. Links to other sites are counted by site, and not followed.
"""

import collections
import html.parser
import pathlib
import re
import sys
import urllib.parse

FETCHED = {("img", "src"), ("script", "src"), ("iframe", "src"), ("link", "href"), ("source", "src"), ("object", "data")}
# Relations of <link> that a browser does not fetch.
NOT_FETCHED = ("next", "prev", "search", "index", "genindex", "canonical")
# Pages that make their anchors themselves, and an anchor that Doxygen links to and does not write.
OWN_ANCHORS, WITHOUT_ANCHOR = "office.html", "nested-classes"
IN_STYLE = re.compile(r"(?:url\(|@import)\s*['\"]?\s*(https?:)?//")


class Page(html.parser.HTMLParser):
    """The anchors, links and fetched files of a page."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.anchors, self.links, self.fetched = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.anchors |= {named[key] for key in ("id", "name") if named.get(key)}
        for key, value in attributes:
            if (tag, key) in FETCHED and named.get("rel") not in NOT_FETCHED:
                self.fetched.append(value or "")
            if key in ("href", "src") and value:
                self.links.append(value)


def is_outside(link):
    return re.match(r"(?:[a-z]+:)?//|mailto:", link)


def mistakes(folder, outside):
    """One line for each; adds the sites of links to other sites to `outside`."""
    pages = {path: Page(path.read_text(errors="replace")) for path in sorted(folder.rglob("*.html"))}
    for path, page in pages.items():
        here = path.relative_to(folder)
        for link in filter(is_outside, page.fetched):
            yield f"{here}: fetches {link}"
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if is_outside(link):
                outside[parts.netloc] += 1
            elif parts.scheme in ("", "file"):
                yield from broken(pages, folder, path, parts)
    for path in sorted(folder.rglob("*.css")):
        if IN_STYLE.search(path.read_text(errors="replace")):
            yield f"{path.relative_to(folder)}: fetches from the network"


def broken(pages, folder, path, parts):
    """A line if the link is wrong."""
    name = urllib.parse.unquote(parts.path)
    file = (path.parent / name).resolve() if name else path
    anchor = urllib.parse.unquote(parts.fragment)
    if not file.is_file() or not file.is_relative_to(folder):
        yield f"{path.relative_to(folder)}: {name}: no such file"
    elif anchor not in ("", WITHOUT_ANCHOR) and file in pages and file.name != OWN_ANCHORS and anchor not in pages[file].anchors:
        yield f"{path.relative_to(folder)}: {name}#{anchor}: no such anchor"


def main(folder):
    outside = collections.Counter()
    found = sorted(set(mistakes(pathlib.Path(folder).resolve(), outside)))
    print("".join(f"{line}\n" for line in found), end="")
    for site, number in sorted(outside.items()):
        print(f"not followed: {number} links to {site}")
    print(f"{len(found)} mistakes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
