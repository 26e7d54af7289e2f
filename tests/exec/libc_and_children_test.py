# SPDX-License-Identifier: BSD-3-Clause
"""Optional parts of the simulation by `waitpoint exec`: libc_and_children_test.py BUILD.

Internal waits of the C library (--trap-libc), and started programs (--children).
"""

import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT


class WithinTheCLibrary(ExecCase):
    """Internal waits of the C library, at which no function of the layer is called."""

    def run_by(self, what, *options, timeout=60):
        words = [WAITPOINT, "exec", "--quiet", *options, "--", self.compile("within_libc.c"), what]
        return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=timeout)

    def test_locks_and_streams_are_simulated_by_traps(self):
        # As natively on an idle machine: on a loaded one its sleeps may take longer.
        for what, order in (("lock", "abc"), ("character", "abc"), ("pipe", "wline"), ("much", "WR")):
            done = self.run_by(what, "--trap-libc")
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", order + "\n"), what)

    def test_such_a_lock_is_waited_for_for_ever_without_them(self):
        with self.assertRaises(subprocess.TimeoutExpired):
            self.run_by("lock", timeout=2)

    def test_started_programs_answer_the_traps_or_have_none(self):
        for options in (), ("--children", "native"):
            self.assertEqual(self.run_by("start", "--trap-libc", *options).stdout, "5\n3\n")


class Children(ExecCase):
    """Programs started by a simulated one."""

    def test_are_native_or_simulated(self):
        program = self.compile("starts.c")
        ways = "system", "popen", "posix_spawn", "fork"

        def run(*options):
            words = [WAITPOINT, "exec", "--quiet", *options, "--", program]
            done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 7, done.stderr)
            return done.stdout.splitlines()

        # The simulation's year is 2024.
        simulated = [line for way in ways for line in ("2024", f"{way} 7")] + ["2024"]
        self.assertEqual(run("--children", "simulated"), simulated)
        self.assertEqual(run(), simulated)
        years = {line for line in run("--children", "native") if " " not in line}
        self.assertEqual(len(years), 1)
        self.assertNotIn("2024", years)

    def test_a_statically_linked_child_of_a_shell_is_waited_for(self):
        program = self.folder / "static"
        source = '#include <stdio.h>\n#include <unistd.h>\nint main(void) { usleep(200000); return puts("native") < 0; }\n'
        subprocess.run(["gcc", "-static", "-x", "c", "-", "-o", program], input=source, text=True, check=True)
        done = subprocess.run([WAITPOINT, "exec", "--quiet", "--", "dash", "-c", f"{program}; echo after"],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (0, "native\nafter\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
