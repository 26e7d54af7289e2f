# SPDX-License-Identifier: BSD-3-Clause
"""The simulated calls of `waitpoint exec` against POSIX, C11 and Linux: conformance_test.py BUILD.

Each case of the programs of tests/exec/conformance runs on system threads and, with three seeds, simulated; it must end in
the same way, and repeat its output with the same seed. The script imitates a GoogleTest program: each case counts as one.

  --gtest_filter=PATTERN   run some of the cases, named PROGRAM.CASE
  --gtest_output=xml:FILE  write a report
  --without-each           instead: for each function of the library, find a case that fails without it
"""

import argparse
import collections
import concurrent.futures
import contextlib
import fnmatch
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree

SEEDS = (1, 2, 3)
JOBS = 2
TIMEOUT_S = 10
# On a loaded machine, system threads may be later than the other threads of a case wait for them: factors by which the
# waits are extended, per attempt.
NATIVE_PATIENCE = (1, 1, 3, 9, 9)

# Cases whose exit status differs when simulated, with reasons.
DIFFERENCES = {}

# Functions of the library that no case calls, with reasons.
NOT_CALLED = {
    "__libc_start_main": "called by the start-up code of every program",
    "__sanitizer_cov_trace_pc": "called by code that is compiled so (exploring_test.py, CountedTime)",
    "__sanitizer_cov_trace_pc_guard": "as __sanitizer_cov_trace_pc, by clang++'s",
    "__sanitizer_cov_trace_pc_guard_init": "as __sanitizer_cov_trace_pc, by clang++'s",
} | dict.fromkeys(
    re.findall(r"^WAITPOINT_PASSED\((\w+)", (pathlib.Path(__file__).resolve().parents[2] / "fibers/posix/exec/passed_calls.cpp").read_text(), re.M),
    "passed through, with a footprint (completeness/pairs.py)",
) | dict.fromkeys(
    ("__cxa_guard_acquire", "__cxa_guard_release", "__cxa_guard_abort"), "called by compiled code (exploring_test.py)"
) | dict.fromkeys(
    "waitpoint_air waitpoint_begin_wait waitpoint_end_wait waitpoint_next_wait waitpoint_note_waits".split(),
    "called by waitpoint run among nodes of ROS (nodes_of_robots_test.py, explored_nodes_test.py)",
)

# Functions whose removal makes no case fail, with reasons.
NOT_MISSED = (
    dict.fromkeys(
        """cnd_destroy mtx_destroy pthread_cond_destroy pthread_mutex_destroy pthread_rwlock_destroy pthread_spin_destroy
        sem_destroy thrd_detach""".split(),
        "gives back memory of the layer's",
    )
    | dict.fromkeys(
        "cnd_init mtx_init pthread_mutex_init pthread_rwlock_init pthread_spin_init pthread_spin_trylock".split(),
        "the C library's leaves the same bytes; it is here so that this does not depend on them",
    )
    | dict.fromkeys(
        """dup dup2 dup3 epoll_create epoll_create1 epoll_ctl eventfd fcntl fcntl64 pidfd_getfd pipe pipe2 socketpair
        popen""".split(),
        "says that only this program has a descriptor: deadlocks are told by it (command_test.py, Deadlocks)",
    )
    | dict.fromkeys(
        """__close __connect __dup2 __fork __pipe __pthread_mutex_destroy __pthread_mutex_init __pthread_rwlock_destroy
        __pthread_rwlock_init __pthread_rwlock_trywrlock __pthread_rwlock_unlock __send __wait __waitpid
        __write""".split(),
        "as its first name, whose cases show it",
    )
    | dict.fromkeys(
        "aio_cancel aio_error aio_fsync aio_read aio_return aio_write lio_listio sendfile".split(),
        "the same function as with 64 behind it",
    )
    | dict.fromkeys(
        "aio_error64 aio_return64 lio_listio64 mq_notify".split(),
        "the C library's comes to the same, in real time",
    )
    | dict.fromkeys(
        "_Exit __cxa_atexit _exit exit".split(), "as the C library's, but among several programs (robots_programs_test.py)"
    )
    | {
        "__assert_fail": "as the C library's, but among several programs ends its own alone (robots_programs_test.py)",
        "__pthread_once": "only what was linked with an older C library can call it so",
        "clock_settime": "natively it would set the machine's date (command_test.py, Options)",
        "mmap": "counts the memory that becomes code (library_accesses_test.py)",
        "mmap64": "as mmap",
        "settimeofday": "natively it would set the machine's date",
        "socket": "says whose it is, among several programs (robots_programs_test.py)",
        "bind": "the same, but on a machine of its own (own_machine_test.py)",
        "getcpu": "any processor is as good",
        "listen": "natively who finds a full queue tries again after a second (command_test.py, Loopback)",
        "sched_getcpu": "any processor is as good",
        "vfork": "a child that does nothing but become a program does not show whose memory it has",
        "tss_delete": "as pthread_key_delete",
        "pthread_key_delete": "what the C library forgot has no value, and no destructor is called for it",
        "pthread_mutex_setprioceiling": "it waits for who holds the mutex, which natively takes a right to priorities",
    }
)


