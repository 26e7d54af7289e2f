# SPDX-License-Identifier: BSD-3-Clause
"""Runs all tests of a Meson build folder, and counts the individual GoogleTest cases.

A program that crashes, exceeds its timeout, or holds no case counts as a failed case. The last line is
`N passed, M failed`, with `, K skipped` if any were; the exit status is 1 if any failed or nothing was run.
"""

import argparse
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Checks of the repository. Each is one case; a part without its tool is skipped. The word BUILD stands for the build
# folder.
BUILD = "BUILD"
OWN_CASE_TIMEOUT_S = 900
OWN_CASES = {
    "check assertions": [str(ROOT / "tools/dev/check.sh"), "assertions"],
    "check cycles": [str(ROOT / "tools/dev/check.sh"), "cycles"],
    "check dependencies": [str(ROOT / "tools/dev/check.sh"), "dependencies"],
    "check files": [str(ROOT / "tools/dev/check.sh"), "files"],
    "check formatting": [str(ROOT / "tools/dev/check.sh"), "formatting"],
    "check functions": [str(ROOT / "tools/dev/check.sh"), "functions"],
    "check names": [str(ROOT / "tools/dev/check.sh"), "names"],
    "check sensors": [str(ROOT / "tools/dev/check.sh"), "sensors"],
    "check test names": [str(ROOT / "tools/dev/check.sh"), "test_names"],
    "check words": [str(ROOT / "tools/dev/check.sh"), "words"],
    "dev": [sys.executable, str(ROOT / "tests/dev/dev_test.py")],
    "dev: runs": [sys.executable, str(ROOT / "tests/dev/runs_test.py")],
    "dev: names and words": [sys.executable, str(ROOT / "tests/dev/words_test.py")],
    "dev: flakes": [sys.executable, str(ROOT / "tests/dev/flakes_test.py")],
    "clang++ -O0 gives this build's run": [str(ROOT / "tools/dev/builds.sh"), "build", "clang++-O0"],
    "documents": [sys.executable, str(ROOT / "tests/docs/pages_test.py"), BUILD],
    "the kernel's plain path gives this build's run": [str(ROOT / "tools/dev/builds.sh"), "build", "build-plain-path"],
    "view": [sys.executable, str(ROOT / "tests/programs/view_test.py"), BUILD],
    "view, lines of time": [sys.executable, str(ROOT / "tests/programs/view_lines_test.py"), BUILD],
    "view, in a browser": [sys.executable, str(ROOT / "tests/view/browser_test.py"), BUILD],
    "exec": [sys.executable, str(ROOT / "tests/exec/debian_test.py"), BUILD],
    "exec, the command": [sys.executable, str(ROOT / "tests/exec/command_test.py"), BUILD],
    "explore, programs: causes": [sys.executable, str(ROOT / "tests/exec/causes_test.py"), BUILD],
    "exec, misuse": [sys.executable, str(ROOT / "tests/exec/misuse_test.py"), BUILD],
    "exec, endless runs": [sys.executable, str(ROOT / "tests/exec/endless_test.py"), BUILD],
    "exec, partners": [sys.executable, str(ROOT / "tests/exec/partners_test.py"), BUILD],
    "exec, families": [sys.executable, str(ROOT / "tests/exec/families_test.py"), BUILD],
    "exec, streams": [sys.executable, str(ROOT / "tests/exec/streams_test.py"), BUILD],
    "exec, shells": [sys.executable, str(ROOT / "tests/exec/shells_test.py"), BUILD],
    "exec, libc and children": [sys.executable, str(ROOT / "tests/exec/libc_and_children_test.py"), BUILD],
    "exec, ROS": [sys.executable, str(ROOT / "tests/exec/ros_test.py"), BUILD],
    "exec, machines of their own": [sys.executable, str(ROOT / "tests/exec/own_machine_test.py"), BUILD],
    "transports of ROS 2": [sys.executable, str(ROOT / "tests/programs/dds_test.py"), BUILD],
    "nodes of ROS": [sys.executable, str(ROOT / "tests/programs/nodes_test.py"), BUILD],
    "bags of ROS": [sys.executable, str(ROOT / "tests/programs/bags_test.py"), BUILD],
    "nodes of robots": [sys.executable, str(ROOT / "tests/programs/nodes_of_robots_test.py"), BUILD],
    "nodes and modules": [sys.executable, str(ROOT / "tests/programs/nodes_and_modules_test.py"), BUILD],
    "nodes of ROS, explored": [sys.executable, str(ROOT / "tests/programs/explored_nodes_test.py"), BUILD],
    "nodes of ROS, navigation": [sys.executable, str(ROOT / "tests/programs/move_base_test.py"), BUILD],
    "exec, repeatability": [sys.executable, str(ROOT / "tests/exec/repeatability_test.py"), BUILD],
    "explore, programs": [sys.executable, str(ROOT / "tests/exec/exploring_test.py"), BUILD],
    "explore, programs: findings": [sys.executable, str(ROOT / "tests/exec/finding_test.py"), BUILD],
    "explore, programs: ends": [sys.executable, str(ROOT / "tests/exec/ends_test.py"), BUILD],
    "explore, programs: accesses": [sys.executable, str(ROOT / "tests/exec/accesses_test.py"), BUILD],
    "explore, programs: processes": [sys.executable, str(ROOT / "tests/exec/exploring_processes_test.py"), BUILD],
    "explore, programs: data races": [sys.executable, str(ROOT / "tests/exec/races_test.py"), BUILD],
    "explore, programs: weak memory": [sys.executable, str(ROOT / "tests/exec/weak_memory_test.py"), BUILD],
    "exec: planted bugs": [sys.executable, str(ROOT / "tests/exec/zoo_test.py"), BUILD],
    "faults": [sys.executable, str(ROOT / "tests/faults/faults_test.py"), BUILD],
    "gdb": [sys.executable, str(ROOT / "tests/programs/gdb_test.py"), BUILD],
    "deaths": [sys.executable, str(ROOT / "tests/programs/deaths_test.py"), BUILD],
    "surroundings": [sys.executable, str(ROOT / "tests/programs/surroundings_test.py"), BUILD],
    "ends of runs": [sys.executable, str(ROOT / "tests/programs/ends_of_runs_test.py"), BUILD],
    "generated modules": [sys.executable, str(ROOT / "tests/programs/genom_test.py"), BUILD],
    "external robots": [sys.executable, str(ROOT / "tests/programs/external_test.py"), BUILD],
    "served world": [sys.executable, str(ROOT / "tests/programs/served_world_test.py"), BUILD],
    "mistakes": [sys.executable, str(ROOT / "tests/programs/mistakes_test.py"), BUILD],
    "recordings": [sys.executable, str(ROOT / "tests/programs/recordings_test.py"), BUILD],
    "programs": [sys.executable, str(ROOT / "tests/programs/programs_test.py"), BUILD],
    "projects": [sys.executable, str(ROOT / "tests/programs/consumers_test.py"), BUILD],
    "templates for continuous integration": [sys.executable, str(ROOT / "tests/programs/ci_test.py"), BUILD],
    "frameworks": [sys.executable, str(ROOT / "tests/programs/frameworks_test.py"), BUILD],
    "ranks": [sys.executable, str(ROOT / "tests/programs/ranks_test.py"), BUILD],
    "files of scenarios": [sys.executable, str(ROOT / "tests/programs/named_files_test.py"), BUILD],
    "strangers' scenarios": [sys.executable, str(ROOT / "tests/programs/trust_test.py"), BUILD],
    "command line": [sys.executable, str(ROOT / "tests/programs/command_line_test.py"), BUILD],
    "pocolibs in C": [sys.executable, str(ROOT / "tests/programs/laas_test.py"), BUILD],
    "links of documents": [sys.executable, str(ROOT / "tests/docs/links_test.py")],
    "site of documents": [sys.executable, str(ROOT / "tests/docs/site_test.py")],
    "documents of JSON": [sys.executable, str(ROOT / "tests/programs/json_test.py"), BUILD],
    "schemas": [sys.executable, str(ROOT / "tests/schema/schema_test.py"), BUILD],
    "dev: parts": [sys.executable, str(ROOT / "tests/dev/parts_test.py")],
    "recipes of packages": [sys.executable, str(ROOT / "tests/packages/recipes_test.py")],
}


