# SPDX-License-Identifier: BSD-3-Clause
"""Sessions of the documents: their commands, what they should print, and what they print.

A line `$ COMMAND` (continued after a backslash) is executed by bash; the lines below are the expected output, both streams
together. In them `...` matches any text, a line `...` any lines, and a time or a rate any other. Lines that begin with a prompt of gdb or of an interactive run
are typed at a terminal of the command's own when the prompt is there.
"""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time

# What differs from run to run and from machine to machine.
TIMES = [(re.compile(before), after) for before, after in (
    (r"in \d+\.\d s \(\d+\.\d a second\)", r"in \d+\.\d s \(\d+\.\d a second\)"),
    (r"speed {13}\d+\.\d times real time \(\d+\.\d+ s\)", r"speed {13}\d+\.\d times real time \(\d+\.\d+ s\)"))]
PROMPT = re.compile(r"^(\(gdb\)|\d+\.\d{3} s>) (.*)$", re.MULTILINE)
WAITING = re.compile(r"^(\(gdb\)|\d+\.\d{3} s>) \Z", re.MULTILINE)
# What the next text has replaced on a terminal, or would have: the bar of a run's progress.
OVERWRITTEN = re.compile(r"[^\n\r]*\r(?=[^\n\r])|[█░]+ \d+ s of \d+ s .*? x real time")
ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
TIMEOUT_S = 300
LINES_AND_COLUMNS = 5000, 1000  # nothing is paged or wrapped


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
        text += r"(?:.*\n)*?" if line == "..." else ".*".join(map(literal, line.split("..."))) + r" *\n"
    return re.compile(text)


def literal(text):
    """A regular expression of this text with any times."""
    for before, after in TIMES:
        if found := before.search(text):
            return literal(text[:found.start()]) + after + literal(text[found.end():])
    return re.escape(text)


def output_of(command, folder, environment, typed=()):
    """(output, exit status) of a command, with lines typed at its prompts if there are any."""
    if typed:
        return dialogue(command, folder, environment, typed)
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=TIMEOUT_S)
    output = done.stdout
    return output + ("" if output.endswith("\n") or not output else "\n"), done.returncode


def dialogue(command, folder, environment, typed):
    """As output_of: the terminal's text from the first prompt on, with what was typed."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.execvpe("bash", ["bash", "-c", command], {**environment, "TERM": "dumb", "INPUTRC": "/dev/null"})
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", *LINES_AND_COLUMNS, 0, 0))
    text, typed, seen, end = "", list(typed), 0, time.monotonic() + TIMEOUT_S
    while time.monotonic() < end:
        if not select.select([terminal], [], [], 1)[0]:
            continue
        try:
            piece = os.read(terminal, 1 << 16)
        except OSError:  # the last process has closed the terminal
            break
        text = OVERWRITTEN.sub("", ESCAPES.sub("", (text + piece.decode(errors="replace")).replace("\r\n", "\n")))
        if WAITING.search(text, seen):
            if not typed:
                text = WAITING.sub("", text)
                break
            os.write(terminal, (typed.pop(0) + "\n").encode())
            seen = len(text)
    os.kill(process, signal.SIGKILL)  # it may have ended, but it was not waited for
    os.close(terminal)
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    begin = PROMPT.search(text)
    return (text[begin.start():] if begin else text).rstrip("\n") + "\n", status


def typed(lines):
    """The lines that are typed at prompts."""
    return [found[2] for found in map(PROMPT.match, lines) if found]


def from_the_prompt(lines):
    """The lines from the first prompt on, which is where a dialogue begins; all if there is none."""
    prompts = [index for index, line in enumerate(lines) if PROMPT.match(line)]
    return lines[prompts[0]:] if prompts else lines
