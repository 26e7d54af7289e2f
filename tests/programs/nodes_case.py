# SPDX-License-Identifier: BSD-3-Clause
"""What tests of runs with nodes of ROS 1 have in common: they are called as PROGRAM BUILD, and skipped where ROS is missing."""

import pathlib
import stat
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
WAITPOINT = BUILD / "tools/waitpoint"


class NodesCase(unittest.TestCase):
    needed = ()  # files of the build, besides the library

    @classmethod
    def setUpClass(cls):
        if not all(file.exists() for file in (BUILD / "libwaitpoint-nodes.so", *cls.needed)):
            raise unittest.SkipTest("no nodes of ROS were built: ./dev ros does")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def node(self, name, text):
        """A node in Python, which need not be one of ROS."""
        file = self.folder / name
        file.write_text("#!/usr/bin/python3\n" + text)
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        return file
