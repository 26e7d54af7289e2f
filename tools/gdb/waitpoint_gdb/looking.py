# SPDX-License-Identifier: BSD-3-Clause
"""Commands that only read; they work on core files, too."""

import re

import gdb

from . import fibers, processes, records, selection


def header(task, scheduler):
    waiting = "" if task.state == "running" else f": {fibers.waits_for(task, scheduler)}"
    return f"Fiber {task.made}, {task.describe()}, at {records.seconds(task.number('local_time.ns_'))} s, {task.state}{waiting}"


class Waitpoint(gdb.Command):
    """Commands for programs whose threads are simulated by waitpoint.

    info fibers            list the tasks of the run, with their virtual times and reasons to wait
    fiber N|NAME           select a parked task for bt, up, info locals, print
    fiber apply all bt     apply a command to all fibers, or to some: fiber apply 1 3 bt
    process N              make another process of the program the present one
    virtual-time           show the time of the current event
    blocked-on OBJECT      list the waiters and holders of an object
    next-event [N]         continue to the next event of any task
    next-event-of FIBER    continue to the next event of a task
    break-time T           stop at the first event at or after a virtual time
    back [N]               go back to the previous event
    """

    def __init__(self):
        super().__init__("waitpoint", gdb.COMMAND_USER)

    def invoke(self, argument, from_tty):
        gdb.execute("help waitpoint")


TITLES = ("No", "Name", "Robot", "Module", "Local time", "State", "Waits for")


def row(task, state, waiting):
    return (str(task.made), task.name_given, task.robot, task.module or "-", records.seconds(task.number("local_time.ns_")), state,
            waiting)


def rows_of_processes(all_processes):
    yield ("", "Process", *TITLES)
    for process in all_processes:
        begin = ("*" if process.has_turn else "", str(process.id))
        if process.is_native or process.is_stopped:
            yield (*begin, "-", "-", process.name, "-", "-", "native" if process.is_native else "stopped", "")
            continue
        for task, state, waiting in process.tasks():
            if state == "running" and not process.has_turn:
                state, waiting = "ready", "its process's turn"
            yield (*begin, *row(task, state, waiting))


