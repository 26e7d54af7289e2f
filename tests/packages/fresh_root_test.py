# SPDX-License-Identifier: BSD-3-Clause
"""Debian's packages in a fresh root: fresh_root_test.py PACKAGES [BASE].

Makes a minimal Debian 12 outside of the tree (or copies BASE, one that debootstrap made), installs the packages from the folder
PACKAGES in it, each kind by itself, and uses them. Needs root, debootstrap and Debian's archive. `./dev test --packages` builds
the packages and runs this.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path()
BASE = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
DIGEST = re.compile(r"^  digest +(wp1:[0-9a-f]{16})$", re.MULTILINE)
# What the package system itself keeps of a package that was there.
OF_THE_SYSTEM = re.compile(r"/(proc|dev|tmp|var/(lib/(dpkg|apt|systemd)|cache|log)|etc/ld\.so\.cache|etc/alternatives|usr/share/man)\b")


class FreshRoot(unittest.TestCase):
    """The packages are installed in the order of the tests' names, in one root."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fresh-root-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.root = cls.folder / "root"
        if BASE:
            subprocess.run(["cp", "-a", BASE, cls.root], check=True)
        else:
            subprocess.run(["debootstrap", "--variant=minbase", "bookworm", cls.root], check=True, stdout=subprocess.DEVNULL)
        (cls.root / "packages").mkdir()
        for package in PACKAGES.glob("*.deb"):
            if "-dbgsym_" not in package.name:
                shutil.copy2(package, cls.root / "packages")
        for part in ("README.md", "CONTRIBUTING.md", "debian/tests", "docs", "scenarios", "tests/docs", "tests/golden", "tests/programs"):
            of_tree, copy = TREE / part, cls.root / "tree" / part
            copy.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if of_tree.is_dir() else shutil.copy2)(of_tree, copy)
        cls.inside("apt-get update -q")
        cls.before, cls.others = cls.files(), []

    @classmethod
    def inside(cls, command, status=0):
        """The output of a shell's command in the root, in a name space of its own: nothing stays mounted, no process is left."""
        words = ["unshare", "--mount", "--pid", "--fork", "--kill-child", "chroot", cls.root, "sh", "-c",
                 "mount -t proc proc /proc && mount -t devpts -o newinstance,ptmxmode=0666 devpts /dev/pts && "
                 "mount --bind /dev/pts/ptmx /dev/ptmx && cd /root && { " + command + "\n}"]
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8",
                       "DEBIAN_FRONTEND": "noninteractive"}
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, timeout=1800)
        if done.returncode != status:
            raise AssertionError(f"{command}\nended with {done.returncode}, expected {status}:\n{done.stdout[-4000:]}")
        return done.stdout

    @classmethod
    def files(cls):
        found = set()
        for folder, folders, names in os.walk(cls.root):
            place = "/" + os.path.relpath(folder, cls.root)
            found |= {os.path.normpath(f"{place}/{name}") for name in names + folders}
        return {path for path in found if not OF_THE_SYSTEM.match(path) and not path.startswith(("/root/", "/tree", "/packages"))}

    @classmethod
    def install(cls, *names, more=""):
        """Installs packages of the folder by name, and MORE of Debian's; returns the names of all that came with them."""
        earlier = set(cls.inside("dpkg-query -W -f '${Package}\\n'").split())
        debs = " ".join(f"/packages/{name}_*.deb" for name in names)
        cls.inside(f"apt-get install -y -q --no-install-recommends {debs} {more}")
        cls.others += more.split()
        return set(cls.inside("dpkg-query -W -f '${Package}\\n'").split()) - earlier

    def digest(self, command):
        """Of a run, which may be cut off: that is status 1."""
        return DIGEST.search(self.inside(f"{command} || test $? = 1"))[1]

    def test_1_program(self):
        begin = time.monotonic()
        came = self.install("waitpoint")
        run = self.inside("waitpoint run office.yaml")
        print(f"waitpoint installed, with {len(came) - 1} other packages, and office run: {time.monotonic() - begin:.0f} s")
        heavy = [name for name in came if re.match(r"ros-|libros|libopenmpi|libtcl|python|libeigen|.*-dev$", name)]
        self.assertEqual(heavy, [])
        self.assertIn(DIGEST.search(run)[1], (TREE / "README.md").read_text())
        self.inside("waitpoint run office-one-processor.yaml --until 20 || test $? = 1; sh /tree/debian/tests/office")
        self.inside("waitpoint run office.yaml --until 3 --verify && waitpoint check office.yaml")
        self.inside("waitpoint explore office.yaml --until 1 --iterations 2")
        self.inside("waitpoint run office.yaml --until 2 --picture o.svg --record o.mcap --page o.html || test $? = 1; test -s o.html")
        self.assertRegex(self.inside("waitpoint exec -- /bin/sleep 1000"), r"\d")
        self.assertEqual(self.digest("waitpoint run office.yaml --until 2 --set world.engine=bullet"),
                         self.digest("waitpoint run office.yaml --until 2 --set world.engine=bullet"))

    def test_2_parts_that_are_not_installed_are_named(self):
        for option, package in {"--record x.bag": "waitpoint-bags", "--ranks 2": "waitpoint-mpi"}.items():
            said = self.inside(f"waitpoint run office.yaml --until 1 {option}", status=2)
            self.assertIn(f"install the package {package}", said)
            self.assertEqual(said.count("\n"), 1, said)

    def test_3_parts(self):
        alone = self.digest("waitpoint run office.yaml --until 2")
        self.install("waitpoint-mpi", "waitpoint-tcl")
        as_root = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1"
        ranks = self.digest(f"{as_root} waitpoint run office-10.yaml --until 1 --ranks 2")
        self.assertEqual(ranks, self.digest("waitpoint run office-10.yaml --until 1"))
        self.assertTrue(self.digest("waitpoint run office-tcl.yaml --until 5"))
        if next(PACKAGES.glob("waitpoint-bags_*.deb"), None):
            self.install("waitpoint-bags")
            self.assertEqual(self.digest("waitpoint run office.yaml --until 2 --record x.bag"), alone)
            self.assertTrue((self.root / "root/x.bag").stat().st_size > 1000)

    def test_4_library_for_threads(self):
        came = self.install("libwaitpoint-dev", "libwaitpoint1", more="g++ libgtest-dev pkg-config")
        self.assertEqual([name for name in came if re.search(r"fcl|eigen|ros|yaml|octomap", name)], [])
        self.inside("sh /tree/debian/tests/lost-letter")

    def test_5_library_for_robots(self):
        came = self.install("libwaitpoint-robots-dev", "libwaitpoint-robots1")
        self.assertEqual([name for name in came if re.search(r"eigen|ros-|-dev$", name)], ["libwaitpoint-robots-dev"])
        self.inside("sh /tree/debian/tests/blinker")

    def try_pages(self, *names):
        """The commands of pages, with what is installed in the place of a build."""
        for name in names:
            with self.subTest(page=name):
                self.inside(f"cd /tree && python3 -B tests/docs/pages_test.py /usr Pages.test_{name}")

    def test_6_commands_of_the_tutorials(self):
        self.install("waitpoint", more="python3")
        self.try_pages("README", "threads", "robots", "programs")

    def test_7_nodes_of_ros(self):
        if not next(PACKAGES.glob("waitpoint-ros_*.deb"), None):
            self.skipTest("waitpoint-ros was not built")
        self.install("waitpoint-ros", more="python3-rospy python3-nav-msgs python3-sensor-msgs ros-robot-state-publisher "
                                           "libnodeletlib-tools")
        self.inside("sh /tree/debian/tests/nodes")
        self.try_pages("ros")

    def test_8_nothing_is_left(self):
        ours = [name for name in self.inside("dpkg-query -W -f '${Package}\\n'").split() if "waitpoint" in name]
        self.inside(f"apt-get purge -y -q {' '.join(ours + self.others)} && apt-get autoremove --purge -y -q")
        left = self.files() - self.before
        self.assertEqual(sorted(path for path in left if "waitpoint" in path), [])
        self.assertEqual(self.inside("dpkg-query -W -f '${Package} ${db:Status-Status}\\n' '*waitpoint*' 2>/dev/null || true"), "")
        print(f"left of other packages: {len(left)} files")


if __name__ == "__main__":
    if not next(PACKAGES.glob("waitpoint_*.deb"), None):
        sys.exit(f"{PACKAGES}: expected packages waitpoint_*.deb; `./dev package` builds them")
    unittest.main(argv=sys.argv[:1])
