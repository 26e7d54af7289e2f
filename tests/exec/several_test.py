# SPDX-License-Identifier: BSD-3-Clause
"""Several programs in one simulation: several_test.py BUILD [CLASS[.TEST]...].

`waitpoint exec -- A :: B` makes each a process of its own. Their sources are independent of waitpoint (several/).
"""

import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"
PROGRAMS = BUILD / "tests/exec/several"
INSTANCE = str(PROGRAMS / "instance-program")


def several(*programs):
    """The command line of several programs, each given as a list."""
    words = []
    for program in programs:
        words += ([] if not words else ["::"]) + [str(word) for word in program]
    return words


def execute(words, *options, folder=None):
    return subprocess.run([WAITPOINT, "exec", *options, "--", *words], capture_output=True, text=True, timeout=30,
                          cwd=folder)


def digest(run):
    return re.search(r"digest (wp1:[0-9a-f]{16})", run.stderr).group(1)


def instance(number, *way):
    return [INSTANCE, number, *way]


CHAIN = [[PROGRAMS / "writer.so", 1, 10], [PROGRAMS / "filter.so", 1, 2], [PROGRAMS / "reader.so", 2]]


class Chain(unittest.TestCase):
    """A writer, a filter and a reader, over System V shared memory and semaphores."""

    def test_lines_come_through_in_virtual_time(self):
        run = execute(several(*CHAIN))
        self.assertEqual(run.stdout, "".join(f"LINE {i} AT {i // 10}.{i % 10} S\n" for i in range(2, 11, 2)) + "5 lines\n")
        self.assertRegex(run.stderr, r"3 programs: 4 processes, 5 threads, 1 at once, \d+ events, .* 1\.0000\d+ s of virtual time")
        self.assertIn("waitpoint: exit status: filter 0, reader 5, writer 0\n", run.stderr)
        self.assertEqual(run.returncode, 5)

    def test_a_seed_is_one_run_and_another_seed_another(self):
        runs = [execute(several(*CHAIN), "--seed", str(seed)) for seed in (1, 1, 2)]
        self.assertEqual(digest(runs[0]), digest(runs[1]))
        self.assertNotEqual(digest(runs[0]), digest(runs[2]))
        self.assertEqual(runs[0].stdout, runs[2].stdout)

    def test_waits_for_ever_for_a_missing_partner(self):
        run = execute(several(CHAIN[0], CHAIN[1]))
        self.assertEqual(run.returncode, 124)
        self.assertRegex(run.stderr, r"deadlock at .*\n(  .*\n)*  filter: main waits for System V semaphores")
        self.assertRegex(run.stderr, r"\n  writer: main waits for the end of a thread, that is writer: thread 1\n")

    def test_sem_undo_releases_at_the_end_of_a_program(self):
        run = execute(several(*([PROGRAMS / "holder.so", 5] for _ in range(3))))
        self.assertEqual((run.returncode, run.stdout), (0, "has it\n" * 3), run.stderr)

    def test_schedules_are_explored(self):
        words = several(["a=" + INSTANCE, 1], ["b=" + INSTANCE, 1, "1"])
        run = subprocess.run([WAITPOINT, "explore", "--iterations", "3", "--", *words], capture_output=True,
                             text=True, timeout=30)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertIn("exit status 1", run.stdout + run.stderr)