@dataclasses.dataclass
class Result:
    """Results of one program's run: case names, and its output if relevant."""

    passed: int = 0
    failed: list = dataclasses.field(default_factory=list)
    skipped: list = dataclasses.field(default_factory=list)
    output: str = ""


# Process groups to kill on an interrupt: the terminal's does not reach them.
running_groups = set()


def end_group(group):
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass


def heed_signals():
    """In the new process: nohup, and a shell for its background jobs, leave some ignored."""
    for each in signal.SIGINT, signal.SIGQUIT, signal.SIGHUP:
        signal.signal(each, signal.SIG_DFL)


def run(command, timeout_s, environment=None, folder=None):
    """Runs a command in a process group of its own; returns (exit status, None past the timeout; output)."""
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=environment,
            cwd=folder,
            start_new_session=True,
            preexec_fn=heed_signals,
        )
    except OSError as error:  # a program that was not built
        return 127, f"{error}\n"
    running_groups.add(process.pid)
    try:
        output, _ = process.communicate(timeout=timeout_s)
        status = process.returncode
    except subprocess.TimeoutExpired:
        end_group(process.pid)
        output, _ = process.communicate()
        status = None
    running_groups.discard(process.pid)
    return status, output.decode(errors="replace")


def explain(status, timeout_s):
    if status is None:
        return f"exceeded {timeout_s} s"
    if status < 0:
        return f"was terminated by {signal.Signals(-status).name}"
    return f"ended with status {status}"


