# SPDX-License-Identifier: BSD-3-Clause
"""Locks that are atomics, of runtimes and libraries, in release binaries: locks_test.py BUILD [--measure [SEEDS]].

Each program has three bugs; the default strategy must find them, and nothing in their safe twins. --measure prints a table: the
schedules until the first failure, of 20 seeds."""

import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import unittest

from exec_case import BUILD, HERE, ExecCase, explore, replay_words

CASES = ("update", "wake-up", "crossed")
CRATES = pathlib.Path("/usr/share/cargo/registry")  # Debian's, without a network


def measured_seeds():
    if "--measure" not in sys.argv:
        return 0
    at = sys.argv.index("--measure")
    seeds = int(sys.argv[at + 1]) if len(sys.argv) > at + 1 else 20
    del sys.argv[at:]
    return seeds


SEEDS = measured_seeds()


class Locks(ExecCase):
    def setUp(self):
        if not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no library for accesses")
        self.programs = self.folder / "locks"
        self.programs.mkdir(exist_ok=True)

    def built(self, command, name):
        """The program made by a command, with optimisation."""
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=self.programs)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.programs / name

    def require(self, tool):
        if shutil.which(tool) is None:
            self.skipTest(f"{tool} is not installed")

    def package(self, name):
        """The flags of a library."""
        done = subprocess.run(["pkg-config", "--cflags", "--libs", name], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(f"pkg-config does not know {name}")
        return done.stdout.split()

    def with_crate(self, crate):
        self.require("cargo")
        if not list(CRATES.glob(f"{crate}-[0-9]*")):
            self.skipTest(f"librust-{crate.replace('_', '-')}-dev is not installed")
        folder = self.programs / f"{crate}_project"
        folder.mkdir()
        (folder / "Cargo.toml").write_text(f'[package]\nname = "of_{crate}"\nversion = "0.1.0"\nedition = "2021"\n\n'
                                           f'[dependencies]\n{crate} = "*"\n\n[[bin]]\nname = "of_{crate}"\npath = "{HERE}/locks/{crate}.rs"\n')
        sources = ['source.crates-io.replace-with="debian"', f'source.debian.directory="{CRATES}"']
        os.environ["CARGO_TARGET_DIR"] = str(folder)
        return self.built(["cargo", "build", "--offline", "--release", "--manifest-path", folder / "Cargo.toml",
                           *(word for source in sources for word in ("--config", source))], folder / f"release/of_{crate}")

    def explored(self, program, *words, seed, schedules="1000"):
        return explore("--seed", seed, "--iterations", schedules, "--no-minimize", "--", program, *words)

    def look_for_bugs(self, program):
        if SEEDS > 0:
            return self.measure(program)
        for case in CASES:
            for seed in (1, 2, 3):
                done = self.explored(program, case, seed=seed)
                self.assertEqual(done.returncode, 1, f"{case} {seed}: {done.stdout}{done.stderr}")
            self.assertIn("the same run as in the record", explore(*replay_words(done.stdout)).stderr, case)
            done = self.explored(program, case, "safe", seed=1, schedules="200")
            self.assertEqual(done.returncode, 0, f"safe {case}: {done.stdout}{done.stderr}")
            self.assertNotIn("exhaust", done.stdout, f"safe {case}")
            at_calls = explore("--switch-at", "calls", "--iterations", "400", "--", program, case)
            self.assertNotIn("exhaust", at_calls.stdout, f"{case} at calls")

    def measure(self, program):
        for case in CASES:
            numbers, seconds = [], []
            for seed in range(1, SEEDS + 1):
                done = self.explored(program, case, seed=seed, schedules="100000")
                found = re.search(r"^schedule (\d+) of", done.stdout, re.M)
                numbers.append(int(found[1]) if found else float("inf"))
                seconds.append(float(re.search(r" in ([0-9.]+) s", done.stdout)[1]))
            print(f"| {program.name} | {case} | {statistics.median(numbers):g} | {max(numbers):g} | {statistics.median(seconds):.2f} |", flush=True)

    def test_bugs_are_found_with_rust(self):
        self.require("rustc")
        self.look_for_bugs(self.built(["rustc", "-O", HERE / "locks/standard.rs", "-o", "standard"], "standard"))

    def test_bugs_are_found_with_parking_lot(self):
        self.look_for_bugs(self.with_crate("parking_lot"))

    def test_bugs_are_found_with_crossbeam(self):
        self.look_for_bugs(self.with_crate("crossbeam"))

    def test_bugs_are_found_with_glib(self):
        self.look_for_bugs(self.built(["gcc", "-O2", HERE / "locks/glib.c", "-o", "glib", *self.package("glib-2.0")], "glib"))

    def test_bugs_are_found_with_abseil(self):
        flags = self.package("absl_synchronization")
        self.look_for_bugs(self.built(["g++", "-std=c++20", "-O2", HERE / "locks/abseil.cpp", "-o", "abseil", *flags], "abseil"))

    def test_bugs_are_found_with_abseil_linked_statically(self):
        flags = ["-Wl,-Bstatic", *self.package("absl_synchronization"), "-Wl,-Bdynamic"]
        self.look_for_bugs(self.built(["g++", "-std=c++20", "-O2", HERE / "locks/abseil.cpp", "-o", "abseil_static", *flags], "abseil_static"))

    def test_bugs_are_found_with_waits_for_atomics(self):
        self.look_for_bugs(self.built(["g++", "-std=c++20", "-O2", "-pthread", HERE / "locks/atomic_waits.cpp", "-o", "atomic_waits"], "atomic_waits"))


if __name__ == "__main__":
    unittest.main()
