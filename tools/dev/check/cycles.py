# SPDX-License-Identifier: BSD-3-Clause
"""Finds cycles of includes between units and between folders: cycles.py ROOT [TABLE].

A source and its header are one unit: `fibers/kernel/task` is task.hpp and task.cpp. Only the cycles in TABLE (cycles.table)
are tolerated; one that no longer exists must be removed from the table.
"""

import collections
import pathlib
import sys

sys.dont_write_bytecode = True
from dependencies import INCLUDE, sources  # noqa: E402


def include_graph(root):
    """{unit: {included unit: the including file}}."""
    graph = collections.defaultdict(dict)
    for source in sources(root):
        unit = str(source.with_suffix(""))
        edges = graph[unit]
        for line in (root / source).read_text().splitlines():
            match = INCLUDE.match(line)
            if match and match[1].startswith('"') and (root / match[1].strip('"')).is_file():
                other = str(pathlib.PurePosixPath(match[1].strip('"')).with_suffix(""))
                if other != unit:
                    edges.setdefault(other, str(source))
    return graph


def folder_graph(units):
    """The same for folders, from the graph of units."""
    graph = collections.defaultdict(dict)
    for unit, edges in units.items():
        own = str(pathlib.PurePosixPath(unit).parent)
        for other, source in edges.items():
            folder = str(pathlib.PurePosixPath(other).parent)
            if folder != own:
                graph[own].setdefault(folder, source)
    return graph


def cycles(graph):
    """The strongly connected components of more than one node, each sorted (Tarjan's algorithm, without recursion)."""
    index, low, stack, on_stack, found = {}, {}, [], set(), []
    for start in sorted(graph):
        if start in index:
            continue
        work = [(start, iter(sorted(graph[start])))]
        index[start] = low[start] = len(index)
        stack.append(start)
        on_stack.add(start)
        while work:
            node, successors = work[-1]
            for other in successors:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    on_stack.add(other)
                    work.append((other, iter(sorted(graph.get(other, ())))))
                    break
                if other in on_stack:
                    low[node] = min(low[node], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    at = stack.index(node)
                    component = stack[at:]
                    del stack[at:]
                    on_stack.difference_update(component)
                    if len(component) > 1:
                        found.append(tuple(sorted(component)))
    return found


def read_table(path):
    """Each line has the members of a tolerated cycle."""
    lines = (line.split("#")[0].split() for line in path.read_text().splitlines())
    return {tuple(sorted(words)) for words in lines if words}


def main():
    root = pathlib.Path(sys.argv[1])
    tolerated = read_table(pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).with_suffix(".table"))
    units = include_graph(root)
    violations, count = [], 0
    for graph in (units, folder_graph(units)):
        for cycle in cycles(graph):
            count += 1
            if cycle in tolerated:
                tolerated.discard(cycle)
                continue
            violations.append(f"{len(cycle)} include each other: {' '.join(cycle)}")
            for node in cycle:
                violations += [f"    {graph[node][other]} includes {other}" for other in cycle if other in graph[node]]
    violations += [f"the table names a cycle that no longer exists: {' '.join(cycle)}" for cycle in sorted(tolerated)]
    print(f"{len(units)} units, {count} cycles, {len(violations)} violations")
    print("".join(f"{violation}\n" for violation in violations), end="")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
