# SPDX-License-Identifier: BSD-3-Clause
"""Makes the site of the documents in BUILD/site: make.py BUILD [--no-api].

The pages by Sphinx, MyST and furo, the reference of the installed headers by Doxygen (--no-api: without it); then all links are checked.
"""

import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import check
from pages import ROOT, Pages

HERE = pathlib.Path(__file__).resolve().parent
API = "# Headers\n\n{}\n\nThe contract of a concept is at the top of its header: shapes, units, errors, the source of a method.\n"
WITH_API = '<a href="api/files.html">All installed headers</a>, <a href="api/annotated.html">all classes</a>, by Doxygen.'
WITHOUT_API = "The reference was left out of this site: `./dev docs` makes it."
# Folders whose headers meson.build installs.
HEADERS = ("core", "fibers", "modules", "tools", "world")


def make_api(site, work):
    """site/api from the headers, as they are installed."""
    headers = work / "include"
    subprocess.run([sys.executable, ROOT / "tools/dev/install_headers.py", "--to", headers, ROOT, *HEADERS], check=True)
    settings = (HERE / "Doxyfile").read_text() + (f'INPUT = waitpoint\nOUTPUT_DIRECTORY = "{site}"\n'
                                                 f'INPUT_FILTER = "awk -f {HERE / "header.awk"}"\n')
    with open(work / "doxygen.log", "w") as log:  # its remarks on comments that were written for readers of the headers
        subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=headers, stderr=log, check=True)


def main(build, *options):
    site, work = pathlib.Path(build).resolve() / "site", pathlib.Path(build).resolve() / "site-work"
    for folder in site, work:
        shutil.rmtree(folder, ignore_errors=True)
    pages = work / "pages"
    Pages(pages).write()
    with_api = "--no-api" not in options
    (pages / "api.md").write_text(API.format(WITH_API if with_api else WITHOUT_API))
    done = subprocess.run(["sphinx-build", "-q", "-W", "--keep-going", "-d", work / "doctrees", "-c", HERE, pages, site])
    if done.returncode != 0:
        return 1
    for page in (ROOT / "docs").glob("*.html"):
        shutil.copy(page, site / "docs")
    if with_api:
        make_api(site, work)
    status = check.main(site)
    print(f"the site: {site}/index.html")
    return status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
