# SPDX-License-Identifier: BSD-3-Clause
"""Registers of processors with AMX, for a gdb that does not know them.

gdb before 14 writes extended registers as a block without AMX's tiles; Linux takes the whole block only (EFAULT: "Couldn't
write extended state status"). So no function of the program can be called, and there are no checkpoints. With a description
of the registers that ends with SSE, gdb takes the older system call for floating-point registers, which has no such limit.
AVX's registers are then neither shown nor written.
"""

import os

import gdb


def lose_registers() -> bool:
    """True if this gdb cannot write the registers of this processor."""
    if int(gdb.VERSION.split(".")[0]) >= 14:
        return False
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as processors:
        return any(line.startswith("flags") and " amx_tile" in line for line in processors)


def register():
    """To be called before the program starts."""
    if lose_registers():
        description = os.path.join(os.path.dirname(os.path.realpath(__file__)), "registers.xml")
        gdb.execute(f"set tdesc filename {description}", to_string=True)