class InfoFibers(gdb.Command):
    """List the tasks of the run: number, name, robot, module, local virtual time in seconds, state, reason to wait.

    Tasks are numbered in order of creation. A star marks the running one. Of several processes under `waitpoint exec`, the
    tasks of all are listed, with their process's number first; a star marks the process that has the turn."""

    def __init__(self):
        super().__init__("info fibers", gdb.COMMAND_STATUS)

    def invoke(self, argument, from_tty):
        scheduler = records.scheduler()
        if several := processes.all_processes():
            rows = list(rows_of_processes(several))
        else:
            described = processes.described(scheduler.address)
            rows = [("", *TITLES), *(("*" if task[1] == "running" else "", *row(*task)) for task in described)]
        widths = [max(map(len, column)) for column in zip(*rows)]
        print("\n".join("  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() for row in rows))


class Fiber(gdb.Command):
    """fiber N|NAME|ROBOT/NAME: select a parked task, until another selection or until the process continues.

    bt, up, down, info locals and print then apply to it. Nothing is written to the process. Frame 0 remains the processor's;
    the innermost frame outside the primitives is selected. Without an argument: show the selected fiber.

    fiber apply all COMMAND, or fiber apply N|NAME ... COMMAND: run the command in each fiber, after a line with
    its name."""

    def __init__(self):  # no prefix: gdb would complete a task's name to `apply`
        super().__init__("fiber", gdb.COMMAND_STACK)

    def invoke(self, argument, from_tty):
        word = argument.strip()
        if word.split()[:1] == ["apply"]:
            return apply(word.split()[1:])
        if word:
            task = fibers.find(word)
            selection.select(task)
        else:
            task = selected()
        print(header(task, records.scheduler()))
        gdb.execute("frame")


def selected():
    """The selected fiber, or the one that has the processor."""
    context = selection.parked.context
    for task in fibers.all_tasks():
        if task.context == context:
            return task
    raise gdb.GdbError("no fiber is selected: the process is on its main stack")


def apply(words):
    if words[:1] == ["all"]:
        chosen, words = fibers.all_tasks(), words[1:]
    else:
        chosen, tasks = [], fibers.all_tasks()
        while words and (words[0].isdigit() or any(fibers.is_called(task, words[0]) for task in tasks)):
            chosen.append(fibers.find(words.pop(0)))
    if not chosen or not words:
        raise gdb.GdbError("expected: fiber apply all|N ... COMMAND")
    scheduler, before, level = records.scheduler(), selection.parked.context, gdb.selected_frame().level()
    try:
        selection.shown.of_many = True
        for task in chosen:
            selection.select(task)
            print(f"\n{header(task, scheduler)}")
            gdb.execute(" ".join(words))
    except gdb.error as error:
        raise gdb.GdbError(str(error))
    finally:
        selection.shown.of_many = False
        selection.parked.select(before) if before else selection.parked.deselect()
        frame = gdb.newest_frame()
        while frame.level() < level and frame.older() is not None:
            frame = frame.older()
        frame.select()


class VirtualTime(gdb.Command):
    """Show the virtual time of the current event, the number of events so far, and the running task's local time."""

    def __init__(self):
        super().__init__("virtual-time", gdb.COMMAND_STATUS)

    def invoke(self, argument, from_tty):
        scheduler = records.scheduler()
        text = f"{records.seconds(scheduler.number('agenda.now.ns_'))} s, event {records.events_of(scheduler)}"
        if task := fibers.running(scheduler):
            text += f"; {task.describe()} is at {records.seconds(task.number('local_time.ns_'))} s"
        print(text)


class BlockedOn(gdb.Command):
    """blocked-on OBJECT: list its waiters and holders.

    OBJECT is a number as in reports (3 or #3, of every robot), a kind and number ("mutex #3"), a label, or an expression of
    the program with an address, such as *this or workshop.door."""

    def __init__(self):
        super().__init__("blocked-on", gdb.COMMAND_STATUS)

    def invoke(self, argument, from_tty):
        word = argument.strip().strip('"')
        if not word:
            raise gdb.GdbError("expected: blocked-on NUMBER|LABEL|EXPRESSION")
        fitting = [thing for thing in self.known() if self.names(thing, word)] or self.meant_by(word)
        if not fitting:
            raise gdb.GdbError(f"no task waits for, uses or holds an object '{word}'")
        for thing in fitting:
            print(f"{thing.describe()} of {fibers.robot_name(thing.number('robot'))}: {thing.holders() or 'not held'}")
            waiters = list(thing.waiters())
            for task in waiters:
                print(f"  {task.describe()} waits since {records.seconds(task.number('local_time.ns_'))} s ({task.operation})")
            if not waiters:
                print("  no waiters")

    @staticmethod
    def known():
        """All objects that a task waits for, holds, or is about to use."""
        found = {}
        for task in fibers.all_tasks():
            paths = ["blocked_on", "held"] + (["at"] if task.state == "ready" else [])
            found.update({address: None for path in paths if (address := task.number(path))})
        return [fibers.Object(address) for address in found]

    @staticmethod
    def names(thing, word):
        number = thing.number("number")
        return word in (thing.label, str(number), f"#{number}") or re.sub(r"\s*#", " #", word) == f"{thing.kind} #{number}"

    @staticmethod
    def meant_by(expression):
        """The objects in the value of an expression: a mutex, or a value with one among its members."""
        try:
            value = gdb.parse_and_eval(expression)
            if value.type.strip_typedefs().code in (gdb.TYPE_CODE_REF, gdb.TYPE_CODE_PTR):
                value = value.referenced_value()
            return [fibers.Object(int(found.address)) for found in objects_in(value)]
        except (gdb.error, TypeError):
            return []


def objects_in(value, depth=5):
    kind = value.type.strip_typedefs()
    if str(kind) == records.NAMESPACE + "Object":
        yield value
    elif depth and kind.code == gdb.TYPE_CODE_STRUCT:
        for field in kind.fields():
            if hasattr(field, "bitpos"):  # not static
                yield from objects_in(value[field], depth - 1)


def register():
    for command in (Waitpoint, InfoFibers, Fiber, VirtualTime, BlockedOn):
        command()
