# SPDX-License-Identifier: BSD-3-Clause
"""What docs/trust.md says of a stranger's scenario is what the system sees: trust_test.py BUILD [CLASS[.TEST]...].

strace is the oracle for runs of generated scenarios; a module of a program of its own tries what --confined forbids.
"""

import contextlib
import ctypes
import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import unittest

import generated_scenarios
from installed import BUILD, HERE, Installed, PROGRAM, SCENARIOS, flags, main

HAS_LANDLOCK = ctypes.CDLL(None).syscall(444, None, ctypes.c_size_t(0), 1) > 0
CALL = re.compile(r"^\d+ +(\w+)\((.*)\) = (-?\d+)", re.MULTILINE)
PARTS = {"tcl"} if (BUILD / "libwaitpoint-tcl.so").exists() else set()
# What the C library, the dynamic linker and the program read of the system and of themselves.
SYSTEM = ("/usr/", "/lib/", "/lib64/", "/etc/", "/proc/", "/sys/", "/dev/")


def traced(calls, *words, cwd=None, inject=()):
    """The command's end, and its system calls with their arguments and results."""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder, "trace")
        done = subprocess.run(["strace", "-f", "-qq", "-s", "4096", "-o", trace, "-e", f"trace={calls}", *inject, *map(str, words)], cwd=cwd,
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        return done, CALL.findall(trace.read_text(errors="replace"))


def named(arguments):
    return re.search(r'"([^"]*)"', arguments)[1]


class Case(Installed):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name).resolve() / "top"
        self.top.mkdir()


@unittest.skipUnless(shutil.which("strace"), "without strace")
class Runs(Case):
    """Of generated scenarios, without outputs."""

    def calls(self, seed, *options):
        scenario = generated_scenarios.write(self.top / str(seed), seed, PARTS)
        if "launch:" in scenario.read_text():
            return []  # nodes of ROS are programs
        done, calls = traced("%file,%network,mkdir,write,pwrite64", PROGRAM, "run", scenario, "--until", "0.02", *options, cwd="/")
        if "--confined" in options and "executive:" in scenario.read_text():
            self.assertEqual(done.returncode, 2, done.stderr)
        else:
            self.assertIn(done.returncode, (0, 1), done.stderr)
        return calls

    def test_write_and_execute_nothing_and_use_no_network(self):
        for seed in range(20):
            (self.top / str(seed)).mkdir()
            for name, arguments, result in self.calls(seed):
                with self.subTest(seed=seed, call=f"{name}({arguments})"):
                    if "AF_UNIX" in arguments and (name == "socket" or "nscd" in arguments):
                        continue  # the C library asks for the user's name
                    self.assertNotIn(name, ("rename", "renameat", "renameat2", "unlink", "unlinkat", "mkdir", "mkdirat", "symlink", "link",
                                            "truncate", "chmod", "mknod", "socket", "connect", "bind", "sendto", "sendmsg"))
                    if name in ("open", "openat") and re.search("O_WRONLY|O_RDWR|O_CREAT", arguments) and result != "-1":
                        self.assertTrue(named(arguments).startswith(("/dev/", "/proc/")))
                    if name == "execve" and result == "0":
                        self.assertEqual(os.path.realpath(named(arguments)), os.path.realpath(PROGRAM))

    def test_confined_open_files_of_their_folder_and_of_the_system(self):
        for seed in range(20):
            (self.top / str(seed)).mkdir()
            for name, arguments, result in self.calls(seed, "--confined"):
                if name in ("open", "openat") and result != "-1" and "O_PATH" not in arguments and "O_DIRECTORY" not in arguments:
                    file = os.path.realpath(named(arguments))
                    own = (str(self.top / str(seed)) + "/", str(pathlib.Path(os.path.realpath(PROGRAM)).parents[1]) + "/")
                    self.assertTrue(file.startswith((*SYSTEM, *own)), file)

    def test_without_landlock_say_that_the_system_enforces_nothing(self):
        words = [PROGRAM, "check", SCENARIOS / "office.yaml", "--confined"]
        done, _ = traced("landlock_create_ruleset", *words, inject=["-e", "inject=landlock_create_ruleset:error=ENOSYS"])
        self.assertEqual((done.returncode, done.stderr), (0, "waitpoint: --confined: the system does not enforce it, as it has no Landlock\n"))


