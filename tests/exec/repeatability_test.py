# SPDX-License-Identifier: BSD-3-Clause
"""Sources of what does not repeat natively, as programs use them: repeatability_test.py BUILD.

Runs of one seed print the same; with --strict, what cannot be simulated ends the run.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

from exec_case import ExecCase, WAITPOINT

PYTHON = "/usr/bin/python3"

CTYPES = """
import ctypes
library = ctypes.CDLL("libc.so.6")
number = ctypes.c_ulong()
library.getrandom(ctypes.byref(number), 8, 0)
print(library.getpid(), library.time(None), number.value)
"""

TEMPORARY = """
import os, tempfile
with tempfile.TemporaryDirectory() as folder:
    descriptor, name = tempfile.mkstemp(dir=folder)
    print(name, os.stat(name).st_ino, os.fstat(descriptor).st_mtime_ns, os.stat(folder).st_ctime_ns)
"""

READY_IN_REVERSE = """
import os, select
waiting = select.epoll()
pipes = [os.pipe() for _ in range(4)]
for reading, _ in pipes: waiting.register(reading, select.EPOLLIN)
for _, writing in reversed(pipes): os.write(writing, b"x")
print([[reading for reading, _ in pipes].index(ready) for ready, _ in waiting.poll()])
"""


def run(*words, options=(), seed=1, **more):
    command = [str(word) for word in (WAITPOINT, "exec", "--quiet", "--seed", seed, *options, "--", *words)]
    more.setdefault("stdin", subprocess.DEVNULL)
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **more)


class Sources(ExecCase):
    """What the programs print is the same in two runs of a seed."""

    def repeats(self, *words, **more):
        """The output."""
        one, other = run(*words, **more), run(*words, **more)
        self.assertEqual((one.returncode, one.stdout), (0, other.stdout), one.stderr)
        self.assertNotEqual(one.stdout, "")
        return one.stdout

    def shell(self, script, **more):
        return self.repeats("sh", "-c", script, **more)

    def test_random_numbers_by_each_way(self):
        self.shell("head -c 8 /dev/urandom | od -x; cat /proc/sys/kernel/random/uuid")
        self.assertNotEqual(run(PYTHON, "-c", CTYPES).stdout, run(PYTHON, "-c", CTYPES, seed=2).stdout)
        words = self.repeats(PYTHON, "-c", CTYPES).split()
        self.assertEqual(words[:2], ["1000", "1704067200"])

    def test_names_and_inodes_and_dates_of_temporary_files(self):
        self.repeats(PYTHON, "-c", TEMPORARY)
        self.shell('name=$(mktemp) && echo $name && stat -c "%i %y" $name && rm $name')

    def test_the_state_of_the_machine(self):
        self.assertIn("up  1:00", self.shell("uptime; free; df /; cat /proc/stat /proc/loadavg"))

    def test_the_state_of_processes(self):
        self.assertEqual(self.shell("ps -o pid,ppid,comm --no-headers").split()[:3], ["1000", "1", "sh"])
        self.shell("cat /proc/self/stat /proc/self/status /proc/self/statm; ls -l /proc/self/fd | cut -d'>' -f2")

    def test_dates_and_inodes_of_files_that_a_script_makes(self):
        with tempfile.TemporaryDirectory() as folder:
            script = ('echo one > one; sleep 2; echo two > two; mkdir folder; touch -d "2001-02-03" old; '
                      'stat -c "%n %i %y" one two folder old; cp -p old copy; stat -c %y copy; rm -r one two folder old copy')
            lines = self.shell(script, cwd=folder).splitlines()
            self.assertIn("2024-01-01 00:00:00", lines[0])
            self.assertIn("2024-01-01 00:00:02", lines[1])
            self.assertIn("2001-02-03", lines[3])
            self.assertIn("2001-02-03", lines[4])

    def test_the_order_of_a_directory(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [f"{number * 7919 % 1000:03}" for number in range(200)]
            for name in names:
                (pathlib.Path(folder) / name).touch()
            found = run(PYTHON, "-c", "import os; print(*os.listdir())", cwd=folder)
            self.assertEqual(found.stdout.split(), sorted(names), found.stderr)
            self.assertEqual(run("ls", "-U", cwd=folder).stdout.split(), sorted(names))
            self.assertEqual(run("find", ".", "-type", "f", cwd=folder).stdout.split(), [f"./{name}" for name in sorted(names)])

    def test_the_order_in_which_epoll_finds_descriptors_ready(self):
        self.assertEqual(self.repeats(PYTHON, "-c", READY_IN_REVERSE), "[0, 1, 2, 3]\n")

    def test_dates_of_files_that_it_does_not_change_are_the_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "file"
            file.write_text("contents")
            os.utime(file, (1600000000, 1500000000))
            self.assertEqual(run("stat", "-c", "%Y", file).stdout, "1500000000\n")


class Strict(ExecCase):
    """Ends the run with the source and the place."""

    def ends(self, *words, source, **more):
        done = run(*words, options=["--strict"], **more)
        self.assertEqual(done.returncode, 125, done.stdout + done.stderr)
        line = done.stderr.splitlines()[0]
        self.assertIn(f"waitpoint: exec: --strict: {source} does not repeat: used by main, at ", line)
        return line

    def test_files_of_the_system(self):
        for path in ("/proc/interrupts", "/proc/sys/kernel/ns_last_pid", "/proc/sysvipc/shm", "/proc/self/oom_score",
                     "/proc/1/stat"):
            self.ends("cat", path, source=path)
        program = self.folder / "reads.c"
        program.write_text("#include <fcntl.h>\nint main(void) { return open(\"/proc/vmstat\", O_RDONLY) < 0; }\n")
        line = self.ends(self.compile(str(program)), source="/proc/vmstat")
        self.assertRegex(line, r"at main \(\S+reads\+0x[0-9a-f]+\)$")

    def test_input_from_outside(self):
        reader, writer = os.pipe()
        with open(reader) as stdin, open(writer, "w"):
            self.ends("cat", source="input from outside, from descriptor 0,", stdin=stdin)

    def test_traffic_beyond_the_machine(self):
        program = "import socket\nsocket.create_connection(('192.0.2.1', 80), timeout=0.1)"
        self.ends(PYTHON, "-c", program, source="traffic beyond this machine")

    def test_programs_that_cannot_be_simulated(self):
        (self.folder / "empty.c").write_text("int main(void) { return 0; }\n")
        static = self.folder / "linked-statically"
        subprocess.run(["gcc", "-static", self.folder / "empty.c", "-o", static], check=True)
        self.ends("env", static, source=f"{static}, which cannot be simulated,")

    def test_leaves_other_runs_alone(self):
        done = run("sh", "-c", "ls / | wc -l; date; cat /proc/uptime", options=["--strict"])
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_refuses_options_that_do_not_repeat(self):
        for options in (["--children", "native"], ["--clock", "cpu"]):
            done = run("true", options=["--strict", *options])
            self.assertEqual(done.returncode, 125, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


class Counter(ExecCase):
    def test_is_trapped_in_started_programs_too(self):
        self.require_trapped_counter()
        done = run("sh", "-c", "ls / > /dev/null; date +%Y | cat", options=["--trap-rdtsc"])
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "2024\n", ""))


if __name__ == "__main__":
    unittest.main()
