# SPDX-License-Identifier: BSD-3-Clause
"""Modules from descriptions are generated, compiled, run and talked to, with the installed library: genom_test.py BUILD."""

import os
import re
import shutil
import subprocess

from installed import HERE, Installed, main, run

EXAMPLES = HERE.parents[1] / "examples"
STRICT = ["CFLAGS=-O1 -Wall -Wextra -Werror", "CXXFLAGS=-O1 -Wall -Wextra -Werror"]


class Generated(Installed):
    def generate(self, *names):
        """Copies the examples of these names, generates them, and returns the folder of the last."""
        folder = self.folder / "-".join(names)
        for name in names:
            if (folder / name / "server").exists():
                continue
            shutil.copytree(EXAMPLES / name, folder / name)
            words = ["--include", folder / names[0]] if name != names[0] else []
            run(self.prefix / "bin/waitpoint", "genom", folder / name / f"{name}.gen", *words)
        return folder / names[-1]

    def make(self, folder, *more):
        """Compiles as the Makefile does, without any warning."""
        tools = folder / ".bin"
        tools.mkdir(exist_ok=True)
        configure = tools / "pkg-config"
        configure.write_text(f'#!/bin/sh\nexec {shutil.which("pkg-config")} --define-variable=prefix={self.prefix} "$@"\n')
        configure.chmod(0o755)
        packages = os.pathsep.join({str(path.parent) for path in self.prefix.rglob("*.pc")})
        environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PKG_CONFIG_PATH": packages}
        run("make", "-C", folder, *STRICT, *more, env=environment)
        return folder / folder.name

    def talk(self, program, *lines):
        """The output of an interactive run with these lines."""
        scenario = program.parent / f"{program.name}.yaml"
        done = subprocess.run([program, "run", scenario, "--interactive"], input="\n".join([*lines, "quit", ""]),
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout)
        return re.sub(r" +operator: ", " ", done.stdout)

    def test_a_module_runs_its_codels_in_c(self):
        output = self.talk(self.make(self.generate("mast")), "request robot mast SetSpeed speed=7", "run +0.2",
                           "request robot mast Watch above=0.5", "request robot mast Raise height=3",
                           "request robot mast Raise", "run +1.5", "request robot mast Raise height=0.2", "run +1",
                           "request robot mast Stop", "run +1")
        # The control codels reject 7 and 3 m; at 0.5 m/s the mast is above 0.5 m after 1.1 s, and Raise interrupts itself.
        self.assertIn("0.010 s request robot mast SetSpeed speed=7: own report 100\n", output)
        self.assertIn("0.200 s request robot mast Raise height=3: own report 102\n", output)
        self.assertIn("1.300 s request robot mast Watch above=0.5: ok\n", output)
        self.assertIn("1.750 s request robot mast Raise: ACTIVITY_INTERRUPTED\n", output)
        self.assertIn("2.750 s request robot mast Raise height=0.2: ACTIVITY_INTERRUPTED\n", output)

    def test_codels_use_another_module_by_its_client_library(self):
        folder = self.generate("mast", "lookout")
        program = self.make(folder, "MODULES=../mast", "MAIN=main.cc")
        output = self.talk(program, "request ada lookout Look height=1", "request bea lookout Look height=5",
                           "request bea mast SetLoad", "run +6", "request bea lookout Look height=0.5", "run +4")
        # Both robots have the modules, each with data of its own.
        self.assertRegex(output, r"[45]\.\d+ s request ada lookout Look height=1: ok\n")
        self.assertIn("request bea lookout Look height=5: own report 101\n", output)
        self.assertRegex(output, r"[78]\.\d+ s request bea lookout Look height=0.5: ok\n")
        checked = run(program, "run", folder / "lookout.yaml", "--verify")
        self.assertIn("the same run", checked)

    def test_stubs_compile_and_users_files_are_kept(self):
        folder = self.folder / "stubs"
        folder.mkdir()
        for name in ("mast.gen", "mastStruct.h"):
            shutil.copy(EXAMPLES / "mast" / name, folder)
        waitpoint = self.prefix / "bin/waitpoint"
        run(waitpoint, "genom", folder / "mast.gen", "--out", folder / "mast")
        program = self.make(folder / "mast")
        self.assertIn("wp1:", run(program, "run", folder / "mast/mast.yaml", "--until", "1"))
        stub = folder / "mast/codels/mastMotionTaskCodels.c"
        stub.write_text("/* mine */\n")
        header = folder / "mast/server/mastType.h"
        header.write_text("")
        self.assertIn("mastMotionTaskCodels.c (kept)", run(waitpoint, "genom", folder / "mast.gen", "--out", folder / "mast"))
        self.assertEqual(stub.read_text(), "/* mine */\n")
        self.assertIn("MAST_STATE_POSTER_STR", header.read_text())

    def test_a_wrong_description_is_one_line_and_nothing_is_written(self):
        wrong = self.folder / "wrong.gen"
        wrong.write_text("module wrong {\n  number: many;\n};\n")
        done = subprocess.run([self.prefix / "bin/waitpoint", "genom", wrong, "--out", self.folder / "nothing"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"waitpoint: {wrong}:2: column 11: expected a constant, found the unknown name 'many'\n")
        self.assertFalse((self.folder / "nothing").exists())


if __name__ == "__main__":
    main()
