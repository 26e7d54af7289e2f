# SPDX-License-Identifier: BSD-3-Clause
"""The port of vcpkg, the recipe of Conan and the Dockerfile in packaging/: recipes_test.py [--long].

With --long the first two build the library for threads by stand-ins of the tools, for a minute each, and a project uses
it. The Dockerfile is read only.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from conan_stand_in import ConanInvalidConfiguration, recipe_of
from consumer import run, write_consumer
from dockerfile import stages_of

LONG = "--long" in sys.argv
TREE = pathlib.Path(__file__).resolve().parents[2]
PORT = TREE / "packaging/vcpkg/waitpoint"
CONANFILE = TREE / "packaging/conan/conanfile.py"
VERSION = re.search(r"version: '(.*)'", (TREE / "meson.build").read_text())[1]
OPTIONS = set(re.findall(r"^option\('(\w+)'", (TREE / "meson_options.txt").read_text(), re.MULTILINE))
IDENTIFIER = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
CONSUMER = """
cmake_minimum_required(VERSION 3.18)
project(consumer CXX)
find_package(waitpoint 1 CONFIG REQUIRED)
include_directories(.)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE waitpoint::threads)
"""


class Recipe(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def project(self):
        (self.folder / "consumer").mkdir()
        write_consumer(self.folder / "consumer")
        return self.folder / "consumer"


class Vcpkg(Recipe):
    def test_the_manifest_follows_its_rules(self):
        manifest = json.loads((PORT / "vcpkg.json").read_text())
        self.assertEqual(manifest["name"], PORT.name)
        self.assertEqual(manifest["version-semver"], VERSION)
        self.assertLessEqual(manifest.keys(), {"name", "version-semver", "description", "license", "supports", "dependencies",
                                               "features"})
        for place in [manifest, *manifest["features"].values()]:
            self.assertTrue(place["description"])
            for dependency in place["dependencies"]:
                dependency = {"name": dependency} if isinstance(dependency, str) else dependency
                self.assertLessEqual(dependency.keys(), {"name", "host", "features", "default-features", "platform"})
                self.assertTrue(IDENTIFIER.fullmatch(dependency["name"]), dependency)
        for feature, content in manifest["features"].items():
            self.assertTrue(IDENTIFIER.fullmatch(feature))
            self.assertLessEqual(content.keys(), {"description", "dependencies", "supports", "license"})

    def test_the_portfile_sets_options_that_exist(self):
        named = set(re.findall(r"^ +-D(\w+)=", (PORT / "portfile.cmake").read_text(), re.MULTILINE))
        self.assertLessEqual(named, OPTIONS | {"auto_features", "werror"})
        self.assertIn("robots", named)

    @unittest.skipUnless(LONG and shutil.which("cmake"), "only with --long, and CMake")
    def test_a_project_uses_the_port(self):
        run("cmake", f"-DPORTFILE={PORT}/portfile.cmake", "-DFEATURES=core", f"-DFOLDER={self.folder}", "-P",
            TREE / "tests/packages/vcpkg_stand_in.cmake")
        package = self.folder / "package"
        self.assertEqual({path.name for path in package.iterdir()}, {"include", "lib", "share"})
        self.assertEqual({path.name for path in (package / "share").iterdir()}, {"waitpoint"})
        self.assertEqual([path for path in package.rglob("*") if path.is_dir() and not any(path.iterdir())], [])
        for path in package.rglob("*.[cp]*"):
            if path.suffix in (".cmake", ".pc"):
                self.assertNotIn(str(self.folder), path.read_text(), path)
        # vcpkg copies a package to where it is installed.
        installed = package.rename(self.folder / "installed")
        project = self.project()
        (project / "CMakeLists.txt").write_text(CONSUMER)
        run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={installed}")
        run("cmake", "--build", project / "build")
        run(project / "build/consumer")


class Conan(Recipe):
    def recipe(self, **options):
        return recipe_of(CONANFILE)(CONANFILE.parent, self.folder, options)

    def test_its_version_and_options_are_the_trees(self):
        recipe = self.recipe(robots=True)
        self.assertEqual((recipe.name, recipe.version), ("waitpoint", VERSION))
        recipe.generate()
        told = (self.folder / "generators/conan_meson_native.ini").read_text()
        named = re.search(r"\[project options\]\n(.*?)\[", told, re.DOTALL)[1]
        self.assertLessEqual(set(re.findall(r"^(\w+) =", named, re.MULTILINE)), OPTIONS | {"werror", "wrap_mode"})
        self.assertIn("\nrobots = true\n", told)

    def test_each_requirement_is_of_a_component(self):
        for robots in (False, True):
            recipe = self.recipe(robots=robots)
            recipe.requirements()
            recipe.package_info()
            of_components = {name.split("::")[0] for info in recipe.cpp_info.components.values() for name in info.requires if "::" in name}
            self.assertEqual({reference.split("/")[0] for reference in recipe.required}, of_components)
            self.assertEqual("robots" in recipe.cpp_info.components, robots)

    def test_other_systems_are_refused(self):
        recipe = self.recipe()
        recipe.validate()
        self.assertEqual(recipe.cppstd_min, 20)
        recipe.settings.os = "Windows"
        self.assertRaises(ConanInvalidConfiguration, recipe.validate)

    @unittest.skipUnless(shutil.which("pyflakes3"), "pyflakes3 is not installed")
    def test_pyflakes_finds_nothing(self):
        run("pyflakes3", CONANFILE)

    def test_it_exports_what_the_set_up_reads(self):
        """Meson reads each folder's file, and the sources that these name, also of parts that are left out."""
        recipe = self.recipe(robots=True)
        recipe.export_sources()
        recipe.generate()
        run("meson", "setup", f"--native-file={recipe.generators_folder}/conan_meson_native.ini", recipe.build_folder,
            recipe.source_folder)

    @unittest.skipUnless(LONG, "only with --long")
    def test_a_project_uses_the_package(self):
        for shared in (True, False):
            with self.subTest(shared=shared), tempfile.TemporaryDirectory() as folder:
                self.folder = pathlib.Path(folder)
                self.use(self.recipe(shared=shared), shared)

    def use(self, recipe, shared):
        for step in (recipe.export_sources, recipe.layout, recipe.generate, recipe.build, recipe.package, recipe.package_info):
            step()
        package = pathlib.Path(recipe.package_folder)
        self.assertEqual({path.name for path in package.iterdir()}, {"include", "lib", "licenses"})
        self.assertEqual([path.name for path in (package / "lib").iterdir() if path.is_dir()], [])
        threads = recipe.cpp_info.components["threads"]
        project = self.project()
        of_others = [] if shared else ["-lboost_context"]
        run("g++", "-std=c++20", f"-I{package}/include", *threads.cxxflags, "main.cpp", "-o", "consumer", f"-L{package}/lib",
            *[f"-l{library}" for library in threads.libs], *of_others, cwd=project)
        run("./consumer", cwd=project, env={**os.environ, "LD_LIBRARY_PATH": str(package / "lib")})


