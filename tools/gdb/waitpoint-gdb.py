# SPDX-License-Identifier: BSD-3-Clause
"""gdb commands for the fibers of waitpoint: `source .../waitpoint-gdb.py`, for gdb 12 or later with Python.

The commands are in the files of waitpoint_gdb/, beside this one; `help waitpoint` lists them.
"""

import os
import sys

folder = os.path.dirname(os.path.realpath(__file__))
writes_bytecode = sys.dont_write_bytecode
sys.path.insert(0, folder)
sys.dont_write_bytecode = True  # leaves no files in the tree or in a system folder
try:
    import waitpoint_gdb

    waitpoint_gdb.register()
finally:
    sys.path.remove(folder)
    sys.dont_write_bytecode = writes_bytecode
