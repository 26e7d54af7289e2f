# SPDX-License-Identifier: BSD-3-Clause
"""An installation of a build folder, and programs compiled against it with only the flags of pkg-config.

In the place of a build folder the command line may name a prefix, such as /usr, in which waitpoint is installed already.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
IS_PREFIX = not (BUILD / "build.ninja").exists() and (BUILD / "bin/waitpoint").exists()
PROGRAM = BUILD / ("bin/waitpoint" if IS_PREFIX else "tools/waitpoint")
SCENARIOS = BUILD / "share/waitpoint/scenarios" if IS_PREFIX else HERE.parents[1] / "scenarios"


def run(*command, **options):
    """Runs a command that must succeed; returns its standard output."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def flags(prefix, *arguments):
    """The output of pkg-config, with `prefix` as the prefix of the installed packages."""
    folders = os.pathsep.join(str(path.parent) for path in prefix.rglob("*.pc"))
    environment = {**os.environ, "PKG_CONFIG_PATH": folders}
    return run("pkg-config", f"--define-variable=prefix={prefix}", *arguments, env=environment).split()


class Installed(unittest.TestCase):
    """Installs once for all tests; each program is compiled once, too."""

    @classmethod
    def setUpClass(cls):
        if hasattr(Installed, "folder"):
            return
        folder = tempfile.TemporaryDirectory()
        unittest.addModuleCleanup(folder.cleanup)
        Installed.folder = pathlib.Path(folder.name)
        if IS_PREFIX:
            Installed.prefix = BUILD
            return
        run("meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", cls.folder / "root")
        Installed.prefix = next((cls.folder / "root").rglob("include/waitpoint")).parents[1]
        # In the place of ldconfig.
        Installed.libraries = next(Installed.prefix.rglob("libwaitpoint.so")).parent
        os.environ["LD_LIBRARY_PATH"] = str(Installed.libraries)

    def compile(self, name, *more, program=None, compiler=None):
        """Compiles NAME/NAME.cpp with the given flags, in a folder outside the tree; returns the program."""
        program = self.folder / (program or name)
        if not program.exists():
            words = (compiler or os.environ.get("CXX", "g++")).split()
            run(*words, "-std=c++20", "-O1", "-g", HERE / name / f"{name}.cpp", "-o", program, *more, cwd=self.folder)
        return program


def main():
    if any((BUILD / "subprojects").glob("*")):
        print("libraries of subprojects/ are not installed: nothing can be linked outside of the build")
        sys.exit(77)
    unittest.main(module="__main__")