class Dockerfile(unittest.TestCase):
    def test_it_follows_the_rules_for_small_and_safe_images(self):
        stages = stages_of((TREE / "packaging/Dockerfile").read_text())
        self.assertEqual([stage.base for stage in stages], ["debian:bookworm-slim"] * 2)
        for stage in stages:
            for step in stage.instructions:
                if step.name == "RUN" and ("apt-get" in step.words or "./dev" in step.words):
                    self.assertTrue("rm -rf" in step.words and "/var/lib/apt/lists/*" in step.words, step.words)
                if "apt-get install" in step.words:
                    self.assertIn("apt-get install -y --no-install-recommends ", step.words)
                    self.assertIn("apt-get update && ", step.words)
                if step.name == "WORKDIR":
                    self.assertTrue(step.words.startswith("/"))
                self.assertNotEqual(step.name, "ADD")
        last = {step.name: step.words for step in stages[-1].instructions}
        self.assertNotIn(last["USER"], ("root", "0"))
        self.assertEqual((json.loads(last["ENTRYPOINT"]), json.loads(last["CMD"])), (["waitpoint"], ["--help"]))

    def test_it_names_profiles_and_packages_that_exist(self):
        stages = stages_of((TREE / "packaging/Dockerfile").read_text())
        control = (TREE / "debian/control").read_text()
        words = " ".join(step.words for stage in stages for step in stage.instructions)
        for package in re.findall(r"/packages/([a-z0-9-]+)_\*\.deb", words):
            self.assertIn(f"\nPackage: {package}\n", control)
        profiles = next(step.words for step in stages[0].instructions if step.name == "ARG").split('"')[1]
        for profile in profiles.split():
            self.assertIn(f"<!{profile}>", control)


if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "--long"])
