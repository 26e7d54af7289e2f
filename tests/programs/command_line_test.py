# SPDX-License-Identifier: BSD-3-Clause
"""Man pages, completion by shells and the version as data: command_line_test.py BUILD."""

import json
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAM = BUILD / "tools/waitpoint"


def output_of(program, *words):
    return subprocess.run([BUILD / "tools" / program, *words], capture_output=True, text=True, check=True).stdout


def waitpoint(*words):
    return output_of("waitpoint", *words)


def names(text, pattern):
    return re.findall(pattern, text, re.MULTILINE)


def commands_of(program):
    return names(output_of(program, "--help").split("Commands:")[1], r"^  (\w+)  ")


# waitpoint-native may be left out of a build.
COMMANDS = {name: commands_of(name) for name in ("waitpoint", "waitpoint-native") if (BUILD / "tools" / name).exists()}


class ManualPages(unittest.TestCase):
    def test_have_every_option_of_the_help(self):
        self.assertIn("explore", COMMANDS["waitpoint"])
        for program, command in ((program, command) for program in COMMANDS for command in COMMANDS[program]):
            page = output_of(program, "manual", command).replace("\\-", "-")
            self.assertIn(f".TH {program.upper()}-{command.upper()} 1", page)
            options = names(output_of(program, command, "--help-all"), r"^  (--[\w-]+)")
            self.assertEqual(names(page, r"^(?:\\fB-h\\fR, )?\\fB(--[\w-]+)\\fR"), [*options, "--help", "--help-all"], command)

    def test_program_manual_has_its_commands(self):
        for program, commands in COMMANDS.items():
            page = output_of(program, "manual").replace("\\-", "-")
            self.assertEqual(names(page, rf"^\\fB{program}-(\w+)\\fR\(1\)"), commands)

    @unittest.skipUnless(shutil.which("groff"), "without groff")
    def test_are_roff_without_warnings(self):
        for program, command in ((program, command) for program in COMMANDS for command in ["", *COMMANDS[program]]):
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-P-c"], text=True, check=True, capture_output=True,
                                  input=output_of(program, "manual", *command.split()))
            self.assertEqual(done.stderr, "", command)
            self.assertIn("SYNOPSIS", re.sub(".\x08", "", done.stdout))

    def test_unknown_command_is_refused(self):
        done = subprocess.run([PROGRAM, "manual", "walk"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected a command of waitpoint, found 'walk'", done.stderr)


# What a shell is to offer for the last word of a line, in a folder with a scenario, a text and a folder; one scenario is
# installed.
OFFERED = {
    "": COMMANDS["waitpoint"],
    "manual co": ["compare", "completion"],
    "completion ": ["bash", "fish", "zsh"],
    "--v": ["--version"],
    "run --see": ["--seed", "--seeds"],
    "run own.yaml --see": ["--seed", "--seeds"],
    "plan --see": [],
    "run --strategy ": ["fifo", "random"],
    "exec --strategy r": ["random"],
    "explore --strategy po": ["portfolio", "pos"],
    "run --seed ": [],
    "run ": ["maps", "office.yaml", "own.yaml"],
    "run --journal ": ["maps", "own.yaml", "text"],
    "run --allow ": ["maps"],
    "exec -- cat t": ["text"],
    "explore -- cat t": ["text"],
}

BASH = r"""
. ../script
while IFS= read -r line; do
  read -ra COMP_WORDS <<<"waitpoint $line"
  [[ $line && $line != *" " ]] || COMP_WORDS+=("")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  _waitpoint
  printf "%s\n" "${COMPREPLY[@]}" END
done
"""

FISH = r"""
source ../script
while read -l line
  complete -C "waitpoint $line" | string replace -r "\t.*" ""
  echo END
end
"""

# An interactive shell on a terminal of its own; what its completion adds goes to a file.
ZSH = r"""
zmodload zsh/zpty
: > ../found
zpty shell zsh -f -i
zpty -w shell 'PROMPT=""; fpath=(.. $fpath); autoload -U compinit; compinit -u -D
compadd() {
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
  local -a found; builtin compadd -O found "$@"; print -rl -- $found >> ../found; builtin compadd "$@"
}
end-of-case() { print END >> ../found }; zle -N end-of-case
bindkey "^I" complete-word "^E" end-of-case "^U" kill-whole-line'
integer cases=0
while IFS= read -r line; do
  cases+=1
  zpty -w -n shell $'\x15'"waitpoint $line"$'\t\x05'
  for i in {1..400}; do (( $(grep -c END ../found) == cases )) && break; sleep 0.02; done
done
cat ../found
"""


class Completion(unittest.TestCase):
    def offered(self, shell, options, program, lines):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "prefix/bin").mkdir(parents=True)
            (root / "prefix/bin/waitpoint").symlink_to(PROGRAM)
            (root / "prefix/share/waitpoint/scenarios").mkdir(parents=True)
            (root / "prefix/share/waitpoint/scenarios/office.yaml").touch()
            (root / "here/maps").mkdir(parents=True)
            (root / "here/own.yaml").touch()
            (root / "here/text").touch()
            (root / ("_waitpoint" if shell == "zsh" else "script")).write_text(waitpoint("completion", shell))
            done = subprocess.run([shell, *options, "-c", program], cwd=root / "here", text=True, capture_output=True,
                                  input="".join(f"{line}\n" for line in lines), timeout=60,
                                  env={**os.environ, "HOME": folder, "TERM": "dumb",
                                       "PATH": f"{root}/prefix/bin:{os.environ['PATH']}"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [sorted({word.strip().rstrip("/") for word in part.splitlines()} - {""})
                for part in done.stdout.split("END\n")[:-1]]

    def check(self, shell, options, program):
        found = self.offered(shell, options, program, OFFERED)
        offered = dict(zip(OFFERED, found))
        if shell == "fish":  # release 4 also offers options that have the letters anywhere
            for line in offered:
                typed = line.split(" ")[-1]
                offered[line] = [word for word in offered[line] if word.startswith(typed) or not typed.startswith("-")]
        self.assertEqual(offered, {line: sorted(words) for line, words in OFFERED.items()})

    def test_by_bash(self):
        self.check("bash", ["--norc"], BASH)
        # Bash makes words of their own of what is beside a '='.
        self.assertEqual(self.offered("bash", ["--norc"], BASH, ["run --strategy = r"]), [["random"]])

    @unittest.skipUnless(shutil.which("fish"), "without fish")
    def test_by_fish(self):
        self.check("fish", ["--no-config"], FISH)

    @unittest.skipUnless(shutil.which("zsh"), "without zsh")
    def test_by_zsh(self):
        self.check("zsh", ["-f"], ZSH)

    def test_for_an_unknown_shell_is_refused(self):
        done = subprocess.run([PROGRAM, "completion", "ksh"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("expected bash, zsh or fish, found 'ksh'", done.stderr)


class Scenarios(unittest.TestCase):
    def test_are_listed_with_a_line_each_and_found_by_name(self):
        rows = [line.split(None, 1) for line in waitpoint("scenarios").splitlines()]
        self.assertIn(["office", "a robot's rounds on an office floor, with one door blocked"], rows)
        self.assertTrue(all(len(row) == 2 for row in rows), rows)
        for name, text in rows:
            if "; needs " not in text:
                self.assertEqual(subprocess.run([PROGRAM, "check", name], capture_output=True).returncode, 0, name)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("office", "office.yaml"):
                done = subprocess.run([PROGRAM, "check", name], cwd=folder, capture_output=True, text=True)
                self.assertIn("good: 1 robot, 5 modules", done.stdout, done.stderr)


def on_a_terminal(*words):
    """What the program writes to a terminal that is its standard error."""
    master, terminal = pty.openpty()
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=terminal) as program:
        os.close(terminal)
        text = b""
        while True:
            try:
                text += os.read(master, 4096)
            except OSError:  # its end
                break
        os.close(master)
    return program.returncode, text.decode()


class Progress(unittest.TestCase):
    def test_is_for_terminals_after_two_seconds(self):
        run = ["run", "office", "--until", "25", "--set", "expect.goals_reached=0"]
        self.assertEqual(on_a_terminal(*run), (0, ""))
        status, text = on_a_terminal(*run, "--speed", "10")
        self.assertEqual(status, 0)
        self.assertIn(" s of 25 s", text)
        self.assertTrue(text.endswith("\r\x1b[K"), text)
        into_a_pipe = subprocess.run([PROGRAM, *run, "--speed", "10"], capture_output=True, text=True)
        self.assertEqual((into_a_pipe.returncode, into_a_pipe.stderr), (0, ""))


class Version(unittest.TestCase):
    def test_is_a_document_of_json(self):
        version = json.loads(waitpoint("--version", "--json"))["result"]
        self.assertEqual(list(version), ["version", "digests", "compiler", "flags", "math"])
        self.assertEqual(version["digests"], "wp1")
        lines = dict(line.split(None, 1) for line in waitpoint("--version").splitlines())
        self.assertEqual(version["version"], lines["waitpoint"])
        self.assertEqual(version["math"], lines["math"])


class Installation(unittest.TestCase):
    def test_has_a_page_for_each_command_and_the_scripts(self):
        installed = json.loads((BUILD / "meson-info/intro-installed.json").read_text()).values()
        pages = {pathlib.Path(path).name for path in installed if "/man/man1/" in path}
        if not pages:
            self.skipTest("this build does not run its own program")
        expected = {f"{program}{command and '-'}{command}.1" for program in COMMANDS for command in ["", *COMMANDS[program]]}
        self.assertEqual(pages, expected)
        for end in ("bash-completion/completions/waitpoint.bash", "zsh/site-functions/_waitpoint",
                    "fish/vendor_completions.d/waitpoint.fish"):
            self.assertTrue(any(path.endswith("/share/" + end) for path in installed), end)


if __name__ == "__main__":
    unittest.main()
