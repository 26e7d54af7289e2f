# SPDX-License-Identifier: BSD-3-Clause
"""The checks of names and words report violations: words_test.py."""

import unittest

from temporary_folder import InATemporaryFolder


class WithATable(InATemporaryFolder):
    def check_with(self, part, *lines):
        return self.check(part, str(self.folder), str(self.write("table", "".join(f"{line}\n" for line in lines))))


class Names(WithATable):
    def test_stand_in_their_folders_only(self):
        self.write("fibers/explore/search.hpp", "struct Budget {\n};\n")
        self.write("tools/explore/search.cpp", "// Budget\nint a; Budget b;\n")
        status, output = self.check_with("names", "Budget fibers/explore")
        self.assertEqual(status, 1)
        self.assertIn("tools/explore/search.cpp:2: Budget stands in fibers/explore only\n", output)
        self.assertEqual(self.check_with("names", "Budget fibers/explore tools/explore")[0], 0)
        self.assertIn("table: Effort: a name that stands nowhere\n", self.check_with("names", "Effort core")[1])
        self.assertIn("tools/explore/search.cpp:2: Budget has given way to another name\n", self.check_with("names", "Budget -")[1])
        self.assertEqual(self.check_with("names", "Effort -")[0], 0)

    def test_types_are_unique_apart_from_the_table(self):
        for folder in "core", "tools":
            self.write(f"{folder}/a.hpp", "namespace a {\nclass Plan final : Base {\n};\nstruct Other;\n}\n")
        status, output = self.check_with("names")
        self.assertEqual(status, 1)
        self.assertIn("Plan is declared in 2 headers, at most 1: core/a.hpp tools/a.hpp\n", output)
        self.assertEqual(self.check_with("names", "type Plan 2")[0], 0)
        self.assertIn("warning: table: type Plan 3: it is declared in 2 headers only\n", self.check_with("names", "type Plan 3")[1])


class Sensors(WithATable):
    def test_are_named_in_a_limited_number_of_sources(self):
        self.write("world/imu.hpp", "struct Imu;\n")
        self.write("modules/reader.cpp", 'read("imu"); // and gps\n')
        self.assertEqual(self.check_with("sensors", "imu 2 Imu \\bimu\\b"), (0, "imu in 2 sources, 1 sensors, 0 violations\n"))
        self.assertIn("imu is named in 2 sources, at most 1: modules/reader.cpp world/imu.hpp\n", self.check_with("sensors", "imu 1 Imu \\bimu\\b")[1])
        self.assertIn("table: gps: a sensor that no source names\n", self.check_with("sensors", "gps 2 gps")[1])
        self.assertEqual(self.check_with("sensors", "gps x gps"),
                         (1, "table:1: expected SENSOR NUMBER PATTERN [PATTERN...], found 'gps x gps'\n"))


class NamesOfTests(InATemporaryFolder):
    def test_behaviours_in_pascal_case_pass(self):
        self.write("tests/core/a_test.cpp", "TEST(Children, WaitForTheirEnd) {\nTEST_F(Plan, NamesTheStepWhoseTimeIsShort) {\n")
        self.write("tests/core/a_test.py", "    def test_runs_repeat(self):\n")
        self.assertEqual(self.check("test_names"), (0, "3 tests, 0 violations\n"))

    def test_snake_case_and_riddles_are_violations(self):
        for name in "of_which_one_waits", "WhoWaits", "AWriteToNobody", "Wait_twice":
            with self.subTest(name=name):
                self.write("tests/core/a_test.cpp", f"TEST(Children, {name}) {{\n")
                status, output = self.check("test_names")
                self.assertEqual(status, 1)
                self.assertIn(f"tests/core/a_test.cpp: Children.{name}: expected ", output)
        self.write("tests/core/a_test.py", "    def test_who_waits(self):\n")
        self.assertIn("tests/core/a_test.py: test_who_waits: expected a behaviour", self.check("test_names")[1])


class Words(WithATable):
    def test_vague_ones_have_a_share_of_the_comments(self):
        self.write("core/time.hpp", "// " + "word " * 299 + 'what\nconst char* what = "what // who";\n')
        self.assertEqual(self.check_with("words", "core 4", "* 1"), (0, "300 words of comments, 3.3 of 1 000 vague, 0 violations\n"))
        self.assertIn("core: 3.3 of 1 000 words of comments are what, who, whether, nobody, ...; at most 3\n",
                      self.check_with("words", "* 3")[1])
        self.assertIn("table: world: a folder without comments\n", self.check_with("words", "world 4", "* 4")[1])

    def test_comments_of_scripts_count(self):
        self.write("tools/dev/a.py", '"""' + "what " * 20 + '"""\n' + "# word\n" * 280 + "a = 'what'\n")
        self.assertIn("tools/dev: 66.7 of 1 000", self.check_with("words", "* 3")[1])


if __name__ == "__main__":
    unittest.main()
