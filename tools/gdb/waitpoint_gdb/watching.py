# SPDX-License-Identifier: BSD-3-Clause
"""The events of a process under gdb: requests to the kernel to stop at one, and reports of stops.

The kernel (fibers/kernel/debugger.hpp) compares each event with the request and calls an empty function at a match; so a
step over a million events costs two stops.
"""

import gdb

from . import checkpoints, fibers, records, selection

NEVER = 2**64 - 1


class Request:
    """The conditions to stop at: kept here, as a checkpoint contains the request of its creation."""

    def __init__(self):
        self.event, self.task, self.times = 0, 0, []

    def write(self):
        records.write_view("stop_at_event", self.event)
        records.write_view("stop_at_task", self.task)
        records.write_view("stop_at_time.ns_", self.times[0] if self.times else records.NO_TIME)


class RunBegins(gdb.Breakpoint):
    """A run is entered: at the first of a process, the kernel is told to show its events."""

    def __init__(self):
        super().__init__("waitpoint::kernel::debugger_run", internal=True)
        self.silent = True

    def stop(self):
        if not records.view().number("watching"):
            checkpoints.forget()
            watch()
        self.enabled = False
        return False


class EventReached(gdb.Breakpoint):
    """A requested event is reached."""

    place = "waitpoint::kernel::debugger_stop"

    def __init__(self):
        super().__init__(self.place, internal=True)
        self.silent = True


class CheckpointDue(gdb.Breakpoint):
    """The next checkpoint is due; the process then continues."""

    place = "waitpoint::kernel::debugger_checkpoint"

    def __init__(self):
        super().__init__(self.place, internal=True)
        self.silent = True

    def stop(self):
        checkpoints.make(events())
        return False


request = Request()
replaying = False  # suppresses reports of stops in between
breakpoints = {}


def events():
    """The number of events seen in this process, in all runs."""
    return records.view().number("events")


def watch():
    """Makes the kernel show its events to gdb from now on."""
    view = records.view()
    if view.number("watching"):
        return
    records.write_view("watching", 1)
    if run := view.number("scheduler"):
        inferior = gdb.selected_inferior()
        inferior.write_memory(run + records.place("Scheduler", "watching.is_on")[0], b"\1")
        # As set_watch(): the running task passes its waitpoints by the fast path until told otherwise.
        inferior.write_memory(records.address_of("turn") + records.place("Turn", "fast_epoch")[0], b"\xff" * 8)
    records.write_view("checkpoint_at", view.number("events") + 1 if checkpoints.wanted() else NEVER)
    request.write()


def is_process():
    """True for a live process, not for a core file or no program."""
    inferior = gdb.selected_inferior()
    return bool(inferior.pid and inferior.connection is not None and inferior.connection.type != "core")


def check_alive():
    if not is_process():
        raise gdb.GdbError("no process is being run: run or start it first")
    checkpoints.adopt_current(events())


def at_an_event():
    """True if the process is at the beginning of the event that was executed last."""
    return gdb.newest_frame().name() in (EventReached.place, CheckpointDue.place)


def describe_event():
    """The current event, in words."""
    scheduler = records.scheduler()
    where = f"event {records.events_of(scheduler)} at {records.seconds(scheduler.number('agenda.now.ns_'))} s"
    if not (task := fibers.running(scheduler)):
        return where
    at = task.number("at")
    thing = f" {fibers.Object(at).describe()}" if at and last("object") else ""
    return f"{where}: {task.describe()}: {operation()}{thing}"


def operation():
    """The operation of the event that was executed last."""
    return records.enumerators("Operation")[last("operation")]


def last(member):
    return records.view().number(f"last.{member}")


def tell():
    print(describe_event())
    if selection.select_users_frame():
        gdb.execute("frame")
    elif operation() == "start":
        print("its function has not begun: use a breakpoint in it, or next-event")
    elif operation() == "end":
        print("its function has returned")
    else:
        gdb.execute("frame")


def on_stop(event):
    if replaying or not isinstance(event, gdb.BreakpointEvent) or breakpoints.get("stop") not in event.breakpoints:
        return
    now = last("time.ns_")
    request.times = [time for time in request.times if time > now]
    request.event = request.task = 0
    request.write()
    tell()


def go_on():
    """Continues until a stop; writes the request before, and clears it after."""
    request.write()
    try:
        gdb.execute("continue")
    finally:
        request.event = request.task = 0
        if is_process() and not gdb.selected_thread().is_running():
            request.write()


def on_new_process(_=None):
    """A process is started, or another program is loaded."""
    if "run" in breakpoints:
        breakpoints["run"].enabled = True


def on_exit(_):
    selection.parked.context = 0
    checkpoints.forget()
    on_new_process()


def on_new_program(_):
    records.forget()
    on_new_process()


def register():
    if breakpoints:
        return
    pending = gdb.parameter("breakpoint pending")
    gdb.execute("set breakpoint pending on")
    try:
        breakpoints.update(run=RunBegins(), stop=EventReached(), checkpoint=CheckpointDue())
        checkpoints.register()
    finally:
        gdb.execute(f"set breakpoint pending {'auto' if pending is None else 'on' if pending else 'off'}")
    gdb.events.stop.connect(on_stop)
    gdb.events.exited.connect(on_exit)
    gdb.events.new_objfile.connect(on_new_program)
