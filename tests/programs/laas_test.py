# SPDX-License-Identifier: BSD-3-Clause
"""C programs written to the API of pocolibs are compiled unchanged, with the installed library: laas_test.py BUILD."""

import os
import re
import subprocess

from installed import HERE, Installed, flags, main, run

STRICT = ["-O1", "-g", "-Wall", "-Wextra", "-Werror"]


class Pocolibs(Installed):
    def program(self, name):
        """NAME/NAME.c, compiled by a compiler of C with the flags of pkg-config."""
        program = self.folder / name
        if not program.exists():
            run("gcc", *STRICT, HERE / name / f"{name}.c", "-o", program,
                *flags(self.prefix, "--cflags", "--libs", "waitpoint-pocolibs"), cwd=self.folder)
        return program

    def run_program(self, program, **variables):
        environment = {**os.environ, **{f"WAITPOINT_{key}": str(value) for key, value in variables.items()}}
        return subprocess.run([program], env=environment, capture_output=True, text=True, timeout=120)

    def test_a_program_has_the_output_of_pocolibs(self):
        # The file is what it prints natively, compiled with pocolibs.
        expected = (HERE / "crane/crane.out").read_text()
        crane = self.program("crane")
        for seed in range(10):
            done = self.run_program(crane, SEED=seed)
            self.assertEqual((done.returncode, done.stdout), (0, expected), done.stderr)

    def test_a_bug_is_found_and_replayed(self):
        late_reply = self.program("late_reply")
        self.assertEqual(self.run_program(late_reply).returncode, 0)
        found = self.run_program(late_reply, ITERATIONS=1000)
        self.assertEqual(found.returncode, 1, found.stderr)
        self.assertIn("main() returned a status other than 0", found.stderr)
        self.assertIn('about to send mailbox #8 "askerR"', found.stderr)
        token = re.search(r"^replay: WAITPOINT_REPLAY=(\S+) .*/late_reply$", found.stderr, re.MULTILINE)[1]
        replayed = self.run_program(late_reply, REPLAY=token)
        self.assertEqual(replayed.returncode, 1, replayed.stderr)
        self.assertIn("main() returned a status other than 0", replayed.stderr)

    def test_a_deadlock_is_reported(self):
        done = self.run_program(self.program("no_letter"))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r'task tMain of environment waits \(receive\) for mailbox #\d+ "letters"')

    def test_a_mistake_in_the_environment_is_one_line(self):
        done = self.run_program(self.program("crane"), SEED="x")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertRegex(done.stderr, r"^WAITPOINT_SEED.*\n$")

    def test_each_header_stands_alone_in_c_and_in_cpp(self):
        headers = sorted((self.prefix / "include/waitpoint/fibers/laas/include").glob("*.h"))
        self.assertGreater(len(headers), 20)
        options = flags(self.prefix, "--cflags", "waitpoint-pocolibs")
        for language in ("c", "c++"):
            for header in headers:
                source = self.folder / "header.c"
                source.write_text(f"#include <{header.name}>\n")
                run("gcc", *STRICT, "-x", language, "-fsyntax-only", *options, source)


if __name__ == "__main__":
    main()
