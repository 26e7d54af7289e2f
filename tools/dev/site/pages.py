# SPDX-License-Identifier: BSD-3-Clause
"""The pages of the site, made from the documents of the tree in a folder of the same layout.

README.md becomes the first page, with a table of contents by the topics of its own tables. A source file, or a folder, that a page
links to becomes a page below `source/`.
"""

import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[3]
LITERAL = re.compile(r"^ *```.*?^ *```$|`[^`\n]*`|<!--.*?-->", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^(#+ )", re.MULTILINE)
TARGET = re.compile(r"\]\(([^()\s]+)\)")
TO_HTML = re.compile(r"\[((?:[^\[\]]|\[[^\[\]]*\]\([^()]*\))*)\]\(([^()\s]+\.html)\)")
ROW_LINK = re.compile(r"\[([^\[\]]*)\]\(([^()\s]+\.md)\)")
LANGUAGES = {".c": "c", ".cc": "cpp", ".cpp": "cpp", ".h": "c", ".hpp": "cpp", ".py": "python", ".sh": "sh", ".tcl": "tcl", ".yaml": "yaml"}
PICTURES = (".png", ".svg")


class Pages:
    """Writes pages below `to`, and remembers which sources they need."""

    def __init__(self, to):
        self.to = to
        self.sources = []
        self.documents = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md")),
                          *sorted((ROOT / "tests").glob("*/README.md"))]

    def write(self):
        """All pages, and the pictures that they show."""
        contents = table_of_contents((ROOT / "README.md").read_text())
        for document in self.documents:
            place = document.relative_to(ROOT)
            text = self.rewritten(document, document.read_text())
            if place == pathlib.Path("README.md"):
                self.page("index.md", text + contents)
            else:
                self.page(place, ("" if f"<{place.with_suffix('')}>" in contents else "---\norphan: true\n---\n\n") + text)
        while self.sources:
            self.source_page(self.sources.pop())
        for picture in (path for path in (ROOT / "docs").rglob("*") if path.suffix in PICTURES):
            (self.to / picture.relative_to(ROOT).parent).mkdir(parents=True, exist_ok=True)
            shutil.copy(picture, self.to / picture.relative_to(ROOT))

    def page(self, place, text):
        path = self.to / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def rewritten(self, document, text):
        """The text with one title, and its links as the site has them; blocks, code and comments stay."""
        prose, literals = LITERAL.split(text), LITERAL.findall(text)
        linked = [self.links(document, part) for part in with_one_title(prose)]
        return "".join(part + literal for part, literal in zip(linked, [*literals, ""]))

    def links(self, document, text):
        text = TARGET.sub(lambda found: f"]({self.target(document, found[1])})", text)
        return TO_HTML.sub(lambda found: f'<a href="{found[2]}">{found[1]}</a>' if "//" not in found[2] else found[0], text)

    def target(self, document, target):
        """Where a link of the document leads in the site."""
        name, sharp, anchor = target.partition("#")
        file = (document.parent / name).resolve()
        if not name or ":" in target or file.suffix in (*PICTURES, ".html"):
            return target
        up = "../" * len(document.relative_to(ROOT).parent.parts)
        if file == ROOT / "README.md":
            return f"{up}index.md{sharp}{anchor}"
        if file in self.documents:
            return target
        self.sources.append(file)
        return f"{up}{source_place(file)}"

    def source_page(self, file):
        place = source_place(file)
        if (self.to / place).exists():
            return
        title = f"---\norphan: true\n---\n\n# {file.relative_to(ROOT)}\n\n"
        if file.is_dir():
            inside = sorted(path for path in file.iterdir() if is_text(path))
            self.sources += inside
            up = "../" * len(place.parent.parts)
            self.page(place, title + "".join(f"* [{path.name}]({up}{source_place(path)})\n" for path in inside))
        else:
            fence = "`````"
            self.page(place, f"{title}{fence}{LANGUAGES.get(file.suffix, 'text')}\n{file.read_text()}{fence}\n")


def with_one_title(prose):
    """The parts of a page with the headings from the second title on one level lower: the contents would list it as a page."""
    titles = 0

    def lowered(heading):
        nonlocal titles
        titles += heading[1] == "# "
        return heading[0] if titles < 2 else "#" + heading[0]

    return [HEADING.sub(lowered, part) for part in prose]


def source_place(file):
    place = pathlib.Path("source") / file.relative_to(ROOT)
    return place / "index.md" if file.is_dir() else place.with_name(place.name + ".md")


def is_text(path):
    """True for a file of the tree that a page can show, and for folders of such."""
    if path.is_dir():
        return path.name != "__pycache__"
    return path.suffix in LANGUAGES or path.suffix in (".build", ".ctl", ".gen", ".idl", ".launch", ".md", ".out", ".txt", ".xml")


def table_of_contents(readme):
    """Hidden tables of contents: one for the tutorials, one for each row of the reference, which names its topic."""
    start = readme.index("## Getting started")
    reference = readme.index("## Reference")
    groups = [("Getting started", ROW_LINK.findall(readme[start:reference]))]
    for row in re.findall(r"^\| ([^|\n]+) \| (.*\]\(.*) \|$", readme[reference:readme.index("\n## ", reference + 1)], re.MULTILINE):
        groups.append((row[0][0].upper() + row[0][1:], ROW_LINK.findall(row[1])))
    text = ""
    for caption, links in groups:
        entries = "".join(f"{name[0].upper() + name[1:]} <{target.removesuffix('.md')}>\n" for name, target in links)
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{entries}```\n"
    return text + "\n```{toctree}\n:hidden:\n:caption: API\n\nHeaders <api>\n```\n"
