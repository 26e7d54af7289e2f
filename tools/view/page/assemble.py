# SPDX-License-Identifier: BSD-3-Clause
"""The page of the browser view as one document: assemble.py OUT page.html page.css SCRIPTS...

The style sheet takes the place of the marker <!--style--> and the scripts, in the order of the command line, that of
<!--script-->: as one inline script, in a function of its own. So the document needs nothing beside it. Its marker
<!--run-->, where the data of a recorded run goes, is left alone.
"""

import pathlib
import re
import sys

LICENCE = re.compile(r"^(//|/\*) SPDX-License-Identifier: .*\n", re.MULTILINE)


def read(path):
    """A file's text without its licence line, which the document has once, at its top."""
    return LICENCE.sub("", pathlib.Path(path).read_text(encoding="utf-8"), count=1)


def put(document, marker, text):
    if document.count(marker) != 1:
        sys.exit(f"assemble.py: the page has {document.count(marker)} markers {marker}, expected one")
    return document.replace(marker, text)


def assemble(page, style, scripts):
    code = "".join(scripts)
    # Either would end its element early.
    if "</script" in code.lower() or "</style" in style.lower():
        sys.exit("assemble.py: the end of an element within a script or style sheet")
    document = put(page, "<!--style-->", f"<style>\n{style}</style>")
    return put(document, "<!--script-->", f'<script>\n(() => {{"use strict";\n{code}}})();\n</script>')


if __name__ == "__main__":
    output, page, style, *scripts = sys.argv[1:]
    text = assemble(pathlib.Path(page).read_text(encoding="utf-8"), read(style), map(read, scripts))
    pathlib.Path(output).write_text(text, encoding="utf-8")
