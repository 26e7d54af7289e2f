# SPDX-License-Identifier: BSD-3-Clause
"""The tasks of the run as fibers, numbered from 1 in the order of their making, and what each one waits for, in the words
of the reports (fibers/sync/report/blocked_report.cpp)."""

import gdb

from . import records

HOLDERS_SHOWN = 4
# Location of the entries of each part of the event list: see event.hpp and event_list.hpp.
PARTS = {0: "agenda.events.heap_.entries_", 1: "agenda.events.run_", 2: "agenda.events.calendar_.chunks_"}
RUN = 1  # in this part a node may have moved up since its recorded place
CALENDAR = 2  # this part has chunks: see Calendar::entry_at()
READY = 0xFFFFFFFE  # the place of an event due now: see ready_set.hpp and present_queue.hpp


class Task(records.Record):
    def __init__(self, address):
        super().__init__("Task", address)
        self.name_given = self.text("name")

    @property
    def made(self):
        """The task's number."""
        return self.number("number") + 1

    @property
    def robot(self):
        return robot_name(self.number("robot"))

    @property
    def module(self):
        """Tasks of a module are named MODULE.TASK."""
        return self.name_given.rpartition(".")[0]

    @property
    def context(self):
        """The saved context of the parked fiber; 0 for the fiber that has the processor."""
        return self.number("fiber.context")

    @property
    def state(self):
        return records.enumerators("TaskState")[self.number("state")]

    @property
    def operation(self):
        return records.enumerators("Operation")[self.number("operation")]

    def describe(self):
        return f"{self.name_given} of {self.robot}"


def robot_name(address):
    return records.Record("Robot", address).text("name") if address else ""


class Object(records.Record):
    def __init__(self, address):
        super().__init__("Object", address)
        self.kind, self.label = records.text_at(self.number("kind")), records.text_at(self.number("label"))

    def describe(self):
        label = f' "{self.label}"' if self.label else ""
        return f"{self.kind} #{self.number('number')}{label}"

    def holders(self):
        """The holders, in words; empty if there are none."""
        owner = self.number("owner")
        if owner:
            return ("of " if self.kind == "end of thread" else "held by ") + Task(owner).describe()
        count, first = self.number("holder_count"), self.number("holders")
        if not count:
            return ""
        shown = min(count, HOLDERS_SHOWN)
        words = records.memory(first, 8 * shown)
        names = [Task(int.from_bytes(words[at : at + 8], "little")).describe() for at in range(0, 8 * shown, 8)]
        return "shared by " + ", ".join(names) + (f" and {count - shown} more" if count > shown else "")

    def waiters(self):
        """The waiting tasks, in order of arrival."""
        address = self.number("first_waiter")
        while address:
            task = Task(address)
            yield task
            address = task.number("next_waiter")


def all_tasks(scheduler=None):
    address = (scheduler or records.scheduler()).number("roster.first_task_")
    tasks = []
    while address:
        tasks.append(Task(address))
        address = tasks[-1].number("next")
    return tasks


def running(scheduler=None):
    """The task whose code is executing, or None."""
    return next((task for task in all_tasks(scheduler) if task.state == "running"), None)


def due(task, scheduler):
    """The time of the event of a task that is not running."""
    location = task.number("event.place")
    if location == READY:
        return scheduler.number("agenda.now.ns_")
    if location >> 30 not in PARTS:
        return records.NO_TIME
    part, index = location >> 30, location & (2**30 - 1)
    entry, size = scheduler.number(PARTS[part]), records.record_type("EventEntry").sizeof
    if part == CALENDAR:
        index_bits = records.constant("kernel::Calendar", "chunk_index_bits")
        entry += (index >> index_bits) * records.record_type("Calendar::Chunk").sizeof
        index &= 2**index_bits - 1
    entry += index * size
    if part == RUN:
        offset, width, _ = records.place("EventEntry", "node")
        while int.from_bytes(records.memory(entry + offset, width), "little") != task.address:
            entry += size
    offset, width, _ = records.place("EventEntry", "key.time.ns_")
    return int.from_bytes(records.memory(entry + offset, width), "little")


def waits_for(task, scheduler):
    """The reason why a task is not running, in words."""
    blocked_on = task.number("blocked_on")
    if blocked_on:
        thing = Object(blocked_on)
        holders = thing.holders()
        text = f"{task.operation} {thing.describe()}"
        if holders:
            text += (" " if holders.startswith("of ") else ", ") + holders
        if task.number("finite_wait"):
            text += f", until {records.seconds(due(task, scheduler))} s"
        return text
    if task.operation == "sleep":
        return f"sleep until {records.seconds(task.number('local_time.ns_'))} s"
    at = task.number("at")
    return f"its turn: {task.operation}" + (f" {Object(at).describe()}" if at else "")


def is_called(task, word):
    return word in (str(task.made), task.name_given, f"{task.robot}/{task.name_given}")


def find(word):
    """The fiber with this number, NAME, or ROBOT/NAME."""
    fitting = [task for task in all_tasks() if is_called(task, word)]
    if not fitting:
        raise gdb.GdbError(f"there is no fiber '{word}'; info fibers lists them all")
    if len(fitting) > 1:
        numbers = ", ".join(str(task.made) for task in fitting)
        raise gdb.GdbError(f"fibers {numbers} are called '{word}': use ROBOT/NAME, or the number")
    return fitting[0]
