# SPDX-License-Identifier: BSD-3-Clause
"""What gdb needs to see fibers as it sees threads, to step from event to event, and to step back."""

from . import back, core_files, looking, processes, registers, selection, stepping, watching


def register():
    """Registers the commands, the unwinder and the breakpoints of this package; may be repeated."""
    registers.register()
    selection.register()
    watching.register()
    looking.register()
    processes.register()
    stepping.register()
    back.register()
    core_files.register()
