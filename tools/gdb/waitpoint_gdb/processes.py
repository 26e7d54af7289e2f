# SPDX-License-Identifier: BSD-3-Clause
"""The processes of a program under `waitpoint exec`: they are one simulation, and one of them has the turn. gdb sees the
present one; of the others, the records of their tasks are read from their memory.

The table of the processes (fibers/posix/family/family.hpp) is in memory that all share, and the run's record
(fibers/posix/program/record.hpp) is at one address in each, in its own memory.
"""

import gdb

from . import fibers, records, selection

FAMILY, PROCESS = "waitpoint::posix::family::Family", "waitpoint::posix::family::Process"
ALIVE, STOPPED = 1, 2  # of Process::State


class Process:
    def __init__(self, record, is_present, has_turn):
        self.id, self.system_id = record.number("id"), record.number("real_id")
        self.name, self.is_present, self.has_turn = record.text("name"), is_present, has_turn
        self.is_native, self.is_stopped = bool(record.number("is_native")), record.number("state") == STOPPED

    def tasks(self):
        """Its tasks, each with the scheduler; empty if its memory cannot be read."""
        scheduler = scheduler_address()
        if self.is_present:
            yield from described(scheduler)
            return
        try:
            with records.of_process(self.system_id):
                yield from described(scheduler)
        except OSError:
            return


def described(address):
    """(task, state, what it waits for)."""
    scheduler = records.Record("Scheduler", address)
    for task in fibers.all_tasks(scheduler):
        state = task.state
        yield task, state, "" if state == "running" else fibers.waits_for(task, scheduler)


def value_of(expression):
    try:
        return int(gdb.parse_and_eval(expression))
    except gdb.error:
        return 0


def scheduler_address():
    """The same in every process."""
    return value_of("(unsigned long)&'waitpoint::posix::record'->scheduler_memory")


def own_entry():
    """The address of the present process's entry in the table; 0 if the program is not run by `waitpoint exec`."""
    return value_of("(unsigned long)'waitpoint::posix::family::own'")


def all_processes():
    """Those that have not ended; empty if the program is no family, or its only process is the present one."""
    family = value_of("(unsigned long)'waitpoint::posix::family::family'")
    if not family:
        return []
    table = family + records.place(FAMILY, "processes")[0]
    size, own = records.record_type(PROCESS).sizeof, own_entry()
    count, holder = (records.number_at(family, FAMILY, member) for member in ("entries", "holder"))
    found = []
    for i in range(count):
        record = records.Record(PROCESS, table + i * size)
        if record.number("state") in (ALIVE, STOPPED):
            found.append(Process(record, record.address == own, i == holder))
    return found if len(found) > 1 else []


class SelectProcess(gdb.Command):
    """process N: makes process N of the program, by its number in info fibers, the one that gdb sees.

    gdb attaches to it as a further inferior; its breakpoints then stop it, too, and continue resumes all processes. detach
    leaves it. Without an argument: shows the present process."""

    def __init__(self):
        super().__init__("process", gdb.COMMAND_STACK)

    def invoke(self, argument, from_tty):
        leave_ended()
        word, found = argument.strip(), all_processes()
        fitting = [process for process in found if (str(process.id) == word if word else process.is_present)]
        if not fitting:
            raise gdb.GdbError(f"there is no process '{word}'; info fibers lists them" if found and word else
                               "the program has no other process")
        if fitting[0].is_native:
            raise gdb.GdbError(f"process {word} executes a program that is not simulated")
        if not fitting[0].is_present:
            select(fitting[0])
        print(f"process {fitting[0].id}, {fitting[0].name}, {fitting[0].system_id} in the system")


def leave_ended():
    """Makes a process the present one if the one before has ended."""
    if gdb.selected_inferior().pid:
        return
    for inferior in gdb.inferiors():
        if inferior.pid:
            return gdb.execute(f"inferior {inferior.num}", to_string=True)


def select(process):
    selection.parked.deselect()
    for inferior in gdb.inferiors():
        if inferior.pid == process.system_id:
            return gdb.execute(f"inferior {inferior.num}", to_string=True)
    before = gdb.selected_inferior().num
    gdb.execute("add-inferior", to_string=True)
    made = max(inferior.num for inferior in gdb.inferiors())
    gdb.execute(f"inferior {made}", to_string=True)
    try:
        gdb.execute(f"attach {process.system_id}", to_string=True)
        gdb.execute("set schedule-multiple on")
    except gdb.error:
        gdb.execute(f"inferior {before}", to_string=True)
        gdb.execute(f"remove-inferiors {made}", to_string=True)
        raise gdb.GdbError(f"process {process.id} cannot be attached to") from None


def register():
    SelectProcess()
