# SPDX-License-Identifier: BSD-3-Clause
"""Checks the symbols of the kernel's objects: symbols.py OBJECT...

The kernel (fibers/switch, kernel, clocks) must be usable below a C library layer: no exceptions, no allocation while
running, no standard containers. What is a thread's own is in the static block of thread-local storage, so that its
address is no call.
"""

import re
import subprocess
import sys

FORBIDDEN = [
    ("throws", re.compile(r"\b__cxa_(throw|rethrow|allocate_exception|throw_bad_array_new_length)\b|std::__throw_")),
    ("allocates", re.compile(r"\boperator (new|delete)\b|\b(malloc|calloc|realloc|free|aligned_alloc|posix_memalign)$")),
    (
        "uses a standard container",
        re.compile(
            r"\bstd::(__cxx11::|__1::|__detail::|_V2::)*"
            r"(basic_string|vector|deque|list|forward_list|_?[Mm]ap|multimap|set|multiset|unordered_\w+|_Rb_tree|"
            r"_Hashtable|queue|stack|function|shared_ptr|__shared_ptr|any|basic_\w*stream)\b"
        ),
    ),
    (
        "calls for thread-local storage",
        re.compile(r"\b(__tls_get_addr|__emutls_get_address|TLS (init|wrapper) function)\b"),
    ),
    ("guards a local static", re.compile(r"\b__cxa_guard_acquire\b")),
]


def symbols(object_file):
    """The object's symbols: (type letter, name)."""
    listing = subprocess.run(["nm", "-C", object_file], check=True, capture_output=True, text=True).stdout
    for line in listing.splitlines():
        kind, name = line[16:].strip().split(" ", 1)
        yield kind, name


def main():
    violations = []
    for object_file in sys.argv[1:]:
        found = list(symbols(object_file))
        wanted = sorted({name for kind, name in found if kind == "U" and "waitpoint::" not in name})
        print(f"{object_file}: {len(found)} symbols; from outside: {', '.join(wanted) or 'none'}")
        for _, name in found:
            violations += [f"{object_file}: {what}: {name}" for what, pattern in FORBIDDEN if pattern.search(name)]
    if len(sys.argv) < 2:
        violations.append("no objects of the kernel given")
    print(f"{len(sys.argv) - 1} objects, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
