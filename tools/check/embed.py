# SPDX-License-Identifier: BSD-3-Clause
"""A file's bytes as a C++ array: embed.py FILE OUTPUT.cpp HEADER NAME, declared in HEADER as std::span<const unsigned char> NAME()."""

import pathlib
import sys

data = pathlib.Path(sys.argv[1]).read_bytes()
rows = ",\n".join(",".join(str(byte) for byte in data[i:i + 24]) for i in range(0, len(data), 24))
pathlib.Path(sys.argv[2]).write_text(f"""#include "{sys.argv[3]}"
std::span<const unsigned char> {sys.argv[4]}() {{
static constexpr unsigned char data[] = {{
{rows}}};
return data;
}}
""")