def read_cases(report, result):
    """Adds the cases of GoogleTest's XML report to the result."""
    for case in xml.etree.ElementTree.parse(report).iter("testcase"):
        name = f"{case.get('classname')}.{case.get('name')}"
        if case.find("failure") is not None:
            result.failed.append(name)
        elif case.get("status") == "notrun" or case.find("skipped") is not None:
            result.skipped.append(name)
        else:
            result.passed += 1


def run_googletest(command, report, timeout_s, environment=None, folder=None, filtered=False):
    """Runs a GoogleTest program; only a complete run writes the report."""
    report.unlink(missing_ok=True)
    status, output = run(command + [f"--gtest_output=xml:{report}"], timeout_s, environment, folder)
    result = Result(output=output)
    if report.exists():
        read_cases(report, result)
        if status != 0 and not result.failed:
            result.failed.append(f"the program: {explain(status, timeout_s)} after its cases")
    else:
        started = re.findall(r"^\[ RUN      \] (.*)$", output, re.MULTILINE)
        result.passed = len(re.findall(r"^\[       OK \] ", output, re.MULTILINE))
        result.failed = re.findall(r"^\[  FAILED  \] (\S+) \(\d+ ms\)$", output, re.MULTILINE)
        result.failed.append(f"{started[-1] if started else 'the program'}: {explain(status, timeout_s)}")
    if not filtered and not (result.passed or result.failed or result.skipped):
        result.failed.append("the program: holds no case")
    return result


def run_one_case(command, timeout_s, environment=None, folder=None):
    """Runs a program that is one case: 0 passed, 77 skipped, anything else failed."""
    status, output = run(command, timeout_s, environment, folder)
    if status == 0:
        return Result(passed=1, output=output)
    if status == 77:
        return Result(skipped=["not possible here"], output=output)
    return Result(failed=[explain(status, timeout_s)], output=output)


def excerpt(output, failed):
    """The failed cases' part of a GoogleTest program's output; all of it if they cannot be separated."""
    said = re.findall(r"^\[ RUN      \] (\S+)\n(.*?)(?=^\[ (?:RUN|      OK|  SKIPPED) |\Z)", output, re.MULTILINE | re.DOTALL)
    parts = [f"{name}\n{text}" for name, text in said if any(case.split(":")[0] == name for case in failed)]
    return "".join(parts) or output


