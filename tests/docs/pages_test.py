# SPDX-License-Identifier: BSD-3-Clause
"""The commands in the documents give the outputs in the documents: pages_test.py BUILD.

A block ```console is a session: a line `$ COMMAND` (continued after a backslash) is executed by bash, and the lines below it
are the expected output, both streams together. In them `...` matches any text, and a line `...` any lines. `$ cat FILE` of a
missing file creates it with the lines below. Progress lines of a run are ignored. The blocks of a page share a folder with the
`scenarios` of the tree and the sources of tests/programs; `waitpoint` is the built program, and pkg-config finds its
installation.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/programs"))
from installed import BUILD, Installed, main  # noqa: E402

PROGRESS = re.compile(r"^ *\d+ s of \d+ s .*\n", re.MULTILINE)
BLOCK = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def commands(block):
    """The session's (command, expected lines)."""
    found, continued = [], False
    for line in block.splitlines():
        if continued:
            found[-1][0] += "\n" + line
        elif line.startswith("$ "):
            found.append([line[2:], []])
        else:
            found[-1][1].append(line)
        continued = (continued or line.startswith("$ ")) and line.endswith("\\")
    return found


def pattern(lines):
    """The expected lines as a regular expression of the whole output."""
    text = ""
    for line in lines:
        text += r"(?:.*\n)*?" if line == "..." else ".*".join(map(re.escape, line.split("..."))) + r" *\n"
    return re.compile(text)


class Pages(Installed):
    def environment(self, page):
        """A folder and the environment for the page's commands."""
        folder = self.folder / page
        tools = folder / ".bin"
        tools.mkdir(parents=True)
        (folder / "scenarios").symlink_to(ROOT / "scenarios")
        for source in (ROOT / "tests/programs").glob("*/*"):
            if source.suffix in (".cpp", ".yaml"):
                shutil.copy(source, folder)
        (tools / "waitpoint").symlink_to(BUILD / "tools/waitpoint")
        configure = tools / "pkg-config"
        configure.write_text(f'#!/bin/sh\nexec {shutil.which("pkg-config")} --define-variable=prefix={self.prefix} "$@"\n')
        configure.chmod(0o755)
        packages = os.pathsep.join({str(path.parent) for path in self.prefix.rglob("*.pc")})
        return folder, {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PKG_CONFIG_PATH": packages}

    def try_page(self, page):
        folder, environment = self.environment(page)
        sessions = [command for block in BLOCK.findall((ROOT / "docs" / page).read_text()) for command in commands(block)]
        self.assertGreater(len(sessions), 1, "the page has no session")
        for command, lines in sessions:
            name = command.removeprefix("cat ")
            if command.startswith("cat ") and not (folder / name).exists():
                (folder / name).write_text("".join(f"{line}\n" for line in lines))
                continue
            done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
            with self.subTest(page=page, command=command):
                output = PROGRESS.sub("", done.stdout)
                output += "" if output.endswith("\n") or not output else "\n"
                self.assertTrue(pattern(lines).fullmatch(output), f"docs/{page}: $ {command}\nsays:\n{output}")

    def test_threads(self):
        self.try_page("threads.md")

    def test_robots(self):
        self.try_page("robots.md")

    def test_laas(self):
        if (BUILD / "libwaitpoint-tcl.so").exists():
            self.try_page("laas.md")

    def test_programs(self):
        self.try_page("programs.md")

    def test_ros(self):
        if (BUILD / "libwaitpoint-nodes.so").exists() and (BUILD / "scenarios/nodes/driver").exists():
            self.try_page("ros.md")

    def test_external(self):
        self.try_page("external.md")


if __name__ == "__main__":
    main()
