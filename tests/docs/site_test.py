# SPDX-License-Identifier: BSD-3-Clause
"""The site's pages are made from the documents with their links, and its check finds what is wrong; without the site's own tools."""

import collections
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/dev/site"))
import check  # noqa: E402
import pages  # noqa: E402


class Site(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def mistakes(self, **files):
        for name, text in files.items():
            (self.folder / name.replace("_", ".")).write_text(text)
        return list(check.mistakes(self.folder, collections.Counter()))

    def test_each_page_of_the_readmes_tables_is_in_the_contents(self):
        contents = pages.table_of_contents((ROOT / "README.md").read_text())
        self.assertEqual([name for name in ("threads", "gdb", "scenario", "laas", "exec", "determinism") if f"<docs/{name}>" not in contents], [])
        self.assertIn(":caption: Getting started\n\nI test threads <docs/threads>", contents)
        self.assertIn("Contributing <CONTRIBUTING>", contents)

    def test_links_to_sources_lead_to_pages_of_them(self):
        made = pages.Pages(self.folder)
        text = made.rewritten(ROOT / "docs/explore.md", "[q](../tests/programs/shared_queue/shared_queue.cpp) [r](../README.md#reference) `[x](y)`")
        self.assertEqual(text, "[q](../source/tests/programs/shared_queue/shared_queue.cpp.md) [r](../index.md#reference) `[x](y)`")
        made.source_page(made.sources.pop())
        self.assertIn("waitpoint::", (self.folder / "source/tests/programs/shared_queue/shared_queue.cpp.md").read_text())

    def test_a_page_has_one_title(self):
        text = pages.Pages(self.folder).rewritten(ROOT / "docs/x.md", "# A `b`\n\n## C\n\n# D\n\n## E\n\n```sh\n# no title\n```\n")
        self.assertEqual(text, "# A `b`\n\n## C\n\n## D\n\n### E\n\n```sh\n# no title\n```\n")

    def test_broken_links_are_found(self):
        self.assertEqual(self.mistakes(a_html='<p id="x"><a href="b.html#y">b</a><a href="#x">x</a><a href="c.html">c</a>', b_html="<p>"),
                         ["a.html: b.html#y: no such anchor", "a.html: c.html: no such file"])

    def test_finds_resources_fetched_from_other_hosts(self):
        self.assertEqual(self.mistakes(a_html='<script src="https://x.org/a.js"></script><a href="https://x.org/">x</a>',
                                       s_css="@import url(//x.org/s.css);"),
                         ["a.html: fetches https://x.org/a.js", "s.css: fetches from the network"])


if __name__ == "__main__":
    unittest.main()
