# SPDX-License-Identifier: BSD-3-Clause
"""Commands that step in virtual time."""

import decimal
import re

import gdb

from . import fibers, records, watching

UNITS = {"": 9, "s": 9, "ms": 6, "us": 3, "ns": 0}


def nanoseconds(text):
    match = re.fullmatch(r"(\d+\.?\d*|\.\d+) ?(s|ms|us|ns|)", text.strip())
    if not match:
        raise gdb.GdbError(f"expected a time such as 12.5, 12.5s, 300ms, 20us or 1000ns, found '{text.strip()}'")
    return int((decimal.Decimal(match[1]) * 10 ** UNITS[match[2]]).to_integral_value(decimal.ROUND_CEILING))


def count(argument, command):
    if not re.fullmatch(r"\s*([1-9]\d*)?\s*", argument):
        raise gdb.GdbError(f"expected: {command} [N], a number of events from 1, found '{argument.strip()}'")
    return int(argument or 1)


class NextEvent(gdb.Command):
    """next-event [N]: continue to the next, or N-th next, event of any task, unless a breakpoint comes first.

    Stops at the beginning of the event: virtual time is already the event's."""

    def __init__(self):
        super().__init__("next-event", gdb.COMMAND_RUNNING)

    def invoke(self, argument, from_tty):
        events = count(argument, "next-event")
        watching.check_alive()
        watching.watch()
        watching.request.event = watching.events() + events
        watching.go_on()


class NextEventOf(gdb.Command):
    """next-event-of FIBER: continue to the next event of a task, given by its number, NAME or ROBOT/NAME."""

    def __init__(self):
        super().__init__("next-event-of", gdb.COMMAND_RUNNING)

    def invoke(self, argument, from_tty):
        if not argument.strip():
            raise gdb.GdbError("expected: next-event-of N|NAME|ROBOT/NAME")
        watching.check_alive()
        watching.watch()
        watching.request.task = fibers.find(argument.strip()).number("id")
        watching.go_on()


class BreakTime(gdb.Command):
    """break-time T: stop once, at the first event at or after virtual time T, in seconds or with a unit.

    Follow with run or continue. Without an argument: list the times set. break-time off: clear them."""

    def __init__(self):
        super().__init__("break-time", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, argument, from_tty):
        request = watching.request
        if argument.strip() == "off":
            request.times = []
        elif argument.strip():
            self.add(nanoseconds(argument))
        if watching.is_process() and records.view().number("scheduler"):
            watching.watch()
            request.write()
        for time in request.times:
            print(f"stop at the first event at or after {records.seconds(time)} s")
        if not request.times:
            print("no stop at a time is set")

    @staticmethod
    def add(time):
        if watching.is_process() and (run := records.view().follow("scheduler", "Scheduler")):
            if time <= (now := run.number("agenda.now.ns_")) and records.events_of(run):
                raise gdb.GdbError(f"it is {records.seconds(now)} s already; `back` goes back")
        watching.request.times = sorted({*watching.request.times, time})


def register():
    for command in (NextEvent, NextEventOf, BreakTime):
        command()
