# SPDX-License-Identifier: BSD-3-Clause
"""Prints the part of a variable at an offset, for waitpoint's reports, a line each: the words before this file is read.

    gdb -batch -ex "python parts = [('account', 8)]" -x variable-fields.py PROGRAM

prints `account.balance`; the name alone if its type is unknown.
"""

import gdb


def field_at(kind, offset):
    for field in kind.fields():
        # Static members have no place.
        if hasattr(field, "bitpos") and 0 <= offset - field.bitpos // 8 < field.type.sizeof:
            return field
    return None


def part_of(name, offset):
    symbol = gdb.lookup_global_symbol(name) or gdb.lookup_static_symbol(name)
    if symbol is None:
        return None
    text, kind = name, symbol.type.strip_typedefs()
    while True:
        if kind.code == gdb.TYPE_CODE_ARRAY and kind.target().sizeof > 0:
            kind = kind.target().strip_typedefs()
            text += f"[{offset // kind.sizeof}]"
            offset %= kind.sizeof
        elif kind.code == gdb.TYPE_CODE_STRUCT and (field := field_at(kind, offset)) is not None:
            # Of the C++ library: std::atomic<int> is one variable.
            if not field.is_base_class and (field.name or "").startswith("_"):
                return text
            if not field.is_base_class and field.name:
                text += "." + field.name
            offset -= field.bitpos // 8
            kind = field.type.strip_typedefs()
        else:
            return text


for name, offset in parts:  # noqa: F821
    try:
        print(part_of(name, offset) or "")
    except (gdb.error, RuntimeError):
        print()
