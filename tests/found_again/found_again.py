# SPDX-License-Identifier: BSD-3-Clause
"""Known bugs of public libraries, found again by `waitpoint explore -- PROGRAM`:
found_again.py BUILD [--mended | --table] [--iterations N] [--programs FOLDER] [--sources NAME=FOLDER ...] [NAME ...].

Prints for each program of this folder, or those named, the schedules needed (median of five seeds), what is reported, and how
many of the failures were replayed, with the command that replays the first. With --programs they stay, in that folder.
A program is built with Debian's package of its library if that has the bug, or with the sources in FOLDER; without both it
is left out, with a line. With --mended no schedule of the programs may fail: for a library in which the bug is mended, which
is Debian's package if no sources are given. With --table the times to the first failure are compared with native ones, in
minutes. README.md has both tables.
"""

import argparse
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

import times
from recipes import RECIPES as KNOWN
from recipes import CannotBuild, compiled
from unreported import RECIPES as UNREPORTED

SEEDS = range(1, 6)
SECONDS_MAX = 300
RECIPES = [*KNOWN, *UNREPORTED]
NAMES = [recipe.name for recipe in RECIPES]


def sources_of(text):
    name, _, folder = text.partition("=")
    if name not in NAMES or not pathlib.Path(folder).is_dir():
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=FOLDER with a folder and one of the names {', '.join(NAMES)}")
    return name, pathlib.Path(folder).resolve()


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def arguments():
    parser = Parser(prog="found_again.py")
    parser.add_argument("build", type=lambda text: pathlib.Path(text).resolve())
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--sources", type=sources_of, action="append", default=[], metavar="NAME=FOLDER")
    parser.add_argument("--iterations", type=int, default=5000)
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--mended", action="store_true")
    kinds.add_argument("--table", action="store_true")
    parser.add_argument("--programs", type=pathlib.Path, metavar="FOLDER")
    options = parser.parse_intermixed_args()
    for name in options.names:
        if name not in NAMES:
            parser.error(f"there is no program '{name}': {', '.join(NAMES)}")
    return options


def execute(command, folder):
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
                          timeout=SECONDS_MAX)
    return done.stdout + done.stderr


class Campaign:
    """One seed's schedules: their number up to the failure, the failure's kind, and whether its replay is the same run."""

    def __init__(self, waitpoint, program, iterations, seed):
        text = execute([waitpoint, "explore", "--switch-at", "calls", "--iterations", str(iterations), "--seed", str(seed),
                        "--", program], program.parent)
        failed = re.search(r"^(?:schedule (\d+) of .*|the default order) failed at [0-9.]+ s: "
                           r"(?:terminated by signal \d+ \()?([\w ]+)", text, re.MULTILINE)
        if not failed:
            passed = re.search(r": (\d+) schedules?, \d+ distinct, 0 failed", text)
            if not passed:
                raise CannotBuild(f"no line about the schedules in: {text}")
            self.schedules = int(passed[1])
            self.failure = None
            return
        # The search goes on after a misuse.
        self.schedules = int(failed[1] or 0) + 1
        self.failure = failed[2]
        replay = re.search(r"^replay: (.*)$", text, re.MULTILINE)
        self.replay = replay[1] if replay else ""
        self.replayed = bool(replay) and "the same run as in the record" in execute(shlex.split(self.replay), program.parent)


def row_of(recipe, campaigns):
    found = [campaign for campaign in campaigns if campaign.failure]
    if not found:
        return f"| {recipe.name} | {recipe.bug} | none in {campaigns[0].schedules}, {len(campaigns)} seeds |  |  |"
    needed = [campaign.schedules if campaign.failure else float("inf") for campaign in campaigns]
    kinds = ", ".join(sorted({campaign.failure for campaign in found}))
    replayed = sum(campaign.replayed for campaign in found)
    return (f"| {recipe.name} | {recipe.bug} | {statistics.median(needed):g} | {kinds} | {replayed} of {len(found)} |\n"
            f"{found[0].replay}")


def needs_sources(recipe, options):
    return recipe.name not in dict(options.sources) and not (recipe.package if options.mended else recipe.packaged)


def explored(recipe, options, folder):
    """Prints the row of a recipe, and returns whether its schedules failed, or passed, as expected."""
    program = compiled(recipe, dict(options.sources).get(recipe.name), folder)
    campaigns = [Campaign(options.build / "tools/waitpoint", program, options.iterations, seed) for seed in SEEDS]
    print(row_of(recipe, campaigns), flush=True)
    if options.mended:
        return not any(campaign.failure for campaign in campaigns)
    return all(campaign.failure and campaign.replayed for campaign in campaigns)


def compared(recipe, options, folder):
    """Prints the row of a recipe in the table of times."""
    sources = dict(options.sources).get(recipe.name)
    program = compiled(recipe, sources, folder)
    (folder / "native").mkdir(exist_ok=True)
    native = compiled(recipe.uninstrumented(), sources, folder / "native")
    print(times.row(options.build / "tools/waitpoint", program, native, SEEDS), flush=True)


def result_of(recipe, options, folder):
    """None if the recipe is left out."""
    if needs_sources(recipe, options):
        print(f"{recipe.name}: left out, it needs --sources {recipe.name}=FOLDER, of version {recipe.version}", file=sys.stderr)
        return None
    try:
        return (compared if options.table else explored)(recipe, options, folder)
    except CannotBuild as error:
        print(f"{recipe.name}: left out: {error} (package {recipe.package or 'none'})", file=sys.stderr)
        return None


def heading(columns):
    return "| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|"


def main():
    options = arguments()
    print(heading(times.COLUMNS if options.table else ("program", "bug", "schedules", "report", "replayed")), flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.programs or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        chosen = [recipe for recipe in RECIPES if not options.names or recipe.name in options.names]
        results = [result_of(recipe, options, folder.resolve()) for recipe in chosen]
    return 1 if False in results else 0


if __name__ == "__main__":
    sys.exit(main())
