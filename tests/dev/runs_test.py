# SPDX-License-Identifier: BSD-3-Clause
"""The counter of tests, on programs that pass, fail, crash and hang; long runs; archives of subprojects."""

import hashlib
import subprocess
import sys
import unittest

from temporary_folder import InATemporaryFolder, ROOT

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/dev"))
import endurance  # noqa: E402
import run_tests  # noqa: E402
import wraps  # noqa: E402


class Wraps(InATemporaryFolder):
    TEXT = "# why\n[wrap-file]\ndirectory = a-1\nsource_filename = a-1.tar.gz\nsource_hash = {}\npatch_directory = a\n"

    def archive(self, name, directory):
        self.write(f"{directory}/a.c", "int a;\n")
        subprocess.run(["tar", "-caf", name, directory], cwd=self.folder, check=True)
        return self.folder / name

    def test_upstreams_own_archive_is_taken_as_it_is(self):
        archive = self.archive("a_1.orig.tar.gz", "a-1")
        text = self.TEXT.format(hashlib.sha256(archive.read_bytes()).hexdigest())
        self.assertEqual(wraps.fit(text, archive), text)

    def test_an_archive_packed_anew_is_named_in_the_wrap(self):
        archive = self.archive("a_1+ds.orig.tar.xz", "a-1.ds")
        lines = wraps.fit(self.TEXT.format("0" * 64), archive).splitlines()
        self.assertEqual(lines[2:4], ["directory = a-1.ds", "source_filename = a_1+ds.orig.tar.xz"])
        self.assertEqual(lines[4], f"source_hash = {hashlib.sha256(archive.read_bytes()).hexdigest()}")
        self.assertEqual((lines[0], lines[5]), ("# why", "patch_directory = a"))

    def test_every_wrap_has_its_source_package_and_its_archive_is_found(self):
        names = {path.stem for path in (ROOT / "subprojects").glob("*.wrap")}
        self.assertEqual(set(wraps.SOURCE_PACKAGES), names)
        for name in ["a_1.dsc", "a_1.orig.tar.gz.asc", "a_1.debian.tar.xz", "a2_1.orig.tar.gz"]:
            self.write(name, "")
        self.assertIsNone(wraps.find_archive(self.folder, "a"))
        self.write("a_1.orig.tar.bz2", "")
        self.assertEqual(wraps.find_archive(self.folder, "a").name, "a_1.orig.tar.bz2")

    def test_a_copy_follows_the_tree_and_keeps_its_build_folders(self):
        tree, copy = self.folder / "tree", self.folder / "copy"
        for path in ["core/a.cpp", "subprojects/packagefiles/a/meson.build", "subprojects/a.wrap", "build/b.o", ".git/c"]:
            self.write(f"tree/{path}", path)
        wraps.copy_tree(tree, copy)
        copied = {"core/a.cpp", "subprojects/packagefiles/a/meson.build"}
        self.assertEqual({str(path.relative_to(copy)) for path in copy.rglob("*") if path.is_file()}, copied)
        time_before = (copy / "core/a.cpp").stat().st_mtime_ns
        self.write("copy/subprojects/a-1/unpacked.c", "")
        self.write("tree/core/b.cpp", "new")
        (tree / "subprojects/packagefiles/a/meson.build").unlink()
        wraps.copy_tree(tree, copy)
        self.assertEqual((copy / "core/a.cpp").stat().st_mtime_ns, time_before)
        self.assertEqual({str(path.relative_to(copy)) for path in copy.rglob("*") if path.is_file()},
                         {"core/a.cpp", "core/b.cpp", "subprojects/a-1/unpacked.c"})


