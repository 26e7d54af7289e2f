# SPDX-License-Identifier: BSD-3-Clause
"""Mistakes in documents: each value and each key of a document changed, one at a time."""

import copy

WRONG_VALUES = [{"x": {"y": 1}}, [[["x"]]], "a word", True, None]


def places(value, path=()):
    """The paths of all values within a document."""
    if path:
        yield path
    children = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in children:
        yield from places(child, path + (key,))


def at(document, path):
    for key in path:
        document = document[key]
    return document


def changed(document, path, value):
    result = copy.deepcopy(document)
    at(result, path[:-1])[path[-1]] = value
    return result


def without(document, path):
    result = copy.deepcopy(document)
    del at(result, path[:-1])[path[-1]]
    return result


def bounds(validator, document, path):
    """The bounds of the number at `path`, as the validator tells when they are exceeded."""
    found = set()
    for extreme in (-1e300, 1e300):
        errors = list(validator.iter_errors(changed(document, path, extreme)))
        while errors:
            error = errors.pop()
            errors += error.context
            if error.validator in ("minimum", "maximum") and tuple(error.absolute_path) == path:
                found.add((error.validator, error.validator_value))
    return found


def beyond(kind, bound):
    away = max(abs(bound) * 1e-6, 1e-9) if abs(bound) > 1e-9 else 0.5
    if isinstance(bound, int) and abs(bound) >= 1:
        away = 1
    return bound - away if kind == "minimum" else bound + away


def mutants_at(validator, document, path):
    """(what was done, the mutant) for one place of a document."""
    value = at(document, path)
    for wrong in WRONG_VALUES:
        # A null within a list of a module's or the executive's parameter is none for the readers; schemas refuse it.
        if wrong is not None or not isinstance(path[-1], int) or not {"modules", "executive"} & set(path):
            yield f"{wrong!r}", changed(document, path, wrong)
    if isinstance(value, dict):
        yield "an unknown key", changed(document, path + ("colour",), 1)
    if isinstance(value, list) and value:
        yield "an element too many", changed(document, path, value + [value[-1]])
        yield "an element too few", changed(document, path, value[:-1])
    if isinstance(path[-1], str):
        yield "no key", without(document, path)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        for number in (0, -1, 1.5, 1e300):
            yield str(number), changed(document, path, number)
        for kind, bound in sorted(bounds(validator, document, path)):
            bound = int(bound) if isinstance(value, int) and bound == int(bound) else bound
            yield f"the {kind}", changed(document, path, bound)
            yield f"beyond the {kind}", changed(document, path, beyond(kind, bound))
