# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the program that need libraries of their own, and the packages: `./dev add`, what the other commands do about
them, and what debian/ says of the tree."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def table(name, *rows):
    """The entries of a table of packages.sh."""
    script = f'source "{ROOT}/tools/dev/packages.sh"; needed {name} {" ".join(rows)}'
    return subprocess.run(["bash", "-euo", "pipefail", "-c", script], check=True, capture_output=True, text=True).stdout.split()


class Parts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def appeared(self, installed, built, options=""):
        """Whether a build folder lacks a part whose packages are installed."""
        (self.folder / "meson-private").mkdir(exist_ok=True)
        (self.folder / "meson-private/cmd_line.txt").write_text(f"[options]\n{options}")
        (self.folder / "build.ninja").write_text(built)
        stub = self.folder / "dpkg-query"
        stub.write_text("#!/bin/sh\n" + "".join(f"echo installed {package}\n" for package in installed))
        stub.chmod(0o755)
        script = (f'root={ROOT} build={self.folder}; source "$root/tools/dev/packages.sh"; source "$root/tools/dev/build.sh"; '
                  'part_appeared && echo yes || echo no')
        environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script], check=True, capture_output=True, text=True,
                              env=environment).stdout.strip()

    def test_an_unknown_part_is_one_line(self):
        done = subprocess.run([ROOT / "dev", "add", "bulet"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "dev: add: expected parts of bags bullet meshes ranks tcl programs, found 'bulet'\n")

    def test_a_run_needs_the_packages_of_none(self):
        of_run = set(table("debian", "run"))
        for part in ("bags", "bullet", "meshes", "ranks", "tcl"):
            self.assertTrue(table("debian", part))
            self.assertEqual(of_run & set(table("debian", part)), set(), part)

    def test_one_that_was_installed_since_is_built_in(self):
        self.assertEqual(self.appeared([], "no parts"), "no")
        self.assertEqual(self.appeared(["libbullet-dev"], "no parts"), "yes")
        self.assertEqual(self.appeared(["libopenmpi-dev"], "no parts"), "no", "one of two packages")
        self.assertEqual(self.appeared(["libbullet-dev"], "link -lBulletDynamics-float64"), "no")
        self.assertEqual(self.appeared(["libbullet-dev"], "no parts", "bullet = disabled\n"), "no")

    def test_the_disassembler_is_no_part_and_is_looked_for_again(self):
        self.assertIn("libzydis-dev", table("debian", "run"))
        if os.uname().machine == "x86_64":
            self.assertEqual(self.appeared(["libzydis-dev"], "no parts"), "yes")
            self.assertEqual(self.appeared(["libzydis-dev"], "link libZydis.so"), "no")
            self.assertEqual(self.appeared([], "no parts"), "no")

    def test_the_program_names_only_commands_that_exist(self):
        named = re.findall(r"`\./dev add (\w+)`", (ROOT / "core/missing_part.hpp").read_text())
        self.assertEqual(sorted(named), ["bags", "bullet", "meshes", "programs", "ranks", "tcl"])
        packages = set(re.findall(r"install the package (waitpoint[\w-]*)", (ROOT / "core/missing_part.hpp").read_text()))
        self.assertEqual(packages - set(re.findall(r"(?m)^Package: (\S+)", (ROOT / "debian/control").read_text())), set())


class Packages(unittest.TestCase):
    """What Debian's packages take from the tree."""

    def test_have_the_version_of_the_project(self):
        project = re.search(r"version: '(.+)'", (ROOT / "meson.build").read_text())[1]
        packaged = re.match(r"waitpoint \((.+)-\d+\)", (ROOT / "debian/changelog").read_text())[1]
        self.assertEqual(packaged, project.replace("-", "~"))

    def test_the_interface_keeps_the_versions_of_its_names(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            symbols = folder / "libwaitpoint1.symbols"

            def update(source, version):
                for library in ("libwaitpoint.so.1", "libwaitpoint-robots-native.so.1", "libwaitpoint-robots.so.1"):
                    compile = ["c++", "-shared", "-fPIC", "-x", "c++", "-", "-o", folder / library]
                    subprocess.run(compile, input=source, text=True, check=True)
                tool = [sys.executable, ROOT / "tools/dev/symbols.py", folder, version, folder]
                return subprocess.run(tool, capture_output=True, text=True)

            first = "namespace waitpoint { void run(int) {} void stop() {} inline void pause() {} }"
            self.assertEqual(update(first, "1.0.0").returncode, 0)
            more = update(first + "namespace waitpoint { void run(long) {} }", "1.1.0")
            self.assertEqual((more.returncode, more.stdout), (0, ""))
            self.assertEqual([line for line in symbols.read_text().splitlines() if "c++" in line],
                             [' (c++)"waitpoint::run(int)@Base" 1.0.0', ' (c++)"waitpoint::run(long)@Base" 1.1.0',
                              ' (c++)"waitpoint::stop()@Base" 1.0.0'])
            less = update("namespace waitpoint { void run(int) {} void run(long) {} }", "2.0.0")
            gone = ("libwaitpoint.so.1", "libwaitpoint-robots-native.so.1", "libwaitpoint-robots.so.1")
            told = "".join(f"gone: waitpoint::stop() of {library}\n" for library in gone)
            self.assertEqual((less.returncode, less.stdout), (1, told))


if __name__ == "__main__":
    unittest.main()
