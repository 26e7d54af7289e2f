# SPDX-License-Identifier: BSD-3-Clause
"""Checks every #include of the repository against dependencies.table: dependencies.py ROOT.

Quoted headers are this repository's, named from its root; angled ones are external.
"""

import collections
import fnmatch
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*(<[^>]+>|"[^"]+")')
SKIPPED = re.compile(r"(\..*|build.*|subprojects)$")


def read_table(path):
    """The rules [(folder pattern, allowed folder patterns)] and [(header pattern, file patterns)], in the table's order."""
    folders, headers = [], []
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            (headers if words[0].startswith("<") else folders).append((words[0], words[1:]))
    return folders, headers


def fits(name, patterns):
    return any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)


def sources(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.suffix in (".cpp", ".hpp") and not SKIPPED.match(relative.parts[0]):
            yield relative


def allowed_in(folder, rules):
    return next((allowed for pattern, allowed in rules if fnmatch.fnmatchcase(folder, pattern)), None)


def complaint(source, name, root, folders, headers):
    """The violation of `source` including `name` (with its quotes or brackets), or None."""
    if name.startswith("<"):
        for pattern, users in headers:
            if fnmatch.fnmatchcase(name, pattern):
                return None if fits(str(source), users) else f"{name} may only be included in: {' '.join(users) or 'none'}"
        top = name[1:].split("/")[0]
        return f'{name} belongs to this repository: "{name[1:-1]}"' if "/" in name and (root / top).is_dir() else None
    header = pathlib.PurePosixPath(name.strip('"'))
    if not (root / header).is_file():
        return f"{name} is not a header's path from the repository's root"
    own, other = str(source.parent), str(header.parent)
    allowed = allowed_in(own, folders) or []
    if other == own or fits(other, allowed):
        return None
    return f"{own} may not include {other} (only: {' '.join(allowed) or 'itself'})"


def main():
    root = pathlib.Path(sys.argv[1])
    folders, headers = read_table(pathlib.Path(__file__).with_suffix(".table"))
    violations = []
    used = collections.defaultdict(set)
    count = collections.Counter()
    for source in sources(root):
        own = str(source.parent)
        count[own] += 1
        if allowed_in(own, folders) is None:
            violations.append(f"{source}:1: the folder {own} is not in dependencies.table")
            continue
        for number, line in enumerate((root / source).read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            problem = complaint(source, match[1], root, folders, headers)
            if problem:
                violations.append(f"{source}:{number}: {problem}")
            if match[1].startswith('"'):
                used[own].add(str(pathlib.PurePosixPath(match[1].strip('"')).parent))
    width = max(map(len, count), default=0)
    for own in sorted(count):
        print(f"{own:{width}}  {count[own]:3} files  includes {' '.join(sorted(used[own] - {own})) or 'none'}")
    print(f"{sum(count.values())} files in {len(count)} folders, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