def report_end(name, result, wall_s, total):
    """Prints a program's line as it ends, and its output if something failed; adds it to the total."""
    verdict = "FAILED" if result.failed else "ok"
    skipped = f", {len(result.skipped)} skipped" if result.skipped else ""
    print(f"{verdict:6}  {name}: {result.passed} passed, {len(result.failed)} failed{skipped}  ({wall_s:.1f} s)")
    if result.failed:
        print("".join(f"    | {line}\n" for line in excerpt(result.output, result.failed).splitlines()), end="")
        for case in result.failed:
            print(f"    failed: {case}")
    sys.stdout.flush()
    total.passed += result.passed
    total.failed += [f"{name}: {case}" for case in result.failed]
    total.skipped += [f"{name}: {case}" for case in result.skipped]


def jobs_of(build, arguments):
    """The tests as (name, runs alone, function), by Meson's priority; with `programs`, only these."""
    description = subprocess.run(["meson", "introspect", "--tests", str(build)], check=True, capture_output=True).stdout
    reports = build / "test-reports"
    reports.mkdir(exist_ok=True)
    options = list(arguments.options)
    if arguments.filter:
        plain = not re.search(r"[*?:-]", arguments.filter)
        options.append(f"--gtest_filter={'*' + arguments.filter + '*' if plain else arguments.filter}")
    for test in sorted(json.loads(description), key=lambda test: -test["priority"]):
        environment = {**os.environ, **test["env"]}
        if arguments.program:
            environment["WAITPOINT_PROGRAM"] = str(arguments.program.resolve())
        if arguments.under:
            environment["WAITPOINT_UNDER"] = shlex.join(arguments.under)
        if arguments.programs and test["name"] not in arguments.programs:
            continue
        timeout_s = test["timeout"] * arguments.patience or None
        common = (timeout_s, environment, test["workdir"])
        command = arguments.under + test["cmd"]
        if test["protocol"] == "gtest":
            report = reports / (re.sub(r"\W+", "-", test["name"]) + ".xml")
            job = lambda c=command + options, r=report, a=common: run_googletest(c, r, *a, bool(arguments.filter))
        elif arguments.filter:
            continue
        else:
            job = lambda c=command, a=common: run_one_case(c, *a)
        yield test["name"], not test["is_parallel"], job
    if not arguments.filter and not arguments.programs:
        for name, command in OWN_CASES.items():
            words = [str(build) if word == BUILD else word for word in command]
            yield name, False, lambda c=words: run_one_case(c, OWN_CASE_TIMEOUT_S)


def timed(job):
    start = time.monotonic()
    return job(), time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(prog="dev test", description="Unknown options go to each GoogleTest program.")
    parser.add_argument("build", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--filter", metavar="PATTERN", help="run cases that contain a word, or match a GoogleTest pattern")
    parser.add_argument("--jobs", type=int, default=2, help="number of programs to run at once (default: 2)")
    parser.add_argument("--programs", type=lambda names: names.split(","), help=argparse.SUPPRESS)
    parser.add_argument("--under", type=shlex.split, default=[], help=argparse.SUPPRESS)
    parser.add_argument("--program", type=pathlib.Path, help=argparse.SUPPRESS)  # in place of the built one
    parser.add_argument("--patience", type=int, default=1, help=argparse.SUPPRESS)
    arguments, arguments.options = parser.parse_known_args()

    total = Result()
    jobs = list(jobs_of(arguments.build.resolve(), arguments))
    with concurrent.futures.ThreadPoolExecutor(max(1, arguments.jobs)) as pool:
        running = {pool.submit(timed, job): name for name, alone, job in jobs if not alone}
        try:
            for future in concurrent.futures.as_completed(running):
                report_end(running[future], *future.result(), total)
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            for group in list(running_groups):
                end_group(group)
            raise
    for name, alone, job in jobs:
        if alone:
            report_end(name, *timed(job), total)

    for case in total.skipped:
        print(f"skipped: {case}")
    for case in total.failed:
        print(f"failed: {case}")
    if not total.passed and not total.failed:
        total.failed.append("no case was run")
        print("failed: no case was run")
    skipped = f", {len(total.skipped)} skipped" if total.skipped else ""
    print(f"{total.passed} passed, {len(total.failed)} failed{skipped}")
    return 1 if total.failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
