# SPDX-License-Identifier: BSD-3-Clause
"""Documents of waitpoint as values: YAML 1.2's core schema, as editors read it."""

import re

import yaml


class Loader(yaml.SafeLoader):
    """Words such as `on` are texts, and 1e3 is a number."""


Loader.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("tag:yaml.org,2002:bool", r"^(?:true|false)$", list("tf")),
    ("tag:yaml.org,2002:null", r"^(?:~|null|)$", ["~", "n", ""]),
    ("tag:yaml.org,2002:merge", r"^<<$", ["<"]),
    ("tag:yaml.org,2002:int", r"^[-+]?[0-9]+$", list("-+0123456789")),
    ("tag:yaml.org,2002:float", r"^[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?$", list("-+.0123456789")),
]:
    Loader.add_implicit_resolver(tag, re.compile(pattern), first)
Loader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(loader.construct_scalar(node)))
Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(loader.construct_scalar(node)))


def load(text):
    return yaml.load(text, Loader)


def kind_of(document):
    """The kind of schema that a document with `format: 1` is of."""
    if "actions" in document:
        return "plan"
    if {"robots", "robots_from_map", "play", "log"} & set(document):
        return "scenario"
    return "robot" if "robot_types" in document else "floor"
