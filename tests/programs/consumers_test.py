# SPDX-License-Identifier: BSD-3-Clause
"""Projects that find the installed library by pkg-config, CMake and Meson: consumers_test.py BUILD."""

import os
import re
import shutil
import subprocess
import unittest

from installed import HERE, Installed, flags, main, run

# A header of the consumer's own with the name of a header of the library.
CONSUMERS_TIME = """
#pragma once
namespace own { constexpr int hours = 24; }
"""
CONSUMER = """
#include "core/time.hpp"
#include <waitpoint/core/time.hpp>
#include <waitpoint/fibers/sync/simulation.hpp>
#include <waitpoint/fibers/sync/threads.hpp>
int main() {
  int written = 0;
  waitpoint::simulate([&] {
    waitpoint::thread writer({.name = "writer"}, [&] { written = own::hours; });
    writer.join();
  });
  return written == own::hours ? 0 : 1;
}
"""
CMAKE_PROJECT = """
cmake_minimum_required(VERSION 3.18)
project(consumer CXX)
find_package(waitpoint 1 REQUIRED)
include_directories(.)
foreach(kind threads races)
  if(TARGET waitpoint::${kind})
    add_executable(${kind} main.cpp)
    target_link_libraries(${kind} PRIVATE waitpoint::${kind})
  endif()
endforeach()
add_executable(robots robots.cpp)
target_link_libraries(robots PRIVATE waitpoint::robots)
if(TARGET waitpoint::robots_native)
  add_executable(robots_native robots.cpp)
  target_link_libraries(robots_native PRIVATE waitpoint::robots_native)
endif()
"""
CMAKE_COMPONENTS = """
cmake_minimum_required(VERSION 3.18)
project(consumer CXX)
find_package(waitpoint 1 REQUIRED COMPONENTS threads {})
"""
CMAKE_PROJECT_IN_C = """
cmake_minimum_required(VERSION 3.18)
project(consumer C)
find_package(waitpoint 1 REQUIRED)
add_executable(crane crane.c)
target_link_libraries(crane PRIVATE waitpoint::pocolibs)
"""
MESON_PROJECT = """
project('consumer', 'cpp', default_options: 'cpp_std=c++20')
executable('threads', 'main.cpp', dependencies: dependency('waitpoint'))
executable('robots', 'robots.cpp', dependencies: dependency('waitpoint-robots'))
"""


class Consumers(Installed):
    """Projects that find the installed library with their build system, and have a folder core/ of their own."""

    def project(self, name, build_file="", text=""):
        folder = self.folder / name
        (folder / "core").mkdir(parents=True)
        (folder / "core/time.hpp").write_text(CONSUMERS_TIME)
        (folder / "main.cpp").write_text(CONSUMER)
        shutil.copy(HERE / "blinker/blinker.cpp", folder / "robots.cpp")
        if build_file:
            (folder / build_file).write_text(text)
        return folder

    def check(self, programs):
        run(programs / "threads", timeout=20)
        self.assertIn("the lamp is on", run(programs / "robots", "run", HERE / "blinker/blinker.yaml", timeout=60))

    def test_pkg_config(self):
        folder = self.project("with-pkg-config")
        for program, source, package in (("threads", "main", "waitpoint"), ("robots", "robots", "waitpoint-robots")):
            run("g++", "-std=c++20", "-I.", f"{source}.cpp", "-o", program, *flags(self.prefix, "--cflags", "--libs", package), cwd=folder)
        self.check(folder)

    def test_library_behind_the_c_library(self):
        """Of a program that uses it through another library alone, and is linked without the flags that keep it in front."""
        words = [word for word in flags(self.prefix, "--cflags", "--libs", "waitpoint-robots") if not re.search("push-state|pop-state", word)]
        program = self.folder / "behind"
        run("g++", "-std=c++20", HERE / "trespasser/trespasser.cpp", "-o", program, "-Wl,--as-needed", *words)
        self.assertIn("digest", run(program, "run", HERE / "trespasser/trespasser.yaml", timeout=60))

    def build_with_cmake(self, folder):
        run("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", folder / "build")

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not installed")
    def test_cmake(self):
        folder = self.project("with-cmake", "CMakeLists.txt", CMAKE_PROJECT)
        self.build_with_cmake(folder)
        self.check(folder / "build")
        if list(self.prefix.rglob("libwaitpoint-races.a")):
            run(folder / "build/races", timeout=20)
        if list(self.prefix.rglob("libwaitpoint-robots-native.*")):
            self.assertIn("on real threads", run(folder / "build/robots_native", "run", HERE / "blinker/blinker.yaml", timeout=60))

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not installed")
    def test_cmake_refuses_components_that_the_build_lacks(self):
        for component, words in {"pocolibs": "Build files have been written", "ghosts": "this build of waitpoint has no library 'ghosts'"}.items():
            folder = self.project(f"with-{component}", "CMakeLists.txt", CMAKE_COMPONENTS.format(component))
            done = subprocess.run(["cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertIn(words, done.stdout)

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not installed")
    def test_cmake_of_a_project_in_c(self):
        folder = self.project("with-cmake-in-c", "CMakeLists.txt", CMAKE_PROJECT_IN_C)
        shutil.copy(HERE / "crane/crane.c", folder)
        self.build_with_cmake(folder)
        self.assertEqual(run(folder / "build/crane", timeout=20), (HERE / "crane/crane.out").read_text())

    def test_meson(self):
        folder = self.project("with-meson", "meson.build", MESON_PROJECT)
        packages = os.pathsep.join({str(path.parent) for path in self.prefix.rglob("*.pc")})
        environment = {**os.environ, "PKG_CONFIG_PATH": packages, "PKG_CONFIG_SYSROOT_DIR": str(self.folder / "root")}
        run("meson", "setup", folder / "build", folder, env=environment)
        run("meson", "compile", "-C", folder / "build")
        self.check(folder / "build")


if __name__ == "__main__":
    main()
