# SPDX-License-Identifier: BSD-3-Clause
"""The development tools find violations: each check on a small tree that breaks its rule, the test counter on programs that
pass, fail, crash and hang."""

import ast
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/dev"))
import endurance  # noqa: E402
import run_tests  # noqa: E402
import wraps  # noqa: E402

LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n"


class InATemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def check(self, part, *arguments):
        """Runs one checker on the folder; returns (status, output)."""
        command = [sys.executable, str(ROOT / f"tools/dev/check/{part}.py"), *(arguments or [str(self.folder)])]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout


class Help(unittest.TestCase):
    WORDS = ("run", "add", "test", "bench", "check", "format", "docs", "package", "ros", "ros2", "hook")

    def help_of(self, *words):
        done = subprocess.run([ROOT / "dev", *words], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_prints_the_rows_of_its_word(self):
        for word in self.WORDS:
            rows = [line for line in self.help_of(word, "--help").splitlines() if not line.startswith(" ")]
            self.assertGreater(len(rows), 0, word)
            self.assertEqual({row.split()[1] for row in rows}, {word})

    def test_runs_no_long_test(self):
        self.assertEqual(self.help_of("test", "--packages", "--help"), self.help_of("test", "--help"))

    def test_has_all_words(self):
        words = [line.split()[1] for line in self.help_of("help").splitlines() if line.startswith("./dev")]
        self.assertEqual(set(words), {*self.WORDS, "help"})


class Dependencies(InATemporaryFolder):
    def includes(self, source, *headers):
        self.write(source, LICENCE + "".join(f"#include {header}\n" for header in headers))

    def test_allowed_by_the_table_passes(self):
        self.includes("core/time.hpp", "<cstdint>")
        self.includes("fibers/switch/fiber.cpp", '"core/time.hpp"', "<boost/context/detail/fcontext.hpp>")
        self.includes("world/fcl/engine.cpp", '"core/time.hpp"', "<fcl/narrowphase/collision.h>")
        self.includes("tests/core/time_test.cpp", '"core/time.hpp"', "<gtest/gtest.h>")
        status, output = self.check("dependencies")
        self.assertEqual(status, 0, output)
        self.assertIn("4 files in 4 folders, 0 violations", output)

    def test_each_forbidden_include_is_told_with_its_line(self):
        self.includes("core/time.hpp")
        self.includes("world/arc.hpp")
        self.includes("modules/genom/module.hpp")
        self.includes("modules/sick/sick.hpp")
        for source, header, allowed in [
            ("core/a.cpp", '"world/arc.hpp"', False),
            ("core/b.cpp", "<Eigen/Dense>", False),
            ("fibers/sync/a.cpp", "<boost/context/detail/fcontext.hpp>", False),
            ("world/b.cpp", "<fcl/fcl.h>", False),
            ("world/c.cpp", '"modules/genom/module.hpp"', False),
            ("modules/ndd/a.cpp", '"modules/sick/sick.hpp"', False),
            ("modules/ndd/b.cpp", '"world/arc.hpp"', False),
            ("modules/ndd/c.cpp", '"modules/genom/module.hpp"', True),
            ("modules/bridge/a.cpp", '"world/arc.hpp"', True),
            ("tests/modules/ndd/a.cpp", '"world/arc.hpp"', False),
            ("world/d.cpp", '"arc.hpp"', False),
            ("world/e.cpp", "<core/time.hpp>", False),
            ("widgets/a.cpp", '"core/time.hpp"', False),
        ]:
            with self.subTest(source=source, header=header):
                self.includes(source, "<cstdint>", header)
                status, output = self.check("dependencies")
                (self.folder / source).unlink()
                self.assertEqual(status, 0 if allowed else 1, output)
                self.assertEqual(f"\n{source}:" in output, not allowed, output)


class Cycles(InATemporaryFolder):
    def setUp(self):
        super().setUp()
        self.write("a/one.hpp", '#include "a/two.hpp"\n')
        self.write("a/two.hpp", "#pragma once\n")
        self.write("b/three.cpp", '#include "a/one.hpp"\n')
        self.table = self.write("table", "# none\n")

    def cycles(self):
        return self.check("cycles", str(self.folder), str(self.table))

    def test_a_tree_without_any_passes(self):
        self.assertEqual(self.cycles(), (0, "3 units, 0 cycles, 0 violations\n"))

    def test_a_source_counts_with_its_header(self):
        self.write("a/two.cpp", '#include "a/one.hpp"\n')
        status, output = self.cycles()
        self.assertEqual(status, 1)
        self.assertIn("2 include each other: a/one a/two\n    a/one.hpp includes a/two\n    a/two.cpp includes a/one\n", output)

    def test_folders_do_not_include_each_other(self):
        self.write("b/four.hpp", "#pragma once\n")
        self.write("a/five.cpp", '#include "b/four.hpp"\n')
        status, output = self.cycles()
        self.assertEqual(status, 1)
        self.assertIn("2 include each other: a b\n", output)

    def test_a_tolerated_one_passes_until_it_is_gone(self):
        source = self.write("a/two.cpp", '#include "a/one.hpp"\n')
        self.table.write_text("a/one a/two\n")
        self.assertEqual(self.cycles()[0], 0)
        source.unlink()
        status, output = self.cycles()
        self.assertEqual(status, 1)
        self.assertIn("a cycle that no longer exists: a/one a/two", output)


class Functions(InATemporaryFolder):
    def body_of(self, lines, head="int f(int a,\n      int b) {"):
        self.write("core/a.cpp", f"namespace n {{\n\n{head}\n" + "  // brace }\n" * lines + "}\n\n}\n")
        return self.check("functions")

    def test_a_long_one_is_named_with_its_line(self):
        self.assertEqual(self.body_of(70)[0], 0)
        self.assertEqual(self.body_of(71), (1, "1 functions, 1 violations\ncore/a.cpp:3: a function of 71 lines; at most 70\n"))

    def test_an_initialiser_list_belongs_to_the_head(self):
        self.assertEqual(self.body_of(71, "A::A()\n    : b_(1),\n      c_('{') {")[0], 1)

    def test_namespaces_and_classes_may_be_long(self):
        self.assertEqual(self.body_of(71, "struct A : B<int (*)()> {")[0], 0)


class Assertions(InATemporaryFolder):
    def check_with(self, *lines):
        table = self.folder / "table"
        table.write_text("".join(f"{line}\n" for line in lines))
        return self.check("assertions", str(self.folder), str(table))

    def test_are_counted_for_each_1000_lines(self):
        self.write("core/a.cpp", "WAITPOINT_CHECK(a, b);\n// static_assert(c);\n" + "\n" * 98)
        self.assertEqual(self.check_with("core 10  # one in a hundred"), (0, "core: 1 assertions in 100 lines, 10.0 per 1 000\n"))
        status, output = self.check_with("core 11")
        self.assertEqual(status, 1)
        self.assertIn("core: 10.0 assertions per 1 000 lines; at least 11\n", output)

    def test_a_folder_without_sources_is_a_violation(self):
        self.assertEqual(self.check_with("nowhere 0"), (1, "nowhere: a folder without sources\n"))

    def test_a_bad_line_is_named(self):
        for line in ("core ten", "core"):
            self.assertEqual(self.check_with("# folders", line), (1, f"table:2: expected FOLDER NUMBER, found '{line}'\n"))


class Files(InATemporaryFolder):
    def test_a_clean_tree_passes(self):
        self.write("core/time.hpp", LICENCE)
        self.write("build/junk.cpp", "")
        self.assertEqual(self.check("files")[0], 0)

    def test_each_broken_rule_is_told(self):
        for text in ["int a;\n", LICENCE + "// TO" "DO more\n", LICENCE + '"/ho' 'me/someone/x"\n']:
            with self.subTest(text=text):
                self.write("core/time.hpp", text)
                status, output = self.check("files")
                self.assertEqual(status, 1, output)
                self.assertIn("core/time.hpp:", output)

    def test_a_long_file_is_a_warning(self):
        self.write("core/time.hpp", LICENCE + "\n" * 400)
        status, output = self.check("files")
        self.assertEqual(status, 0)
        self.assertIn("warning: core/time.hpp: 401 lines", output)


class Symbols(InATemporaryFolder):
    def symbols_of(self, code):
        source = self.write("kernel.cpp", code)
        built = self.folder / "kernel.o"
        subprocess.run(["g++", "-std=c++20", "-O1", "-fPIC", "-c", source, "-o", built], check=True)
        return self.check("symbols", str(built))

    def test_plain_code_passes(self):
        status, output = self.symbols_of("extern int other(); int twice() { return 2 * other(); }")
        self.assertEqual(status, 0, output)

    def test_each_forbidden_thing_is_told(self):
        for code, what in [
            ("void f() { throw 1; }", "throws"),
            ("int* f() { return new int[3]; }", "allocates"),
            ("#include <cstdlib>\nvoid* f() { return std::malloc(3); }", "allocates"),
            ("#include <string>\nvoid f(std::string& s) { s += s; }", "uses a standard container"),
            ("thread_local int x; int f() { return ++x; }", "calls for thread-local storage"),
            ("int g(); int f() { static int x = g(); return x; }", "guards a local static"),
        ]:
            with self.subTest(what=what):
                status, output = self.symbols_of(code)
                self.assertEqual(status, 1, output)
                self.assertIn(f": {what}: ", output)


class Contract(unittest.TestCase):
    def test_each_test_that_it_names_is_there(self):
        """docs/determinism.md names tests as Suite.test, and their files."""
        text = (ROOT / "docs/determinism.md").read_text()
        sources = {path: path.read_text() for path in (ROOT / "tests").rglob("*_test.*") if path.suffix in (".cpp", ".py")}
        there = set()
        for path, source in sources.items():
            if path.suffix == ".cpp":
                there |= {f"{suite}.{name}" for suite, name in re.findall(r"^TEST(?:_[FP])?\((\w+), (\w+)\)", source, re.M)}
                continue
            for suite in (node for node in ast.parse(source).body if isinstance(node, ast.ClassDef)):
                there |= {f"{suite.name}.{node.name}" for node in suite.body if isinstance(node, ast.FunctionDef)}
        named = set(re.findall(r"`([A-Z]\w+\.\w+)`", text))
        self.assertGreater(len(named), 40)
        self.assertEqual(sorted(named - there), [])
        files = set(re.findall(r"`(tests/[\w/.]+)`", text))
        self.assertEqual(sorted(name for name in files if not (ROOT / name).exists()), [])


class Analysis(InATemporaryFolder):
    def entry(self, source, words):
        return {"directory": str(self.folder), "file": source, "output": "", "command": f"c++ {words} -c {source}"}

    def test_each_own_source_is_read_once_with_the_flags_of_its_first_compilation(self):
        ours, fetched = str(ROOT / "core/digest.cpp"), str(ROOT / "subprojects/a-1/a.cpp")
        entries = [self.entry(ours, "-I.. -DA='\"b c\"' -MD -MQ a.o -MF a.d -include d.hpp -o a.o"), self.entry(ours, "-DE"),
                   self.entry(fetched, ""), self.entry("/usr/src/a.cpp", "")]
        self.write("compile_commands.json", json.dumps(entries))
        self.assertEqual(self.check("analysis"), (0, "1\n"))
        lines = (self.folder / "analysis/build.ninja").read_text().splitlines()
        statement = f"build analysis/core/digest.cpp.analysed: analyse {ours} | {os.path.relpath(ROOT / '.clang-tidy', self.folder)}"
        self.assertEqual(lines[-3:], [statement, "  compiler = c++", "  flags = -I.. '-DA=\"b c\"' -include d.hpp"])
        self.assertEqual(json.loads((self.folder / "analysis/compile_commands.json").read_text()), entries[:1])


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

    def test_a_copy_follows_the_tree_and_leaves_what_is_built_in_it(self):
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

    def test_each_fault_is_told(self):
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
