# SPDX-License-Identifier: BSD-3-Clause
"""Checkpoints for `back`: gdb's own, which are forks of the process.

Made at the first event, then every `spacing` events. Beyond a maximum number every second one is deleted and the spacing
doubles: so they are spread evenly over a run of any length, and the distance of an event from the nearest earlier one is at
most a fixed fraction of the run.
"""

import os
import re
import signal

import gdb

from . import records
from .processes import own_entry

SPACING_MIN = 65536  # events: a replay of some 50 ms
MOST = 12

kept = {}  # by event: (gdb's number, process)
spacing = SPACING_MIN
refused = False  # gdb cannot fork: the program has system threads
exit_breakpoint = None


class Wanted(gdb.Parameter):
    """Whether the process is forked at intervals while it runs; `back` needs these checkpoints."""

    set_doc = "Set whether checkpoints are made for `back`."
    show_doc = "Show whether checkpoints are made for `back`."

    def __init__(self):
        super().__init__("waitpoint-checkpoints", gdb.COMMAND_RUNNING, gdb.PARAM_BOOLEAN)
        self.value = True

    def get_set_string(self):
        return ""

    def get_show_string(self, value):
        return f"Checkpoints are{'' if self.value else ' not'} made for `back`."


class Exit(gdb.Breakpoint):
    """At the end of the process, where gdb would continue with one of its checkpoints."""

    def __init__(self):
        super().__init__("_exit", internal=True)
        self.silent = True

    def stop(self):
        delete_all()
        return False


def wanted():
    """Not for an attached process: its forks would continue after gdb detaches. Nor under `waitpoint exec`: a fork has no
    copy of the memory that the processes share."""
    if own_entry() or gdb.selected_inferior().was_attached:
        return False
    return gdb.parameter("waitpoint-checkpoints") and not refused


def listed():
    """({number: process} of all checkpoints, including the current process; its number)."""
    text, found, current = gdb.execute("info checkpoints", to_string=True), {}, None
    pattern = r"^([* ]) *(\d+) (?:process (\d+)|Thread \S+ \(LWP (\d+)\))"
    for star, number, process, thread in re.findall(pattern, text, re.MULTILINE):
        found[int(number)] = int(process or thread)
        current = int(number) if star == "*" else current
    return found, current


def checkpoint():
    """gdb's command, without its output. When a breakpoint decides whether to stop, gdb 16 waits for ever for a function of
    the process that was called by way of gdb.execute(), as fork() is here."""
    if not hasattr(gdb, "execute_mi"):  # before gdb 14
        gdb.execute("checkpoint", to_string=True)
        return
    gdb.flush(gdb.STDOUT)
    output, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        gdb.execute_mi("-interpreter-exec", "console", "with pagination off -- checkpoint")
    finally:
        gdb.flush(gdb.STDOUT)
        os.dup2(output, 1)
        os.close(output)
        os.close(nowhere)


def fork():
    """Makes a checkpoint of the process in its present state: (number, process)."""
    before = set(listed()[0])
    checkpoint()
    processes = listed()[0]
    new = set(processes) - before - {0}
    if not new:
        raise gdb.GdbError("the process cannot be forked")
    return max(new), processes[max(new)]


def make(event):
    """Makes a checkpoint of the event that begins now; called where the kernel calls debugger_checkpoint()."""
    global spacing, refused, exit_breakpoint
    if exit_breakpoint is None:
        exit_breakpoint = Exit()
    try:
        if wanted() and event not in kept:
            kept[event] = fork()
    except gdb.error as reason:
        refused = True
        print(f"`back` is not available: {reason}")
    while len(kept) > MOST:
        spacing *= 2
        for surplus in sorted(kept)[1::2]:
            delete(*kept.pop(surplus))
    ask_for_next(event)


def ask_for_next(event):
    before = [made for made in kept if made <= event]
    records.write_view("checkpoint_at", max(before, default=event) + spacing if wanted() else 2**64 - 1)


def delete(number, process):
    """Ends a process that is not the current one.

    Not by `delete checkpoint`: gdb 13 fails for the first process, whose parent is gdb itself. A stop signal is pending
    when the process is released, so that it executes nothing more."""
    if listed()[0].get(number) != process:
        return  # already gone
    os.kill(process, signal.SIGSTOP)
    gdb.execute(f"detach checkpoint {number}", to_string=True)
    os.kill(process, signal.SIGKILL)


def delete_all():
    for checkpoint in kept.values():
        delete(*checkpoint)
    forget()


def delete_after(event):
    """Later events may differ from now on: the user may change a variable."""
    for made in [made for made in kept if made > event]:
        delete(*kept.pop(made))


def restart_before(event):
    """Goes to the last checkpoint not after `event`, and ends the current process."""
    processes, left = listed()
    before = [made for made, (number, process) in kept.items() if made <= event and processes.get(number) == process]
    if not before:
        why = "gdb did not watch the process then" if wanted() else "none are made (show waitpoint-checkpoints)"
        if own_entry():
            why = "`waitpoint exec` has none"
        raise gdb.GdbError(f"there is no checkpoint before that event: {why}")
    nearest = max(before)
    gdb.execute(f"restart {kept[nearest][0]}", to_string=True)
    records.write_view("restarted", 1)
    kept[nearest] = fork()
    delete(left, processes[left])
    delete_after(event)
    return nearest


def adopt_current(event):
    """When a process dies without exiting, gdb continues with a checkpoint, which thereby ceases to be one."""
    for made, (_, process) in list(kept.items()):
        if process == gdb.selected_inferior().pid:
            del kept[made]
            print(f"The process has died; this is its checkpoint of event {made}.")
            records.write_view("restarted", 1)
            if event == made:
                kept[event] = fork()


def forget():
    """Clears the state of a process that has ended."""
    global spacing, refused
    kept.clear()
    spacing, refused = SPACING_MIN, False


def register():
    Wanted()
