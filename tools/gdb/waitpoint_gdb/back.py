# SPDX-License-Identifier: BSD-3-Clause
"""`back`: goes to a previous event, by a checkpoint and a replay of the events from there.

The run is deterministic, so the replay reaches the same event, which is verified against the last two events, kept by the
kernel. Output of the replay is discarded.
"""

import contextlib

import gdb

from . import checkpoints, records, selection, stepping, watching

MEMBERS = ("time.ns_", "task", "operation", "object")
# A replay of this many events leaves a checkpoint on its way: the next step back starts there.
LONG_WAY = 16384


def event_seen(which):
    view = records.view()
    return tuple(view.number(f"{which}.{member}") for member in MEMBERS)


class Back(gdb.Command):
    """back [N]: go back to the previous event, or N events back.

    From within an event, the first step goes back to that event's beginning. The process is restarted from an earlier fork
    and repeats the events up to there, without breakpoints and output. Variables changed by hand since, input already read,
    and other processes are not restored."""

    def __init__(self):
        super().__init__("back", gdb.COMMAND_RUNNING)

    def invoke(self, argument, from_tty):
        steps = stepping.count(argument, "back")
        watching.check_alive()
        if not records.view().number("watching"):
            raise gdb.GdbError("no event has been executed yet")
        present, began = watching.events(), watching.at_an_event()
        target = present - steps + (0 if began else 1)
        if target < 1:
            raise gdb.GdbError("there is no previous event")
        expected = {present: event_seen("last"), present - 1: event_seen("before")}.get(target)
        selection.parked.deselect()
        replay(target)
        if expected not in (None, event_seen("last")):
            print("warning: this run does not repeat: the event differs from the recorded one")
        watching.tell()


def replay(target):
    """Runs from the nearest checkpoint to the event with this count."""
    begun = checkpoints.restart_before(target)
    with quiet():
        if target - begun > LONG_WAY:
            run_to(target - LONG_WAY // 2)
            checkpoints.kept[target - LONG_WAY // 2] = checkpoints.fork()
        run_to(target)
    checkpoints.ask_for_next(target)
    watching.request.write()
    if watching.events() != target:
        raise gdb.GdbError(f"the replay stopped at event {watching.events()}, not at {target}")


def run_to(event):
    if watching.events() == event:
        return
    records.write_view("stop_at_event", event)
    records.write_view("stop_at_task", 0)
    records.write_view("stop_at_time.ns_", records.NO_TIME)
    records.write_view("checkpoint_at", watching.NEVER)
    gdb.execute("continue", to_string=True)


@contextlib.contextmanager
def quiet():
    """Disables breakpoints and output."""
    enabled = [breakpoint for breakpoint in gdb.breakpoints() if breakpoint.enabled and breakpoint.number > 0]
    for breakpoint in enabled:
        breakpoint.enabled = False
    watching.replaying = True
    mute = "call (void)'waitpoint::kernel::debugger_mute'({})"
    gdb.execute(mute.format(1), to_string=True)
    try:
        yield
    finally:
        gdb.execute(mute.format(0), to_string=True)
        watching.replaying = False
        for breakpoint in enabled:
            if breakpoint.is_valid():
                breakpoint.enabled = True


def register():
    Back()
