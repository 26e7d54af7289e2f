# SPDX-License-Identifier: BSD-3-Clause
"""A recipe of Conan 2 for the tree that it lies in: conan create packaging/conan. It has the libraries; the program
waitpoint, with the libraries that it preloads, is in Debian's packages.
"""

import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, rmdir
from conan.tools.gnu import PkgConfigDeps
from conan.tools.layout import basic_layout
from conan.tools.meson import Meson, MesonToolchain

# What a part of the tree needs, by its component here; of Boost, the robots need headers.
NEEDED = {
    "threads": {"boost": "1.83.0"},
    "robots": {
        "bzip2": "1.0.8",
        "cli11": "2.3.2",
        "eigen": "3.4.0",
        "fcl": "0.7.0",
        "fmt": "10.2.1",
        "libpng": "1.6.40",
        "lz4": "1.9.4",
        "nlohmann_json": "3.11.3",
        "tinyxml2": "10.0.0",
        "yaml-cpp": "0.8.0",
        "zlib": "1.3.1",
        "zstd": "1.5.5",
    },
}
LEFT_OUT = ("assimp", "bullet", "disassembler", "exec", "native", "races", "ranks", "ros", "rosbag", "tcl", "tests")


class Waitpoint(ConanFile):
    name = "waitpoint"
    version = "1.0.0-rc1"
    description = "Tests of threads under all their schedules, and robots in virtual time: one seed gives one run, bit for bit"
    license = "BSD-3-Clause"
    topics = ("concurrency", "testing", "simulation", "robotics")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "robots": [True, False]}
    default_options = {"shared": True, "robots": False}

    def _components(self):
        return ["threads", "robots"] if self.options.robots else ["threads"]

    def validate(self):
        if self.settings.os != "Linux" or self.settings.arch not in ("x86_64", "armv8"):
            raise ConanInvalidConfiguration("waitpoint is for Linux on x86_64 and armv8")
        check_min_cppstd(self, 20)

    def export_sources(self):
        tree = os.path.join(self.recipe_folder, "..", "..")
        for part in ("LICENSE", "meson.build", "meson_options.txt", "core/*", "docs/schemas/*", "examples/*", "fibers/*", "modules/*",
                     "scenarios/*", "tools/*", "world/*"):
            copy(self, part, tree, self.export_sources_folder, excludes="*__pycache__*")

    def requirements(self):
        for component in self._components():
            for name, version in NEEDED[component].items():
                self.requires(f"{name}/{version}")

    def build_requirements(self):
        self.tool_requires("meson/1.2.2")
        self.tool_requires("pkgconf/2.1.0")

    def layout(self):
        basic_layout(self)

    def generate(self):
        PkgConfigDeps(self).generate()
        toolchain = MesonToolchain(self)
        # Meson looks for Boost by itself, and not by pkg-config.
        toolchain.properties["boost_root"] = self.dependencies["boost"].package_folder
        toolchain.project_options.update({name: "disabled" for name in LEFT_OUT})
        toolchain.project_options.update({"robots": bool(self.options.robots), "split_debug": False, "werror": False})
        toolchain.generate()

    def build(self):
        meson = Meson(self)
        meson.configure()
        meson.build()

    def package(self):
        Meson(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        # Conan writes its own, from package_info().
        for folder in ("bin", "lib/cmake", "lib/pkgconfig", "lib/waitpoint", "share/bash-completion", "share/fish", "share/man",
                       "share/zsh"):
            rmdir(self, os.path.join(self.package_folder, folder))

    def package_info(self):
        libraries = {"threads": "waitpoint", "robots": "waitpoint-robots"}
        for component in self._components():
            info = self.cpp_info.components[component]
            info.libs = [libraries[component]]
            info.set_property("cmake_target_name", f"waitpoint::{component}")
            info.set_property("pkg_config_name", libraries[component])
        threads = self.cpp_info.components["threads"]
        threads.requires = ["boost::context"]
        # See docs/determinism.md, and the guard page below a task's stack.
        threads.cxxflags = ["-ffp-contract=off", "-fstack-clash-protection"]
        if self.options.robots:
            of_others = [f"{name}::{name}" for name in NEEDED["robots"]]
            self.cpp_info.components["robots"].requires = ["threads", "boost::headers", *of_others]