# Cases of these programs make names outside of their process, with its number, which is the same in every simulated run:
# one case of a program at a time.
OUTSIDE_NAMES = {
    name: threading.Lock()
    for name in ("cancellation_points", "connections", "message_queues", "named_pipes", "named_semaphore", "other_names",
                 "shared", "system_calls")
}

# Options of the simulation, by program.
OPTIONS = {"signal_floods": ["--children", "native"]}


def run(words):
    """(exit status, negative for a signal, None past the timeout; output; errors)"""
    process = subprocess.Popen(
        words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        output, errors = process.communicate(timeout=TIMEOUT_S)
        return process.returncode, output, errors
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, "", f"still ran after {TIMEOUT_S} s\n"


class Suite:
    """The programs and their cases."""

    def __init__(self, build):
        self.folder = build / "tests/exec/conformance"
        self.library = build / "libwaitpoint-exec.so"
        self.waitpoint = build / "tools/waitpoint"
        self.programs = sorted(
            path for path in self.folder.iterdir() if path.is_file() and not path.suffix and os.access(path, os.X_OK)
        )
        self.cases = []  # (program, case, expected status)
        for program in self.programs:
            _, listed, _ = run([program, "--list"])
            for line in listed.splitlines():
                status, case = line.split()
                self.cases.append((program, case, int(status)))

    def native(self, program, case, expected):
        """The differences, or the empty text."""
        for patience in NATIVE_PATIENCE:
            status, _, errors = run(["env", f"CONFORMANCE_PATIENCE={patience}", program, case])
            if status == expected:
                return ""
        return f"natively: status {status}, not {expected}\n{errors}"

    def simulated(self, program, case, expected, seed):
        words = [self.waitpoint, "exec", "--quiet", "--seed", str(seed)]
        words += [*OPTIONS.get(program.name, []), "--", program, case]
        status, output, errors = run(words)
        if status != expected:
            return f"seed {seed}: status {status}, not {expected}\n{errors}"
        if output and run(words)[1] != output:
            return f"seed {seed}: another output in a second run\n{output}"
        return ""

    def verdict(self, program, case, expected):
        wrong = self.native(program, case, expected)
        if wrong:
            return wrong
        name = f"{program.name}.{case}"
        with OUTSIDE_NAMES.get(program.name, contextlib.nullcontext()):
            wrong = "".join(self.simulated(program, case, expected, seed) for seed in SEEDS)
        if name not in DIFFERENCES:
            return wrong
        return "" if wrong else "ends as natively: no difference to be listed\n"

    def functions(self):
        """The functions that the library defines."""
        listed = subprocess.run(["nm", "-D", "--defined-only", self.library], capture_output=True, text=True, check=True)
        return sorted(line.split()[2].split("@")[0] for line in listed.stdout.splitlines())

    def called(self):
        """By function, the programs that call it: by linking, or by looking up its name."""
        found = {}
        for program in self.programs:
            listed = subprocess.run(["nm", "-D", "--undefined-only", program], capture_output=True, text=True, check=True)
            names = {line.split()[-1].split("@")[0] for line in listed.stdout.splitlines()}
            names |= {text.decode() for text in re.findall(rb"\0(_?_?[a-z][a-z0-9_]{4,40})(?=\0)", program.read_bytes())}
            for name in names:
                found.setdefault(name, []).append(program)
        return found

    def uncalled(self):
        called = self.called()
        missing = [name for name in self.functions() if name not in called and name not in NOT_CALLED]
        return "".join(f"no case calls {name}\n" for name in missing)


class Report:
    """Prints GoogleTest's lines, and writes its report."""

    def __init__(self):
        self.root = xml.etree.ElementTree.Element("testsuites")
        self.failed = self.passed = 0

    def add(self, group, case, wrong, skipped=False):
        node = xml.etree.ElementTree.SubElement(self.root, "testcase", classname=group, name=case)
        print(f"[ RUN      ] {group}.{case}\n{wrong}", end="")
        if skipped:
            node.set("status", "notrun")
            print(f"[  SKIPPED ] {group}.{case} (0 ms)")
        elif wrong:
            self.failed += 1
            xml.etree.ElementTree.SubElement(node, "failure", message=wrong)
            print(f"[  FAILED  ] {group}.{case} (0 ms)")
        else:
            self.passed += 1
            print(f"[       OK ] {group}.{case} (0 ms)")

    def end(self, output):
        print(f"{self.passed} passed, {self.failed} failed")
        if output:
            xml.etree.ElementTree.ElementTree(self.root).write(output)
        return 1 if self.failed else 0


def wanted(pattern, name):
    """GoogleTest's patterns: those before a minus, except those after it."""
    ours, _, not_ours = pattern.partition("-")
    return any(fnmatch.fnmatchcase(name, each) for each in (ours or "*").split(":")) and not any(
        fnmatch.fnmatchcase(name, each) for each in not_ours.split(":")
    )


def without(library, function, to):
    """Writes a copy of the library without one dynamic symbol: the C library's is found instead."""
    image = bytearray(library.read_bytes())
    (sections_at,), (size, count, _) = struct.unpack_from("<Q", image, 0x28), struct.unpack_from("<HHH", image, 0x3A)
    sections = [struct.unpack_from("<IIQQQQIIQQ", image, sections_at + i * size) for i in range(count)]
    symbols = next(section for section in sections if section[1] == 11)  # SHT_DYNSYM
    names_at = sections[symbols[6]][4]
    for at in range(symbols[4], symbols[4] + symbols[5], 24):
        name_at = names_at + struct.unpack_from("<I", image, at)[0]
        if image[name_at : image.index(0, name_at)].decode() == function:
            struct.pack_into("<HQ", image, at + 6, 0, 0)
    to.write_bytes(image)


def without_each(suite, pattern):
    """Prints, for each function of the library, a case that fails without it; returns 1 if one has none."""
    lacking = 0
    called = suite.called()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        (copy / "tools").mkdir()
        shutil.copy(suite.waitpoint, copy / "tools/waitpoint")
        suite.waitpoint = copy / "tools/waitpoint"
        for function in suite.functions():
            if not wanted(pattern, function) or function not in called:
                continue
            without(suite.library, function, copy / suite.library.name)
            fails = None
            for program, case, expected in suite.cases:
                if fails is None and program in called[function] and suite.simulated(program, case, expected, 1):
                    fails = f"{program.name}.{case}"
            print(f"{function:32} {fails or NOT_MISSED.get(function, 'nothing fails')}", flush=True)
            lacking += fails is None and function not in NOT_MISSED
    return 1 if lacking else 0


def one_of_each_program(cases):
    """The cases in another order: the first of each program, then the second, and so on."""
    before = collections.Counter()
    rounds = []
    for each in cases:
        rounds.append((before[each[0]], each))
        before[each[0]] += 1
    return [each for _, each in sorted(rounds, key=lambda one: one[0])]


def main():
    parser = argparse.ArgumentParser(prog="conformance_test.py")
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--gtest_filter", default="*")
    parser.add_argument("--gtest_output", default="")
    parser.add_argument("--without-each", action="store_true")
    arguments = parser.parse_args()
    build, output = arguments.build.resolve(), arguments.gtest_output.removeprefix("xml:")
    report = Report()
    if not (build / "libwaitpoint-exec.so").exists():
        report.add("conformance", "all", "the library for programs was not built (option exec)\n", skipped=True)
        return report.end(output)
    suite = Suite(build)
    if arguments.without_each:
        return without_each(suite, arguments.gtest_filter)
    begin = time.monotonic()
    cases = [each for each in suite.cases if wanted(arguments.gtest_filter, f"{each[0].name}.{each[1]}")]
    rounds = one_of_each_program(cases)
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        verdicts = dict(zip(rounds, pool.map(lambda each: suite.verdict(*each), rounds)))
    for program, case, expected in cases:
        report.add(program.name, case, verdicts[program, case, expected])
    if wanted(arguments.gtest_filter, "conformance.every_function_of_the_library_is_called_by_a_case"):
        report.add("conformance", "every_function_of_the_library_is_called_by_a_case", suite.uncalled())
    print(f"{len(cases)} cases natively and with seeds {SEEDS}, {len(DIFFERENCES)} differences: {time.monotonic() - begin:.1f} s")
    return report.end(output)


if __name__ == "__main__":
    sys.exit(main())
