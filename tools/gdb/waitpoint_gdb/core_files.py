# SPDX-License-Identifier: BSD-3-Clause
"""Core files by `generate-core-file` (gcore): small, and with the stacks in them.

The stacks' arena (fibers/switch/stack_arena.hpp) spans gigabytes of addresses, mostly unused: gdb 13 would write all of it.
And gdb skips a whole region at an unreadable page, such as a light guard page (Linux 6.13). So while the file is written,
unused parts of the arena are marked as not to be dumped, and the guards are removed. Core files written by Linux need none
of this.
"""

import gdb

from . import records, watching

# Advice values of madvise, fixed by x86-64 Linux's ABI.
DONT_DUMP, DO_DUMP, INSTALL_GUARD, REMOVE_GUARD = 16, 17, 102, 103
STACK_SIZES = (16384, 65536, 262144)
PAGE = 4096

lifted = []  # to undo: (address, size, advice)


def advise(address, size, advice):
    """True if the kernel accepted it; preserves errno."""
    gdb.execute("set $waitpoint_errno = *((int *(*)(void))__errno_location)()", to_string=True)
    call = f"((int (*)(unsigned long, unsigned long, int))madvise)({address}, {size}, {advice})"
    done = int(gdb.parse_and_eval(call)) == 0
    gdb.execute("set var *((int *(*)(void))__errno_location)() = $waitpoint_errno", to_string=True)
    return done


def ranges(scheduler):
    """(base, bytes per slot, slots opened, slots with a guard, total slots) for each stack size."""
    offset, size, _ = records.place("Scheduler", "arena.ranges_")
    width = records.record_type("StackArena::Range").sizeof
    for at, slot in zip(range(0, size, width), STACK_SIZES):
        one = records.Record("StackArena::Range", scheduler.address + offset + at)
        opened = one.number("opened")
        yield one.number("base"), slot, opened, min(opened, one.number("unguarded_from")), one.number("slots")


def before_dump():
    if not watching.is_process() or not records.view().number("scheduler"):
        return
    for base, slot, opened, guarded, slots in ranges(records.scheduler()):
        unused = base + opened * slot, (slots - opened) * slot
        if base and advise(*unused, DONT_DUMP):
            lifted.append((*unused, DO_DUMP))
        if guarded and advise(base, guarded * slot, REMOVE_GUARD):
            lifted.extend((base + number * slot, PAGE, INSTALL_GUARD) for number in range(guarded))


def after_dump():
    while lifted:
        advise(*lifted.pop())


def register():
    for when, function in (("hook", "before_dump"), ("hookpost", "after_dump")):
        gdb.execute(f"define {when}-generate-core-file\npython waitpoint_gdb.core_files.{function}()\nend")
    gdb.execute("python import waitpoint_gdb.core_files")
