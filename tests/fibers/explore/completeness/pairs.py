# SPDX-License-Identifier: BSD-3-Clause
"""Pairs of calls on state that threads share, as tests of what "exhaustive" claims: pairs.py BUILD [options].

Each pair of a group's calls of pairs.c is explored by dfs, by dpor and by the default strategy, which goes over to dpor.
The sets of outcomes must be equal, and equal to the outcomes of the real calls in each order, made natively. Of the
build-up `once`, where the order of two more calls is an outcome, dfs alone is the judge; of `third` and `three`, whose schedules are
too many for dfs, the native calls.

  --sample N      N pairs, the same each time, in place of all
  --triples N     N triples of calls of three threads, drawn at random
  --only A B [C]  this pair or triple
  --group NAME    the pairs of this group
  --build-up NAME plain, twice, third, once or pending alone
Exit status: 0 no case differs, 1 some do.
"""

import argparse
import collections
import itertools
import pathlib
import random
import re
import subprocess
import sys
import tempfile

build_ups = {"plain": ("ab", "ba"), "twice": ("aab", "aba", "baa"), "third": ("ab", "ba"), "once": (), "pending": ("ab", "ba")}
of_triples = {"three": tuple("".join(order) for order in itertools.permutations("abc"))}
schedules_max = 2_000


class Pairs:
    def __init__(self, build):
        self.waitpoint, self.program = build / "tools/waitpoint", build / "tests/completeness-pairs"
        listed = subprocess.run([self.program], capture_output=True, text=True, check=True).stdout
        self.groups = collections.defaultdict(list)
        for line in listed.splitlines():
            group, name = line.split()
            self.groups[group].append(name)
        self.folder = tempfile.TemporaryDirectory(prefix="pairs-")
        self.counts = collections.Counter()

    def outcomes(self, words, build_up, pair, same):
        folder = pathlib.Path(self.folder.name)
        file, work = folder / "outcomes", folder / "work"
        file.unlink(missing_ok=True)
        work.mkdir(exist_ok=True)
        command = [*words, self.program, build_up, *pair, same, work, file]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=600)
        return set(file.read_text().splitlines()) if file.exists() else set(), done.stdout + done.stderr

    def explored(self, strategy, *case):
        words = [self.waitpoint, "explore", "--no-minimize", "--observe", "0", "--switch-at", "calls", "--iterations", str(schedules_max)]
        if strategy != "default":
            words += ["--strategy", strategy]
        found, told = self.outcomes([*words, "--"], *case)
        summary = told.split("\n")[0]
        schedules = re.search(r"(\d+) schedule", summary)
        self.counts[strategy + " schedules"] += int(schedules[1]) if schedules else 0
        self.counts[strategy + " runs"] += 1
        return found, "exhausti" in told or "exhausted" in told, summary

    def compare(self, build_up, pair, same):
        case = (build_up, pair, same)
        wanted = set()
        for order in (build_ups | of_triples)[build_up]:
            # Random bytes are the seed's.
            wanted |= self.outcomes([], f"native:{order}", pair, same)[0] if "random_bytes" not in pair else set()
        faults = []
        for strategy in ("dfs", "dpor", "default"):
            if strategy == "dfs" and build_up in ("third", "three"):
                continue
            found, is_finished, told = self.explored(strategy, *case)
            if build_up == "once" and strategy == "dfs":
                if not is_finished:
                    self.counts["without a judge"] += 1
                    return []
                wanted = found
            wanted = wanted or found
            if found != wanted if is_finished else found - wanted:
                faults.append((f"{strategy} ({told})", found, wanted))
            elif not is_finished:
                self.counts[f"{strategy} unfinished"] += 1
        return [f"{what}:\n" + "".join(f"  - {line}\n" for line in sorted(right - found)[:3])
                + "".join(f"  + {line}\n" for line in sorted(found - right)[:3]) for what, found, right in faults]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--sample", type=int)
    parser.add_argument("--triples", type=int)
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--group")
    parser.add_argument("--build-up", choices=build_ups)
    asked = parser.parse_args()
    pairs = Pairs(asked.build.resolve())
    if asked.only:
        all_pairs = [("asked", tuple(asked.only))]
        asked.build_up = asked.build_up or (None if len(asked.only) == 2 else "three")
    else:
        all_pairs = [(group, pair) for group, names in pairs.groups.items() if asked.group in (None, group)
                     for pair in itertools.product(names, repeat=2)]
    cases = [(group, build_up, pair, same) for group, pair in all_pairs for same in ("1", "0")
             for build_up in build_ups | of_triples if build_up == asked.build_up or (asked.build_up is None and build_up in build_ups)]
    if asked.sample is not None:
        cases = random.Random(1).sample(cases, asked.sample)
    if asked.triples is not None:
        draws = random.Random(2)
        groups = draws.choices([(group, names) for group, names in pairs.groups.items() if asked.group in (None, group)], k=asked.triples)
        cases = [(group, "three", tuple(draws.choices(names, k=3)), draws.choice("10")) for group, names in groups]
    tallies = collections.defaultdict(collections.Counter)
    for group, build_up, pair, same in cases:
        faults = pairs.compare(build_up, pair, same)
        tallies[group]["different" if faults else "equal"] += 1
        if faults:
            print(f"{build_up} {' '.join(pair)} {same}: " + "".join(faults), flush=True)
    for group, tally in tallies.items():
        print(f"{group}: {tally['equal']} equal, {tally['different']} different")
    print(", ".join(f"{name} {count}" for name, count in sorted(pairs.counts.items())))
    return 1 if any(tally["different"] for tally in tallies.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
