# SPDX-License-Identifier: BSD-3-Clause
"""The documents say what happens: pages_test.py BUILD [--long] [--table] [TEST...].

Each block of a command in README.md, CONTRIBUTING.md and docs/ is run, or a comment before it says why not: blocks.py. The
blocks of a page share a folder with `scenarios`, the sources of tests/programs and nothing else; $ROOT is the tree,
`waitpoint` the built program, and pkg-config finds its installation; with a prefix such as /usr for BUILD both are those
that are installed there, as are the scenarios. Pictures that commands of a page write must be those in
docs/, byte for byte. --long runs the blocks that take long, too; --table lists all blocks.
"""

import os
import pathlib
import re
import shutil
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/programs"), str(ROOT / "tests/docs")]
import blocks  # noqa: E402
import sessions  # noqa: E402
from installed import BUILD, IS_PREFIX, Installed, PROGRAM, SCENARIOS, main  # noqa: E402

LONG = "--long" in sys.argv
# Pages that need what not every build has: files of the build folder, programs of the system.
NEEDS = {
    "docs/laas.md": ["libwaitpoint-tcl.so"],
    "docs/laas-tcl.md": ["libwaitpoint-tcl.so"],
    "docs/trust.md": ["libwaitpoint-tcl.so"],
    "docs/ros.md": ["libwaitpoint-nodes.so", "scenarios/nodes/driver"],
    "docs/ros-bags.md": ["libwaitpoint-nodes.so", "scenarios/nodes/driver"],
    "docs/ros-robots.md": ["libwaitpoint-nodes.so", "scenarios/nodes/driver"],
    "docs/ros2.md": ["examples/dds/cyclone_talker"],
}
PICTURES = (".svg", ".html", ".png")


def pictures():
    return sorted(path for path in (ROOT / "docs").rglob("*") if path.suffix in PICTURES)


def named(picture, step):
    """True if the step's commands name the picture's file."""
    return step.verdict() in ("run", "long") and re.search(rf"(?<![\w.-]){re.escape(picture.name)}(?![\w.-])", step.words())


class Pages(Installed):
    def environment(self, page):
        """A folder and the environment for the page's commands."""
        folder = self.folder / page.replace("/", "-")
        tools = folder / ".bin"
        tools.mkdir(parents=True)
        (folder / "scenarios").symlink_to(SCENARIOS)
        for source in (ROOT / "tests/programs").glob("*/*"):
            if source.suffix in (".c", ".cpp", ".ctl", ".hpp", ".yaml"):
                (folder / source.name).write_text(source.read_text().replace("../../../scenarios/", "scenarios/"))
        (tools / "waitpoint").symlink_to(PROGRAM)
        configure = tools / "pkg-config"
        configure.write_text(f'#!/bin/sh\nexec {shutil.which("pkg-config")} --define-variable=prefix={self.prefix} "$@"\n')
        configure.chmod(0o755)
        packages = os.pathsep.join({str(path.parent) for path in self.prefix.rglob("*.pc")})
        return folder, {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PKG_CONFIG_PATH": packages,
                        "ROOT": str(ROOT), "BUILD": str(BUILD)}

    def try_session(self, step, folder, environment):
        for command, lines in sessions.commands(step.text):
            name = command.removeprefix("cat ")
            if command.startswith("cat ") and not (folder / name).exists():
                (folder / name).write_text("".join(f"{line}\n" for line in lines))
                continue
            self.try_command(step, command, lines, folder, environment)

    def try_command(self, step, command, lines, folder, environment):
        """Compares a command's output with the expected lines."""
        lines = sessions.from_the_prompt(lines)
        output, _ = sessions.output_of(command, folder, environment, sessions.typed(lines))
        with self.subTest(step=str(step), command=command):
            self.assertTrue(sessions.pattern(lines).fullmatch(output), f"{step}: $ {command}\nsays:\n{output}")

    def try_script(self, step, folder, environment):
        """Runs a script whose output the page does not show."""
        output, status = sessions.output_of("set -e\n" + step.text, folder, environment)
        with self.subTest(step=str(step)):
            self.assertEqual(status, int(step.marks.get("status", 0)), f"{step}:\n{step.text}says:\n{output}")

    def try_page(self, page):
        missing = [name for name in NEEDS.get(page, ()) if not IS_PREFIX and not (BUILD / name).exists()]
        if missing:
            self.skipTest(f"not in this build: {', '.join(missing)}")
        steps = blocks.chosen(page, LONG)
        folder, environment = self.environment(page)
        for step in steps:
            if step.language == "console":
                self.try_session(step, folder, environment)
            elif step.language == "text":
                self.try_command(step, step.marks["output of"], step.text.splitlines(), folder, environment)
            else:
                self.try_script(step, folder, environment)
        for picture in pictures():
            if any(named(picture, step) for step in steps):
                with self.subTest(picture=str(picture)):
                    drawn = folder / picture.name
                    self.assertTrue(drawn.exists() and drawn.read_bytes() == picture.read_bytes(),
                                    f"{page}: {picture.name} is not what its command draws")

    def test_each_block_is_run_or_says_why_not(self):
        missing = [str(step) for page in blocks.pages() for step in blocks.steps(page)[0] if step.verdict() == "missing"]
        self.assertEqual(missing, [], "blocks without a language, a mark or a command: see tests/docs/blocks.py")

    def test_paths_named_by_a_reason_exist(self):
        reasons = [(step, reason) for page in blocks.pages() for step in blocks.steps(page)[0] for reason in step.marks.values()]
        missing = [f"{step}: {name}" for step, reason in reasons for name in re.findall(r"(?<!/)\btests/[\w./]*\w", reason)
                   if not (ROOT / name).exists()]
        self.assertEqual(missing, [])

    def test_each_picture_is_drawn_or_says_why_not(self):
        found = [blocks.steps(page) for page in blocks.pages()]
        reasons = {name for _, not_rendered in found for name in not_rendered}
        missing = [picture.name for picture in pictures() if picture.name not in reasons
                   and not any(named(picture, step) for steps, _ in found for step in steps)]
        self.assertEqual(missing, [])


def add_tests():
    """A test for each page that has something to run."""
    for page in blocks.pages():
        if any(step.verdict() in ("run", "long") for step in blocks.steps(page)[0]):
            name = "test_" + re.sub(r"\W", "_", page.removeprefix("docs/").removesuffix(".md"))
            setattr(Pages, name, lambda self, page=page: self.try_page(page))


if __name__ == "__main__":
    if "--table" in sys.argv:
        print(blocks.table(), end="")
        sys.exit(0)
    sys.argv = [word for word in sys.argv if word != "--long"]
    add_tests()
    main()
