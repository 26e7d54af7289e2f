# SPDX-License-Identifier: BSD-3-Clause
"""Commands that look and change nothing; they work on core files too."""

import re

import gdb

from . import fibers, records, selection


def header(task, scheduler):
    waiting = "" if task.state == "running" else f": {fibers.waits_for(task, scheduler)}"
    return f"Fiber {task.made}, {task.describe()}, at {records.seconds(task.number('local_time.ns_'))} s, {task.state}{waiting}"


class Waitpoint(gdb.Command):
    """Commands for programs whose threads are simulated by waitpoint.

    info fibers            the tasks of the run: where each is in virtual time, and what it waits for
    fiber N|NAME           look at a parked task: bt, up, info locals, print
    fiber apply all bt     a command for each of them, or for those given: fiber apply 1 3 bt
    virtual-time           the time of the event now executing
    blocked-on OBJECT      who waits for an object, and who holds it
    next-event [N]         go on to the next event, of any task
    next-event-of FIBER    go on to the next event of a task
    break-time T           stop at the first event at or after a virtual time
    back [N]               go to the event before
    """

    def __init__(self):
        super().__init__("waitpoint", gdb.COMMAND_USER)

    def invoke(self, argument, from_tty):
        gdb.execute("help waitpoint")


class InfoFibers(gdb.Command):
    """The tasks of the run: number, name, robot, module, local virtual time in seconds, state, and what they wait for.

    Numbers are given in the order in which tasks are made. The star is at the one that is running."""

    def __init__(self):
        super().__init__("info fibers", gdb.COMMAND_STATUS)

    def invoke(self, argument, from_tty):
        scheduler = records.scheduler()
        rows = [("", "No", "Name", "Robot", "Module", "Local time", "State", "Waits for")]
        for task in fibers.all_tasks(scheduler):
            state = task.state
            rows.append(("*" if state == "running" else "", str(task.made), task.name_given, task.robot, task.module or "-",
                         records.seconds(task.number("local_time.ns_")), state,
                         "" if state == "running" else fibers.waits_for(task, scheduler)))
        widths = [max(map(len, column)) for column in zip(*rows)]
        print("\n".join("  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() for row in rows))


class Fiber(gdb.Command):
    """fiber N|NAME|ROBOT/NAME: shows a task where it is parked, until another is selected or the process goes on.

    bt, up, down, info locals and print are about it then. Nothing is written to the process. Frame 0 stays what the
    processor executes; the innermost frame that is not of a primitive is selected. Without an argument: which one.

    fiber apply all COMMAND, or fiber apply N|NAME ... COMMAND: the command in each fiber, with a line that names it."""

    def __init__(self):  # no prefix: gdb would take a task's name for what is short for `apply`
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
    """The fiber selected, or of that whose stack is the processor's."""
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
    """The virtual time of the event now executing, the number of events so far, and the running task's local time."""

    def __init__(self):
        super().__init__("virtual-time", gdb.COMMAND_STATUS)

    def invoke(self, argument, from_tty):
        scheduler = records.scheduler()
        text = f"{records.seconds(scheduler.number('agenda_.now.ns_'))} s, event {records.events_of(scheduler)}"
        if task := records.running():
            task = fibers.Task(task)
            text += f"; {task.describe()} is at {records.seconds(task.number('local_time.ns_'))} s"
        print(text)


class BlockedOn(gdb.Command):
    """blocked-on OBJECT: who waits for it, and who holds it.

    OBJECT is a number as in reports (3 or #3, of every robot), a kind with one ("mutex #3"), a label, or an expression of
    the program that has an address, such as *this or workshop.door."""

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
            print(f"{thing.describe()} of {fibers.robot_name(thing.number('robot'))}: {thing.holders() or 'held by nobody'}")
            waiters = list(thing.waiters())
            for task in waiters:
                print(f"  {task.describe()} waits since {records.seconds(task.number('local_time.ns_'))} s ({task.operation})")
            if not waiters:
                print("  nobody waits for it")

    @staticmethod
    def known():
        """What some task waits for, holds, or is about to use."""
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
        """The objects in what an expression of the program is: a mutex, or what has one among its members."""
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
