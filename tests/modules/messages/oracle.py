#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the test of the messages compares them with: oracle.py MESSAGES_FOLDER ROS_INCLUDE_FOLDER IDL HEADER.

The types are those that the headers of MESSAGES_FOLDER declare and ROS's generated headers have. Their fields are taken from the
definitions in ROS's headers, not from ours: as types of ROS 2 in IDL, and as functions that copy a value, field by field and by name,
to ROS's struct and to the struct that idlc makes of the IDL."""

import pathlib
import re
import sys

IDL_TYPES = {"bool": "boolean", "byte": "octet", "int8": "octet", "uint8": "octet", "int16": "short", "uint16": "unsigned short",
             "int32": "long", "uint32": "unsigned long", "int64": "long long", "uint64": "unsigned long long", "float32": "float",
             "float64": "double", "string": "string", "time": "builtin_interfaces::msg::Time",
             "duration": "builtin_interfaces::msg::Duration"}
BUILTIN = """module builtin_interfaces { module msg {
  @final struct Time { long sec; unsigned long nanosec; };
  @final struct Duration { long sec; unsigned long nanosec; };
}; };
"""


def definition(header):
    """The .msg text of a generated header, without those of the types within."""
    text = header.read_text()
    text = text[text.index("struct Definition<"):]
    text = text[text.index("return"):text.index("static const char* value(const")]
    whole = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', text)).encode().decode("unicode_escape")
    return whole.split("=" * 80)[0]


def fields(package, text):
    """(type, list or array in brackets, name) of each field; types of messages are PACKAGE/NAME."""
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if len(words) != 2 or "=" in words[1]:
            continue
        kind, brackets = re.fullmatch(r"([\w/]+)(\[\d*\])?", words[0]).groups()
        if kind not in IDL_TYPES and "/" not in kind:
            kind = "std_msgs/Header" if kind == "Header" else f"{package}/{kind}"
        yield kind, brackets or "", words[1]


def collect(full_name, include, types):
    """Adds the type to `types`, after those within it."""
    package, name = full_name.split("/")
    found = list(fields(package, definition(include / package / (name + ".h"))))
    for kind, _, _ in found:
        if "/" in kind and kind not in types:
            collect(kind, include, types)
    types[full_name] = found


def idl_of(full_name, members):
    package, name = full_name.split("/")
    lines = [f"module {package} {{ module msg {{ @final struct {name}_ {{"]  # as in ROS 2: a field may have the name of its struct
    for kind, brackets, member in members:
        if full_name == "std_msgs/Header" and member == "seq":  # ROS 2 has none
            continue
        written = IDL_TYPES[kind] if kind in IDL_TYPES else "::msg::".join(kind.split("/")) + "_"
        # The underscore is not of the name: it may be a keyword of IDL.
        lines.append(f"  sequence<{written}> _{member};" if brackets == "[]" else f"  {written} _{member}{brackets};")
    return "\n".join(lines) + "\n}; }; };\n"


def copies_of(full_name, members):
    package, name = full_name.split("/")
    for target, left_out in ((f"::{package}::{name}_<RosAllocator>", ()),
                             (f"::{package}_msg_{name}_", ("seq",) if full_name == "std_msgs/Header" else ())):
        yield (f"inline void copy(Memory& memory, const messages::{package}::{name}& from, {target}& to) {{\n"
               + "".join(f"  copy(memory, from.{member}, to.{member});\n" for _, _, member in members if member not in left_out) + "}\n")


def main():
    messages, include, idl, header = map(pathlib.Path, sys.argv[1:])
    names = [name for file in sorted(messages.glob("*.hpp")) for name in re.findall(r'type_name = "(\w+/\w+)"', file.read_text())]
    types = {}
    for name in names:
        if (include / (name + ".h")).exists() and name not in types:
            collect(name, include, types)
    idl.write_text(BUILTIN + "".join(idl_of(name, members) for name, members in types.items()))
    packages = sorted({name.split("/")[0] for name in types})
    lines = [f'#include "modules/messages/{package}.hpp"' for package in packages]
    lines += [f"#include <{name}.h>" for name in types] + ['#include "tests/modules/messages/oracle_copy.hpp"',
                                                           "namespace waitpoint::oracle {\n"]
    for name, members in types.items():
        lines += copies_of(name, members)
    cases = [f"Case<messages::{package}::{name}, ::{package}::{name}_<RosAllocator>, ::{package}_msg_{name}_, "
             f"&::{package}_msg_{name}__desc>" for package, name in (full.split("/") for full in types)]
    header.write_text("\n".join(lines) + "using Cases = ::testing::Types<" + ",\n".join(cases) + ">;\n}\n")


if __name__ == "__main__":
    main()
