# SPDX-License-Identifier: BSD-3-Clause
"""Projects that build waitpoint's sources as a part of theirs: build_systems_test.py. Each compiles the library anew, for a
minute; they have a folder core/ of their own.
"""

import os
import pathlib
import shutil
import tempfile
import unittest

from consumer import run, write_consumer

ROOT = pathlib.Path(__file__).resolve().parents[2]
FETCH_CONTENT = """
cmake_minimum_required(VERSION 3.18)
project(consumer CXX)
include(FetchContent)
FetchContent_Declare(waitpoint SOURCE_DIR {root})
FetchContent_MakeAvailable(waitpoint)
include_directories(.)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE waitpoint::threads)
"""
ADD_SUBDIRECTORY = """
cmake_minimum_required(VERSION 3.18)
project(consumer CXX)
add_subdirectory({root} waitpoint)
include_directories(.)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE waitpoint::threads)
"""
MESON = """
project('consumer', 'cpp', default_options: 'cpp_std=c++20')
subproject('waitpoint', default_options: ['robots=false'])
executable('consumer', 'main.cpp', dependencies: dependency('waitpoint'))
"""


class FromSources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        write_consumer(self.folder)

    def with_cmake(self, project):
        (self.folder / "CMakeLists.txt").write_text(project.format(root=ROOT))
        run("cmake", "-S", self.folder, "-B", self.folder / "build")
        run("cmake", "--build", self.folder / "build")
        run(self.folder / "build/consumer")

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not installed")
    def test_cmake_fetch_content(self):
        self.with_cmake(FETCH_CONTENT)

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not installed")
    def test_cmake_add_subdirectory_and_a_second_configuration(self):
        self.with_cmake(ADD_SUBDIRECTORY)
        self.with_cmake(ADD_SUBDIRECTORY)

    def test_meson_subproject(self):
        (self.folder / "meson.build").write_text(MESON)
        (self.folder / "subprojects").mkdir()
        os.symlink(ROOT, self.folder / "subprojects/waitpoint")
        run("meson", "setup", self.folder / "build", self.folder)
        run("ninja", "-C", self.folder / "build")
        run(self.folder / "build/consumer")


if __name__ == "__main__":
    unittest.main()
