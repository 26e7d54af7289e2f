# SPDX-License-Identifier: BSD-3-Clause
"""`analysis.py BUILD [REVISION]` writes BUILD/analysis/build.ninja, by which Ninja runs clang-tidy over this repository's
sources: each source once, with its first compile command, and again only when the source, an included header, its flags or
.clang-tidy changed. With REVISION: only sources that changed since, or whose own header did.

A file without findings gets a stamp; its includes come from the compiler's dependency output.
"""

import json
import os
import pathlib
import shlex
import subprocess
import sys

sys.dont_write_bytecode = True
from compiled import ROOT, commands  # noqa: E402
from cycles import include_graph  # noqa: E402

RULES = """builddir = analysis
rule analyse
  command = $compiler @$out.flags -MM -MT $out -MF $out.d $in && $
    clang-tidy -p analysis --quiet --warnings-as-errors='*' $in >$out 2>&1 || { cat $out; rm -f $out; false; }
  rspfile = $out.flags
  rspfile_content = $flags
  depfile = $out.d
  deps = gcc
  description = $in
"""


# Options of g++ that clang-tidy does not know, and that do not affect parsing.
UNKNOWN_TO_CLANG = {"-fno-enforce-eh-specs"}


def known_to_clang(entry):
    words = shlex.split(entry["command"])
    known = [word for word in words if word not in UNKNOWN_TO_CLANG]
    return entry if known == words else {**entry, "command": shlex.join(known)}


def flags(entry):
    """The compiler and the flags that affect parsing."""
    words = iter(shlex.split(entry["command"]))
    compiler, kept = [], []
    for word in words:
        if word in ("-o", "-MF", "-MQ"):
            next(words)
        elif word.startswith("-"):
            kept += [word] if word not in ("-c", "-MD") else []
        elif kept:
            if word != entry["file"]:
                kept.append(word)
        else:
            compiler.append(word)
    return shlex.join(compiler), shlex.join(kept)


def changed_units(revision):
    """Sources and headers that differ from `revision`, without suffix; moved ones only if their text changed."""
    listing = subprocess.run(
        ["git", "diff", "--name-status", "--find-renames", revision], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    rows = (line.split("\t") for line in listing.splitlines())
    return {os.path.splitext(row[-1])[0] for row in rows if row[0] not in ("D", "R100")}


def readers(changed, sources):
    """For each header of `changed` without a source of its name, one source that includes it, directly or not."""
    graph = include_graph(ROOT)
    found = set()
    for header in sorted(changed - sources):
        reached, reader = {header}, None
        while reader is None:
            including = {unit for unit, edges in graph.items() if unit not in reached and reached & edges.keys()}
            if not including:
                break
            reader = min(including & sources, default=None)
            reached |= including
        if reader is not None:
            found.add(reader)
    return found


def main():
    build = pathlib.Path(sys.argv[1])
    first = {}
    wanted = changed_units(sys.argv[2]) if len(sys.argv) > 2 else None
    database = list(commands(build))
    if wanted is not None:
        wanted |= readers(wanted, {str(source.with_suffix("")) for source, _ in database})
    for source, entry in database:
        if wanted is not None and str(source.with_suffix("")) not in wanted:
            continue
        first.setdefault(source, known_to_clang(entry))
    folder, settings = build / "analysis", os.path.relpath(ROOT / ".clang-tidy", build)
    folder.mkdir(exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(list(first.values())))
    with open(folder / "build.ninja", "w") as ninja:
        ninja.write(RULES)
        for source, entry in sorted(first.items()):
            compiler, kept = flags(entry)
            ninja.write(f"build analysis/{source}.analysed: analyse {entry['file']} | {settings}\n")
            ninja.write(f"  compiler = {compiler}\n  flags = {kept}\n".replace("$", "$$"))
    print(len(first))


if __name__ == "__main__":
    main()
