# SPDX-License-Identifier: BSD-3-Clause
"""Selection of a parked fiber: shows its frames, and writes nothing to the process.

While a fiber is selected, an unwinder presents the fiber's frame as the caller of the innermost frame, with the registers
that the fiber's switch saved on its stack; no others are needed. So frame 0 remains the processor's, and the frames above
it are the fiber's. A filter hides frame 0 from back traces.

    fibers/switch/departure.hpp, x86-64, at the context c:  +40 rbx  +48 rbp  +56 rip;  rsp = c + 64
    Boost.Context, 64-bit ARM:  +64 x19 to x28  +144 x29  +152 x30  +160 pc;  sp = c + 176
"""

import re

import gdb
import gdb.unwinder

from . import records


class Layout:
    """Where a switch saves registers, from the context on, and the names of those that locate a frame."""

    def __init__(self, pc, sp, saved, size):
        self.pc, self.sp, self.saved, self.size = pc, sp, saved, size


LAYOUTS = {
    "i386:x86-64": Layout("rip", "rsp", {"rbx": 40, "rbp": 48, "rip": 56}, 64),
    "aarch64": Layout("pc", "sp", {**{f"x{number}": 64 + 8 * (number - 19) for number in range(19, 31)}, "pc": 160}, 176),
}
# Frames of the primitives and of the library's templates beneath them: not of interest to users.
INNER = re.compile(r"(?<!/tests)/fibers/(switch|kernel|clocks|sync|io|laas|posix)/|/include/c\+\+/")


def own_layout():
    """That of the process's architecture."""
    layout = LAYOUTS.get(gdb.selected_inferior().architecture().name())
    if layout is None:
        raise gdb.GdbError("the registers of a parked fiber are known for x86-64 and 64-bit ARM only")
    return layout


class FrameId:
    def __init__(self, sp, pc):
        self.sp, self.pc = sp, pc


class ParkedFiber(gdb.unwinder.Unwinder):
    """The selected fiber, if it is parked."""

    def __init__(self):
        super().__init__("waitpoint-fiber")
        self.context = 0

    def select(self, context):
        layout = own_layout()
        frame = gdb.newest_frame()
        self.layout, self.pc, self.sp = layout, frame.pc(), int(frame.read_register(layout.sp))
        self.context = 0
        gdb.invalidate_cached_frames()
        self.context = context
        gdb.invalidate_cached_frames()

    def deselect(self):
        if self.context:
            self.context = 0
            gdb.invalidate_cached_frames()

    def resumes_at(self):
        return int.from_bytes(records.memory(self.context + self.layout.saved[self.layout.pc], 8), "little")

    def __call__(self, pending):
        if not self.context:
            return None
        layout = self.layout
        pc, sp = int(pending.read_register(layout.pc)), int(pending.read_register(layout.sp))
        if (pc, sp) != (self.pc, self.sp):
            return None
        # A stack address just below the fiber's: gdb requires callers to be higher.
        unwound = pending.create_unwind_info(FrameId(gdb.Value(self.context - 16), gdb.Value(pc)))
        saved = records.memory(self.context, layout.size)
        for register, offset in layout.saved.items():
            value = int.from_bytes(saved[offset : offset + 8], "little")
            unwound.add_saved_register(register, typed(value, register))
        unwound.add_saved_register(layout.sp, typed(self.context + layout.size, layout.sp))
        return unwound


def typed(value, register):
    kind = "unsigned long" if register not in ("rip", "rsp", "rbp", "pc", "sp") else "char"
    kind = gdb.lookup_type(kind)
    return gdb.Value(value).cast(kind if kind.sizeof == 8 else kind.pointer())


def is_inner(frame):
    """True for frames of the kernel or a primitive, or of their internals, which have no source here."""
    table = frame.find_sal().symtab
    return table is None or bool(INNER.search(table.fullname()))


class FibersFrames:
    """A frame filter: of a selected fiber, only its own frames; of many fibers, only frames from the innermost one outside
    the primitives, so that `fiber apply all bt 3` shows the program's code."""

    name, priority, enabled = "waitpoint-fiber", 1000, True
    of_many = False

    def filter(self, frames):
        begun, first, inner = not parked.context, parked.context and parked.resumes_at(), []
        for frame in frames:
            begun = begun or (frame.inferior_frame().pc() == first and frame.inferior_frame().level() > 0)
            if not begun:
                continue
            if self.of_many and inner is not None and is_inner(frame.inferior_frame()):
                inner.append(frame)
                continue
            inner = None  # only the innermost ones are left out
            yield frame
        yield from inner or []  # if there are no others


parked = ParkedFiber()
shown = FibersFrames()
calling = False  # gdb calls a function of the process for an expression: the fiber remains selected


def innermost():
    """The innermost frame of the selected fiber or of the processor."""
    frame = gdb.newest_frame()
    if parked.context:
        first = parked.resumes_at()
        frame = frame.older()
        while frame is not None and frame.pc() != first:
            frame = frame.older()
    if frame is None:
        raise gdb.GdbError("the fiber's frames cannot be found: is its stack damaged?")
    return frame


def select_users_frame():
    """Selects the innermost frame outside the primitives (returns True), or the innermost of all (False)."""
    frame = first = innermost()
    while frame is not None:
        if not is_inner(frame):
            break
        frame = frame.older()
    (frame or first).select()
    return frame is not None


def select(task):
    """Selects `task` until another selection or until the process continues."""
    if task.context:
        parked.select(task.context)
    else:  # it has the processor
        parked.deselect()
    select_users_frame()


def on_continue(_):
    if not calling:
        parked.deselect()


def on_call(event):
    global calling
    calling = isinstance(event, gdb.InferiorCallPreEvent)


def register():
    gdb.unwinder.register_unwinder(None, parked, replace=True)
    gdb.frame_filters[shown.name] = shown
    gdb.events.cont.connect(on_continue)
    gdb.events.inferior_call.connect(on_call)