class Sockets(unittest.TestCase):
    def test_listener_learns_the_end_of_the_other_program(self):
        name = f"waitpoint-test-{random.randrange(10**9)}"
        talker = PROGRAMS / "talker.so"
        run = execute(several([talker, "call", name], [talker, "serve", name]))
        self.assertEqual(run.stdout, "heard: it is 4 s\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(" 4.0", run.stderr)


class Instances(unittest.TestCase):
    """Many copies of one program."""

    def test_each_of_a_hundred_has_globals_of_its_own(self):
        run = execute(several(*(instance(i) for i in range(100))))
        self.assertEqual(run.returncode, 0, run.stderr)
        lines = run.stdout.splitlines()
        self.assertEqual(len(lines), 200)
        for i in range(100):
            self.assertIn(f"{i}: 3 3 3 3 3, 2", lines)
            self.assertIn(f"{i}: destroyed at 3", lines)
        self.assertIn("100 programs: 101 processes, 301 threads", run.stderr)
        self.assertIn("exit status: 0 of all 100\n", run.stderr)

    def test_the_order_in_which_they_are_named_does_not_matter(self):
        programs = [instance(i) for i in range(100)]
        expected = execute(several(*programs))
        for seed in range(3):
            random.Random(seed).shuffle(programs)
            run = execute(several(*programs))
            self.assertEqual(digest(run), digest(expected))
            self.assertEqual(run.stdout, expected.stdout)

    def test_fifo_does_not_depend_on_it_either(self):
        programs = [instance(i) for i in range(5)]
        runs = [execute(several(*order), "--strategy", "fifo") for order in (programs, programs[::-1])]
        self.assertEqual(digest(runs[0]), digest(runs[1]))

    def test_names_are_by_default_those_of_the_files(self):
        run = execute(several([f"front={INSTANCE}", 1, 2], instance(2), instance(3)))
        self.assertIn("exit status: front 2, instance-program#1 0, instance-program#2 0\n", run.stderr)
        self.assertEqual(run.returncode, 2)

    def test_a_shared_object_alone(self):
        run = execute(["holder.so", "5"], folder=PROGRAMS)
        self.assertEqual((run.returncode, run.stdout), (0, "has it\n"), run.stderr)
        self.assertRegex(run.stderr, r"^waitpoint: holder: 1 thread, ")


class Ends(unittest.TestCase):
    """One of two ends in its own way; the other continues."""

    def ends(self, way, status, destroyed, first=""):
        run = execute(several([f"other={INSTANCE}", "other"], [f"one={INSTANCE}", "one", way]))
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn("other: 3 3 3 3 3, 2\n", run.stdout)
        self.assertIn("other: destroyed at 3\n", run.stdout)
        self.assertEqual("one: destroyed at 3\n" in run.stdout, destroyed, run.stdout)
        self.assertIn(first, run.stderr)
        self.assertIn(f"waitpoint: exit status: one {status}, other 0\n", run.stderr)
        return run

    def test_main_returns(self):
        self.ends("9", 9, destroyed=True)

    def test_exit_in_a_thread(self):
        self.ends("exit", 3, destroyed=True)

    def test_underscore_exit_in_a_thread(self):
        self.ends("_exit", 4, destroyed=False)

    def test_abort(self):
        self.ends("abort", 134, destroyed=False, first="waitpoint: one was terminated by signal 6 (Aborted)\n")

    def test_an_assertion(self):
        self.ends("assert", 134, destroyed=False, first="Assertion `times == 0' failed.\n")

    def test_an_uncaught_exception(self):
        self.ends("throw", 134, destroyed=False, first="terminate called after throwing an instance of 'int'\n")

    def test_the_last_thread_leaves(self):
        self.ends("main leaves", 0, destroyed=True)

    def test_a_crash(self):
        self.ends("crash", 139, destroyed=False, first="waitpoint: one was terminated by signal 11 (Segmentation fault)\n")

    def test_a_deadlock_of_the_remaining_programs_names_them(self):
        run = execute(several([f"other={INSTANCE}", "other"], [f"one={INSTANCE}", "one", "deadlock"]))
        self.assertEqual(run.returncode, 124)
        self.assertIn("  one: main waits for mutex", run.stderr)


class Apart(unittest.TestCase):
    """What programs have for themselves."""

    def test_executables_at_a_fixed_address(self):
        run = execute(several([PROGRAMS / "fixed", 1, 2], [PROGRAMS / "executable"], [PROGRAMS / "fixed"]))
        self.assertEqual(sorted(run.stdout.splitlines()), ["counted 1", "counted 1", "counted 3"])
        self.assertEqual(run.returncode, 0)

    def test_scripts_and_programs_of_the_path(self):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "script"
            script.write_text("#!/bin/sh\ncd /\nexport HERE=$1\nsleep 1\necho $HERE $(pwd) at $(date +%S)\n")
            script.chmod(0o755)
            run = execute(several([script, "one"], [script, "two"], ["sh", "-c", "echo ${HERE-none}; pwd"]), folder=folder)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(sorted(run.stdout.splitlines()), sorted(["none", folder, "one / at 01", "two / at 01"]))

    def test_each_has_its_handlers_and_timers(self):
        ticks = [PROGRAMS / "ticks"]
        run = execute(several(ticks, ticks))
        self.assertEqual((run.returncode, run.stdout), (0, "100 ticks\n100 ticks\n"), run.stderr)


class Conditions(unittest.TestCase):
    """after:CONDITION."""

    def said(self, *words, status=0):
        run = execute([str(word) for word in words])
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stdout.splitlines()

    def test_an_end_and_a_start(self):
        self.assertEqual(self.said("after:b", "a=echo", "last", "::", "b=sh", "-c", "sleep 2; echo first"), ["first", "last"])
        late = self.said("after:b.started", "a=sh", "-c", "sleep 1; echo second; sleep 2; echo last", "::",
                         "b=sh", "-c", "echo first; sleep 2; echo third")
        self.assertEqual(late, ["first", "second", "third", "last"])

    def test_a_file_and_a_port(self):
        with tempfile.TemporaryDirectory() as folder:
            file = f"{folder}/file"
            self.assertEqual(self.said(f"after:{file}", "a=cat", file, "::", "sh", "-c", f"sleep 3; echo there > {file}"), ["there"])
        port = random.randrange(20000, 60000)
        server = ("import socket, time; time.sleep(2); s = socket.create_server(('127.0.0.1', %d)); print('heard', "
                  "s.accept()[0].recv(9).decode())") % port
        client = "import socket; socket.create_connection(('127.0.0.1', %d)).send(b'it')" % port
        self.assertEqual(self.said(f"after:tcp:{port}", "a=python3", "-c", client, "::", "b=python3", "-c", server), ["heard it"])

    def test_a_file_that_does_not_appear_is_reported(self):
        run = execute(["a=true", "::", "after:/nonexistent/x", "b=true"], "--idle-limit", "1")
        self.assertEqual(run.returncode, 124, run.stderr)
        self.assertEqual(run.stderr.splitlines()[0],
                         "waitpoint: b waits for its start, after:/nonexistent/x, and no program is running")

    def test_conditions_that_can_never_hold_are_refused(self):
        for words, line in ((["after:c", "a=true", "::", "b=true"], "after:c: there is no program 'c'"),
                            (["after:b", "a=true", "::", "after:a.started", "b=true"],
                             "'a' can never start: the conditions after: form a cycle"),
                            (["after:tcp:0", "true"], "expected after:NAME, after:NAME.started, after:tcp:PORT or after:PATH "
                                                      "with a '/', got 'after:tcp:0'")):
            run = execute(words)
            self.assertEqual((run.returncode, run.stderr), (125, f"waitpoint: exec: {line}\n"))


class BadInput(unittest.TestCase):
    """Bad input gives one line of error, and nothing is run."""

    def refused(self, words, line):
        run = execute(words)
        self.assertEqual(run.returncode, 125, run.stderr)
        self.assertRegex(run.stderr, f"^waitpoint: exec: {line}\n$")
        self.assertEqual(run.stdout, "")

    def test_no_such_file(self):
        self.refused(several(instance(1), ["./nowhere.so"]), r"there is no program '\./nowhere\.so'")

    def test_nothing_between_the_colons(self):
        for words in ([INSTANCE, "1", "::"], ["::", INSTANCE, "1"], [INSTANCE, "1", "::", "::", INSTANCE, "2"]):
            self.refused(words, r"expected a program on both sides of every '::', found none at place \d")

    def test_no_shared_object(self):
        self.refused(several(instance(1), [__file__]), r"'\S+several_test\.py' is not an executable file")

    def ends_at_once(self, file, line):
        run = execute(several(instance(1), [f"bad={file}"]))
        self.assertEqual(run.returncode, 125, run.stderr)
        self.assertRegex(run.stderr, f"waitpoint: exec: {line}\n")
        self.assertIn("bad 125, instance-program 0\n", run.stderr)

    def test_no_main(self):
        self.ends_at_once(PROGRAMS / "without-main.so", r"\S+/without-main\.so has no main\(\) that others see")

    def test_a_name_given_twice(self):
        self.refused(several([f"a={INSTANCE}", 1], [f"a={INSTANCE}", 1]), "two programs are called 'a'")

    def test_a_truncated_file(self):
        with tempfile.TemporaryDirectory() as folder:
            whole = pathlib.Path(INSTANCE).read_bytes()
            for size in (10, 64, 1000, 6000):
                cut = pathlib.Path(folder) / "cut.so"
                cut.write_bytes(whole[:size])
                run = execute(several(instance(1), [cut]))
                self.assertNotEqual(run.returncode, 0, f"{size}: {run.stderr}")
                self.assertRegex(run.stderr, r"cut\.so' is not an executable|cut was terminated|cut\.so")

    def test_a_missing_library(self):
        if shutil.which("cc") is None:
            self.skipTest("no compiler")
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "source.c"
            source.write_text("int call(void);\nint main(void) { return call(); }\n")
            program = pathlib.Path(folder) / "program.so"
            subprocess.run(["cc", "-shared", "-fPIC", "-o", program, source], check=True)
            self.ends_at_once(program, r"a program cannot be loaded: \S+/program\.so: undefined symbol: call")


if __name__ == "__main__":
    unittest.main(verbosity=1)
