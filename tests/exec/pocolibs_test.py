# SPDX-License-Identifier: BSD-3-Clause
"""The regression tests of pocolibs, LAAS's libraries under GenoM's modules, run by `waitpoint exec`:
pocolibs_test.py BUILD SOURCES.

SOURCES is its source folder, with its libraries and regression tests compiled as its README says. Each test passes, as
natively, with one digest for a seed. Two threads of a test pass a turn in a strict order only if both are scheduled
fairly: `--strategy fifo`. Two tests wait in loops without calls for a signal's handler: they are left out unless all of
it was compiled with -fsanitize=thread, so that the loops are seen. And tests/programs/crane, compiled with these
libraries, prints by `exec` what it prints with those of fibers/laas.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv.pop()).resolve()

from exec_case import ExecCase, Summary, WAITPOINT  # noqa: E402  takes the first argument

CRANE = pathlib.Path(__file__).resolve().parents[1] / "programs/crane"
LIBRARIES = [SOURCES / "src" / name / ".libs" for name in ("posterLib", "comLib", "portLib")]
SECONDS_MAX = 60
LOOPS_WITHOUT_CALLS = {"tick", "h2timefromts"}


def is_instrumented():
    return b"__tsan_init" in (SOURCES / "src/portLib/.libs/libportLib.so").read_bytes()


def programs():
    """The compiled tests: libtool's wrappers, which are scripts, or executables."""
    regress = SOURCES / "src/regress"
    return sorted(file.with_suffix("") for file in regress.glob("*Lib/*.c") if file.with_suffix("").exists())


class Regression(ExecCase):
    def run_test(self, program, *command):
        # Its devices' list is a file, which a test may leave behind.
        with tempfile.TemporaryDirectory() as folder:
            words = [str(word) for word in (*command, program)]
            return subprocess.run(words, env={"PATH": "/usr/bin:/bin", "H2DEV_DIR": folder}, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", timeout=SECONDS_MAX)

    def test_pass_and_repeat(self):
        tested = 0
        left_out = set() if is_instrumented() else LOOPS_WITHOUT_CALLS
        for number, program in enumerate(programs(), 1):
            print(f"{number} of {len(programs())}: {program.name}", file=sys.stderr)
            with self.subTest(program.name):
                if program.name in left_out:
                    print(f"{program.name}: left out, as it waits in a loop without calls", file=sys.stderr)
                    continue
                fair = self.run_test(program, WAITPOINT, "exec", "--strategy", "fifo", "--")
                self.assertEqual(fair.returncode, 0, fair.stdout + fair.stderr)
                runs = [self.run_test(program, WAITPOINT, "exec", "--seed", seed, "--") for seed in (1, 1, 2, 2)]
                digests = [Summary(run.stderr).digest for run in runs]
                self.assertEqual((digests[0], digests[2]), (digests[1], digests[3]), runs[0].stderr)
                tested += 1
        self.assertGreater(tested, 0, f"there are no compiled tests in {SOURCES}/src/regress")
        print(f"{tested} tests of pocolibs pass, with one digest for a seed", file=sys.stderr)

    def test_a_program_has_the_output_of_our_libraries(self):
        with tempfile.TemporaryDirectory() as folder:
            crane = pathlib.Path(folder) / "crane"
            paths = [word for path in LIBRARIES for word in (f"-L{path}", f"-Wl,-rpath,{path}")]
            subprocess.run(["gcc", "-O1", f"-I{SOURCES}/include", CRANE / "crane.c", "-o", crane, "-rdynamic", *paths,
                            "-lposterLib", "-lcomLib", "-lportLib"], check=True)
            expected = (CRANE / "crane.out").read_text()
            self.assertEqual(self.run_test(crane).stdout, expected)
            for seed in range(5):
                done = self.run_test(crane, WAITPOINT, "exec", "--seed", seed, "--")
                self.assertEqual((done.returncode, done.stdout), (0, expected), done.stderr)


if __name__ == "__main__":
    unittest.main()
