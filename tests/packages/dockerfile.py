# SPDX-License-Identifier: BSD-3-Clause
"""A Dockerfile as values: stages of instructions."""

import dataclasses
import re


@dataclasses.dataclass
class Instruction:
    name: str  # "RUN"
    words: str  # all that follows, with its lines joined, without flags
    flags: list  # ["--from=packages"]


@dataclasses.dataclass
class Stage:
    base: str  # the image that it begins with
    name: str  # empty if it has none
    instructions: list


def stages_of(text):
    """The stages of a Dockerfile; ValueError for a line that is no instruction."""
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    stages = []
    for line in re.sub(r"\\\n", " ", "\n".join(lines)).splitlines():
        parts = re.fullmatch(r"([A-Z]+) +((?:--\S+ +)*)(.*)", line)
        if not parts:
            raise ValueError(f"expected an instruction, found '{line}'")
        name, flags, words = parts[1], parts[2].split(), " ".join(parts[3].split())
        if name == "FROM":
            base, _, stage = words.partition(" AS ")
            stages.append(Stage(base, stage, []))
        else:
            stages[-1].instructions.append(Instruction(name, words, flags))
    return stages