class Messages(Case):
    """Of files that a scenario names for what they are not."""

    SHAPE = "shape: {radius_m: 0.2, height_m: 1}"
    KEYS = [f"world: {{{key}}}" for key in ("map: $", "include: $", "shapes: [{mesh: $.stl, at_m: [9, 9]}]", "shapes: [{mesh: $.obj, at_m: [9, 9]}]",
                                            "shapes: [{octomap: $}]")] + ["robot_types: {include: $}"]
    KEYS_OF_ROBOT = ["plan: $, " + SHAPE, "trajectory: $, " + SHAPE, "control: $, " + SHAPE, "launch: $, " + SHAPE, "urdf: $"]

    def messages(self, contents):
        for name in ("secret", "secret.stl", "secret.obj"):
            (self.top / name).write_text(contents)
        for key, robot in [(key, self.SHAPE) for key in self.KEYS] + [("until_s: 1", key) for key in self.KEYS_OF_ROBOT]:
            (self.top / "s.yaml").write_text(f"format: 1\n{key}\nrobots: [{{name: a, start: [0, 0, 0], {robot}}}]\n".replace("$", "secret"))
            done = subprocess.run([PROGRAM, "check", self.top / "s.yaml"], capture_output=True, text=True)
            yield key, done.stdout + done.stderr

    def test_errors_quote_at_most_80_characters(self):
        line = "".join(chr(97 + i % 26) for i in range(400))
        for contents in (line, "{" + line, line + ": " + line, "<" + line):
            for key, text in self.messages(f"{contents}\n{contents}\n"):
                quoted = [part for part in re.findall("[a-z]+", text) if len(part) > 20]
                self.assertLessEqual(max(map(len, quoted), default=0), 80, f"{key}: {text}")
                self.assertLessEqual(len(quoted), 2, f"{key}: {text}")

    def test_warnings_quote_at_most_100_words(self):
        words = "".join(f"{'ab' * 30}{number} x = 1\n" for number in range(500))
        for key, text in self.messages(words):
            lines = [line for line in text.splitlines() if "abab" in line]
            self.assertLessEqual(len(lines), 100, key)
            self.assertFalse([line for line in lines if line.startswith("warning: ") and "ab" * 21 in line], key)


@unittest.skipUnless(HAS_LANDLOCK, "the kernel has no Landlock")
class Modules(Case):
    """That try what a confined run may not do: they have all rights of the user, but for what the system takes away."""

    def setUp(self):
        super().setUp()
        self.program = self.compile("trespasser", *flags(self.prefix, "--cflags", "--libs", "waitpoint-robots"))
        (self.top / "own").mkdir()
        (self.top / "outputs").mkdir()
        shutil.copy(HERE / "trespasser/trespasser.yaml", self.top / "own")
        for name in ("own/unlisted", "secret"):
            (self.top / name).write_text("text")

    def tried(self, key, value, *options):
        """What the module says of its attempt."""
        done = subprocess.run([self.program, "run", self.top / "own/trespasser.yaml", "--set", f"robots.0.modules.trespasser.{key}={value}", *options],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return re.search(rf"(?m)^{key if key != 'port' else 'connect'}: (.*)$", done.stderr)[1]

    def try_file(self, key, name, *options):
        return self.tried(key, self.top / name, *options)

    def test_write_outside_of_the_folders_of_outputs_in_vain(self):
        output = ["--summary", self.top / "outputs/summary"]
        for name in ("new", "own/new", "secret", "own/trespasser.yaml"):
            self.assertEqual(self.try_file("write", name, "--confined", *output), "Permission denied", name)
            self.assertEqual(self.try_file("write", "outputs/new", "--confined", *output), "done")
            self.assertFalse((self.top / "new").exists())
            self.assertTrue((self.top / "outputs/summary").exists())
        self.assertEqual(self.try_file("write", "new"), "done")

    def test_read_files_that_are_not_listed_in_vain(self):
        for name in ("secret", "own/unlisted"):
            self.assertEqual(self.try_file("read", name, "--confined"), "Permission denied", name)
            self.assertEqual(self.try_file("read", name), "done")
        self.assertEqual(self.try_file("read", "own/trespasser.yaml", "--confined"), "done")

    def test_connect_in_vain(self):
        with contextlib.closing(socket.create_server(("127.0.0.1", 0))) as server:
            port = server.getsockname()[1]
            self.assertEqual(self.tried("port", port), "done")
            self.assertIn(self.tried("port", port, "--confined"), ("Permission denied", "done" if self.is_without_network() else ""))

    def is_without_network(self):
        return ctypes.CDLL(None).syscall(444, None, ctypes.c_size_t(0), 1) < 4

    def test_in_seeds_and_self_checks_write_in_vain(self):
        write = ["--set", f"robots.0.modules.trespasser.write={self.top / 'new'}"]
        (self.top / "temporary").mkdir()  # a self-check writes there
        for command, *options in (("run", "--seeds", "1..3"), ("run", "--seeds", "1..20", "--jobs", "2"), ("run", "--verify"),
                                  ("explore", "--iterations", "3", "--results", self.top / "outputs/results")):
            done = subprocess.run([self.program, command, self.top / "own/trespasser.yaml", "--confined", *write, *options],
                                  capture_output=True, text=True, timeout=120, env={**os.environ, "TMPDIR": str(self.top / "temporary")})
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertFalse((self.top / "new").exists(), options)
        self.assertTrue((self.top / "outputs/results").exists())
        self.assertEqual(self.try_file("write", "new"), "done")


if __name__ == "__main__":
    main()