class Counting(InATemporaryFolder):
    def run_program(self, script, timeout_s=20):
        program = self.write("program.sh", f"#!/bin/bash\nreport=${{1#--gtest_output=xml:}}\n{script}\n")
        program.chmod(0o755)
        return run_tests.run_googletest([str(program)], self.folder / "report.xml", timeout_s)

    def xml(self, cases):
        return f"echo '<testsuites><testsuite>{cases}</testsuite></testsuites>' > $report"

    PASSED = '<testcase name="A" classname="S" status="run" result="completed"/>'
    FAILED = '<testcase name="B" classname="S" status="run"><failure message="x"/></testcase>'
    SKIPPED = '<testcase name="C" classname="S" status="run" result="skipped"><skipped message="x"/></testcase>'
    DISABLED = '<testcase name="D" classname="S" status="notrun" result="suppressed"/>'

    def test_cases_are_counted_singly(self):
        result = self.run_program(self.xml(self.PASSED * 3 + self.FAILED + self.SKIPPED + self.DISABLED) + "; exit 1")
        self.assertEqual((result.passed, result.failed, result.skipped), (3, ["S.B"], ["S.C", "S.D"]))

    def test_a_crash_fails_the_case_that_ran(self):
        result = self.run_program("echo '[ RUN      ] S.A'; echo '[       OK ] S.A (0 ms)'; echo '[ RUN      ] S.B'; kill -SEGV $$")
        self.assertEqual((result.passed, result.failed), (1, ["S.B: was terminated by SIGSEGV"]))

    def test_shows_the_output_of_failed_cases_alone(self):
        output = ("before\n[ RUN      ] S.A\nfine\n[       OK ] S.A (0 ms)\n[ RUN      ] S.B\nbad\n[  FAILED  ] S.B (1 ms)\n"
                  "[ RUN      ] S.C\nworse\n")
        self.assertEqual(run_tests.excerpt(output, ["S.B"]), "S.B\nbad\n[  FAILED  ] S.B (1 ms)\n")
        self.assertEqual(run_tests.excerpt(output, ["S.C: was terminated by SIGSEGV"]), "S.C\nworse\n")
        self.assertEqual(run_tests.excerpt(output, ["the program: holds no case"]), output)

    def test_a_crash_after_the_last_case_fails(self):
        result = self.run_program(self.xml(self.PASSED) + "; kill -ABRT $$")
        self.assertEqual((result.passed, result.failed), (1, ["the program: was terminated by SIGABRT after its cases"]))

    def test_the_report_of_an_earlier_run_does_not_count(self):
        self.run_program(self.xml(self.PASSED))
        self.assertEqual(self.run_program("exit 0").passed, 0)

    def test_a_program_that_hangs_is_ended_with_its_children(self):
        result = self.run_program("sleep 100 & sleep 100", timeout_s=0.3)
        self.assertEqual(result.failed, ["the program: exceeded 0.3 s"])

    def test_a_program_without_cases_fails(self):
        self.assertEqual(self.run_program(self.xml("")).failed, ["the program: holds no case"])


class Endurance(unittest.TestCase):
    """The verdict on two runs of a day, from their summaries and memory."""

    UNTIL_S = 86400

    def runs(self):
        goal = {"visits": 900, "times_reached": 900, "report": "reached", "time_s": 86390.0}
        runs = []
        for engine in endurance.ENGINES:
            robots = [{"name": name, "goal_reports": [dict(goal), dict(goal)]} for name in ("s1", "n1")]
            summary = {"robots": robots, "collisions": 0, "digest": "wp1:1"}
            memory = {time_s: 70 + min(time_s, 1800) / 1000 for time_s in range(60, self.UNTIL_S + 1, 60)}
            runs.append(endurance.Run(engine, memory, summary, 0))
        return runs

    def violations(self, change):
        runs = self.runs()
        change(runs[1])
        return list(endurance.violations(runs, self.UNTIL_S))

    def test_good_runs_pass(self):
        self.assertEqual(list(endurance.violations(self.runs(), self.UNTIL_S)), [])

    def test_each_fault_is_reported(self):
        def lose(run):
            goal = run.summary["robots"][1]["goal_reports"][0]
            goal.update(times_reached=899, report="the way stays blocked", time_s=5000)

        def rest(run):
            for goal in run.summary["robots"][0]["goal_reports"]:
                goal["time_s"] = 80000

        def grow(run):
            run.memory_mb[self.UNTIL_S] += 5

        for change, line in [
            (lose, "slice: n1 lost goal 1 1 of 900 times, last at 5000 s: the way stays blocked"),
            (rest, "slice: s1 reached no goal after 80000 s"),
            (grow, "slice: memory grew by 5.0 MB, expected at most 4 MB"),
            (lambda run: run.summary.update(collisions=2), "slice: 2 collisions"),
            (lambda run: run.summary.update(digest="wp1:2"), "the digests differ: wp1:1, wp1:2"),
            (lambda run: setattr(run, "status", 1), "slice: exit status 1: "),
            (lambda run: setattr(run, "summary", None), "slice: no result, exit status 0: "),
        ]:
            with self.subTest(line=line):
                self.assertEqual(self.violations(change), [line])

    def test_growth_within_the_first_hour_is_no_fault(self):
        def fill(run):
            run.memory_mb.update({time_s: 50 for time_s in range(60, 3600, 60)})

        self.assertEqual(self.violations(fill), [])


if __name__ == "__main__":
    unittest.main()
