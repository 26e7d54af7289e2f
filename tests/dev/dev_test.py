# SPDX-License-Identifier: BSD-3-Clause
"""The development tools find violations: each check on a small tree that breaks its rule."""

import ast
import json
import os
import re
import subprocess
import unittest

from temporary_folder import InATemporaryFolder, ROOT

LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n"


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

    def test_each_forbidden_include_is_reported_with_its_line(self):
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

    def test_each_broken_rule_is_reported(self):
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

    def test_each_forbidden_call_is_reported(self):
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


if __name__ == "__main__":
    unittest.main()
