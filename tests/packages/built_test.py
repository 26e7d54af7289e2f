# SPDX-License-Identifier: BSD-3-Clause
"""Debian's packages as files: built_test.py PACKAGES [OTHER].

PACKAGES is a folder that tools/dev/package.sh has filled; with OTHER, one of a second build, the packages must be the same
byte for byte. Nothing is installed.
"""

import pathlib
import re
import shutil
import sys
import tempfile
import unittest

from consumer import run

TREE = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path()
OTHER = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None


def changes():
    """Lines of the .changes file: fields, and below `Files:` each file."""
    return next(PACKAGES.glob("waitpoint_*.changes")).read_text()


class Built(unittest.TestCase):
    def test_are_those_of_debian_control_for_the_profiles(self):
        built_with = re.search(r"^Built-For-Profiles: (.*)$", changes(), re.MULTILINE)
        profiles = built_with[1].split() if built_with else []
        expected = set()
        for paragraph in (TREE / "debian/control").read_text().split("\n\n"):
            name = re.search(r"^Package: (\S+)$", paragraph, re.MULTILINE)
            without = re.search(r"^Build-Profiles: <!(\S+)>$", paragraph, re.MULTILINE)
            if name and not (without and without[1] in profiles):
                expected.add(name[1])
        found = {path.name.split("_")[0] for path in PACKAGES.glob("*.deb")}
        self.assertEqual({name for name in found if not name.endswith("-dbgsym")}, expected)
        # Each that has programs or libraries has its debugging information beside it.
        with_code = {name for name in expected if not name.endswith(("-dev", "-doc"))}
        self.assertEqual({name.removesuffix("-dbgsym") for name in found if name.endswith("-dbgsym")}, with_code)

    def test_have_no_errors_or_warnings_of_lintian(self):
        # --allow-root: it reads packages that were built here.
        run("lintian", "--allow-root", "--fail-on", "error,warning", next(PACKAGES.glob("waitpoint_*.changes")))

    def test_symbols_files_are_those_of_the_libraries(self):
        version = re.search(r"^Version: (\S+?)(-\d+)?$", changes(), re.MULTILINE)[1]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for file in (TREE / "debian").glob("*.symbols"):
                shutil.copy2(file, folder)
                run("dpkg-deb", "-x", next(PACKAGES.glob(f"{file.stem}_*.deb")), folder / "root")
            run(sys.executable, TREE / "tools/dev/symbols.py", folder / "root", version, folder)
            for file in (TREE / "debian").glob("*.symbols"):
                self.assertTrue(file.read_text() == (folder / file.name).read_text(),
                                f"{file.name} is not that of the library: tools/dev/symbols.py brings it up to date")

    @unittest.skipUnless(OTHER, "needs the packages of a second build")
    def test_two_builds_are_the_same_bytes(self):
        names = sorted(path.name for path in PACKAGES.iterdir() if not path.name.endswith((".buildinfo", ".changes")))
        self.assertEqual(names, sorted(path.name for path in OTHER.iterdir() if not path.name.endswith((".buildinfo", ".changes"))))
        differ = [name for name in names if (PACKAGES / name).read_bytes() != (OTHER / name).read_bytes()]
        print(f"{len(names) - len(differ)} of {len(names)} files are the same bytes in both builds")
        self.assertEqual(differ, [])


if __name__ == "__main__":
    if not next(PACKAGES.glob("waitpoint_*.deb"), None):
        sys.exit(f"{PACKAGES}: expected packages waitpoint_*.deb; `./dev package` builds them")
    unittest.main(argv=sys.argv[:1])
