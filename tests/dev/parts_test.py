# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the program that need libraries of their own: `./dev add`, and what the other commands do about them."""

import os
import pathlib
import re
import subprocess
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

    def test_a_word_that_is_no_part_is_one_line(self):
        done = subprocess.run([ROOT / "dev", "add", "bulet"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "dev: add: expected parts of accesses bags bullet meshes ranks tcl, found 'bulet'\n")

    def test_a_run_needs_the_packages_of_none(self):
        of_run = set(table("debian", "run"))
        for part in ("accesses", "bags", "bullet", "meshes", "ranks", "tcl"):
            self.assertTrue(table("debian", part))
            self.assertEqual(of_run & set(table("debian", part)), set(), part)

    def test_one_that_was_installed_since_is_built_in(self):
        self.assertEqual(self.appeared([], "no parts"), "no")
        self.assertEqual(self.appeared(["libbullet-dev"], "no parts"), "yes")
        self.assertEqual(self.appeared(["libopenmpi-dev"], "no parts"), "no", "one of two packages")
        self.assertEqual(self.appeared(["libbullet-dev"], "link -lBulletDynamics-float64"), "no")
        self.assertEqual(self.appeared(["libbullet-dev"], "no parts", "bullet = disabled\n"), "no")

    def test_the_program_names_only_commands_that_exist(self):
        named = re.findall(r"`\./dev add (\w+)`", (ROOT / "core/missing_part.hpp").read_text())
        self.assertEqual(sorted(named), ["accesses", "bags", "bullet", "meshes", "ranks", "tcl"])


if __name__ == "__main__":
    unittest.main()
