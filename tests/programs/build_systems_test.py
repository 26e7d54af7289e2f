# SPDX-License-Identifier: BSD-3-Clause
"""Projects that build waitpoint's sources as a part of theirs: build_systems_test.py. Each compiles the library anew, for a
minute; they have a folder core/ of their own.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
OWN_HEADER = """
#pragma once
namespace own { constexpr int hours = 24; }
"""
MAIN = """
#include "core/time.hpp"
#include <waitpoint/core/time.hpp>
#include <waitpoint/fibers/explore/explore.hpp>
#include <waitpoint/fibers/sync/threads.hpp>
int main() {
  int written = 0;
  const auto report = waitpoint::explore([&] {
    written = 0;
    waitpoint::thread writer({.name = "writer"}, [&] { written = own::hours; });
    writer.join();
    waitpoint::check(written == own::hours);
  });
  return report.passed && written == own::hours ? 0 : 1;
}
"""
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


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=1200, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")


class FromSources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "core").mkdir()
        (self.folder / "core/time.hpp").write_text(OWN_HEADER)
        (self.folder / "main.cpp").write_text(MAIN)

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
