# SPDX-License-Identifier: BSD-3-Clause
"""`waitpoint schema` agrees with the readers: schema_test.py BUILD."""

import itertools
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
    import yaml  # noqa: F401
except ImportError:
    print("without python3-jsonschema or python3-yaml")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import documents  # noqa: E402
import mutants  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = BUILD / "tools/waitpoint"
SHIPPED = ROOT / "scenarios/schemas"
KINDS = ["scenario", "robot", "plan", "floor"]
# What only the readers know: docs/schema.md lists it.
ONLY_READERS = re.compile("|".join(line for line in (pathlib.Path(__file__).parent / "only_readers.txt").read_text().splitlines()
                                   if line and not line.startswith("#")) or "(?!)")
# Their robots have modules of the programs' own.
OWN_MODULES = {"tests/programs/blinker", "tests/programs/deaths", "tests/programs/late_pom", "tests/programs/mast", "tests/programs/meddling",
               "tests/programs/mixed", "tests/programs/two_robots", "tests/programs/unrepeatable", "examples/lookout",
               "tests/faults", "tests/programs/trespasser"}


def schema_of(kind):
    text = subprocess.run([PROGRAM, "schema", kind], capture_output=True, text=True, check=True).stdout
    return text, json.loads(text)


SCHEMAS = {kind: schema_of(kind) for kind in KINDS}
DEFINITIONS = {name: part for kind in ("scenario", "plan") for name, part in SCHEMAS[kind][1]["$defs"].items()}


def in_one_file(schema):
    """The schema with the definitions of the file that it refers to."""
    return {"$defs": DEFINITIONS} | schema | {"$ref": schema["$ref"].removeprefix("scenario.json")}


VALIDATORS = {kind: jsonschema.Draft202012Validator(in_one_file(schema)) for kind, (_, schema) in SCHEMAS.items()}


class Readers:
    """The readers of waitpoint in a process of their own."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen([BUILD / "tests/read-documents", self.folder.name], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()
        self.folder.cleanup()

    def verdict(self, kind, document):
        self.process.stdin.write(f"{kind}\t{json.dumps(document)}\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().rstrip("\n")


def sample(schema):
    """A value of a module's parameter."""
    if schema.get("default") is not None:
        return schema["default"]
    if "$ref" in schema:
        return "fixed"
    kind = schema.get("type")
    kind = kind[0] if isinstance(kind, list) else kind
    if kind == "object":
        return {key: sample(part) for key, part in schema["properties"].items()}
    if kind == "array":
        return [sample(schema["items"])]
    if kind in ("number", "integer"):
        return max(schema["minimum"], min(1, schema["maximum"]))
    return {"boolean": True}.get(kind, "cpu")


def parameters(definition, left_out=()):
    return {key: sample(schema) for key, schema in definition["properties"].items() if key not in left_out}


def complete_documents():
    """(kind, document): of each kind documents that have all keys."""
    definitions = DEFINITIONS
    for file in sorted((pathlib.Path(__file__).parent / "documents").glob("*.yaml")):
        document = documents.load(file.read_text().replace("@ROOT@", str(ROOT)))
        if file.stem != "scenario":
            yield documents.kind_of(document), document
            continue
        scout = document["robot_types"]["scout"]
        scout["executive"] = parameters(definitions["executive"], ["tcl"])
        for robot in document["robots"]:
            yield "scenario", {"format": 1, "robots": [robot]} | (
                {"robot_types": {"scout": scout | {"executive": {}}}} if "type" in robot else {})
        of_type = [{"name": "one", "type": "scout", "start": [1, 1]}]
        for part in ("shape", "base", "executive"):
            yield "scenario", {"format": 1, "robots": of_type,
                               "robot_types": {"scout": {"shape": scout["shape"], "processors": scout["processors"]} | {part: scout[part]}}}
        rest = {key: value for key, value in scout.items() if key not in ("base", "executive")}
        yield "scenario", {"format": 1, "robots": of_type, "robot_types": {"scout": rest}}
        for name in sorted(definitions):
            if name.startswith("module_") and name != "module_meeting":  # it needs a network
                module = {"name": name[7:], "type": name[7:], "enabled": True}
                module |= parameters(definitions[name], module)
                robot = document["robots"][1] | {"modules": [module], "processors": ["cpu"]}
                yield "scenario", {"format": 1, "robots": [robot]}
        yield "scenario", {key: value for key, value in document.items() if key != "robot_types"} | {
            "robots": document["robots"][1:2]}


def tables_of_keys():
    """(place, name of a map, what is in front of its keys, whether all are there, titles, rows of cells): of each table
    behind <!-- keys: NAME -->, <!-- keys: NAME, behind FRONT --> or <!-- keys: NAME, some -->."""
    for page in sorted((ROOT / "docs").glob("*.md")):
        lines = page.read_text().splitlines()
        for number, line in enumerate(lines):
            marked = re.match(r"<!-- keys: ([\w.]+)(?:, behind (\S+?))?(, some)? -->$", line)
            if not marked:
                continue
            cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]]
                     for row in itertools.takewhile(lambda line: line.startswith("|"), lines[number + 1:])]
            yield f"docs/{page.name}:{number + 1}", marked[1], marked[2] or "", not marked[3], cells[0], cells[2:]


def schema_of_map(name):
    """The keys of a map, and what a complete one has beyond them."""
    name, *path = name.split(".")
    keys, complete = DEFINITIONS[name], DEFINITIONS.get(f"complete_{name}", {})
    for key in path:
        keys, complete = keys["properties"][key], complete.get("properties", {}).get(key, {})
    return keys, complete


def property_at(schema, complete, path):
    """The key of a map, by names joined by dots, None if there is no such key; and whether it is required."""
    for key in path[:-1]:
        schema, complete = schema["properties"].get(key, {"properties": {}}), complete.get("properties", {}).get(key, {})
    return schema["properties"].get(path[-1]), path[-1] in complete.get("required", [])


def written(default):
    return str(default).lower() if isinstance(default, bool) else str(default).removesuffix(".0")


def meaning(cell):
    """Of a key, without links, and without "; see LINK" at its end."""
    link = r"\[([^\]]*)\]\([^)]*\)"
    return re.sub(link, r"\1", re.sub(f"; see {link}$", "", cell))


def differing_rows(schema, complete, front, is_whole, titles, rows):
    """What a table says that the schema does not, and the other way round."""
    given = set()
    for row in rows:
        keys = [key for key in re.findall(r"`([^`]+)`", row[0]) if key.startswith(front)]
        defaults = [cell.strip() for cell in row[2].split(",")] if titles[2:] == ["default"] else []
        for index, key in enumerate(keys):
            key = key[len(front):]
            given.add(key)
            found, is_needed = property_at(schema, complete, key.split("."))
            if found is None:
                yield f"{key}: the schema has no such key"
                continue
            described = re.sub(r" ?\[[^\]]*\]$", "", found.get("description", ""))
            if titles[1] == "meaning" and meaning(row[1]) != described:
                yield f"{key}: the meaning is: {described}"
            if not defaults:
                continue
            cell = (defaults[index] if len(defaults) == len(keys) else row[2]).strip("`")
            if (cell == "required") != is_needed:
                yield f"{key}: required in one of the two"
            if "default" in found and re.fullmatch(r"[-0-9.e]+|true|false", cell) and cell != written(found["default"]):
                yield f"{key}: the default {cell} is {written(found['default'])}"
    for key in sorted(set(schema["properties"]) - given) if is_whole else ():
        yield f"{key}: the table has no such row"


class Schemas(unittest.TestCase):
    maxDiff = None

    def test_tables_in_the_documents_have_the_declared_keys_meanings_and_defaults(self):
        compared = 0
        for place, name, *table in tables_of_keys():
            with self.subTest(table=place):
                self.assertEqual([], list(differing_rows(*schema_of_map(name), *table)))
            compared += 1
        self.assertGreater(compared, 12)

    def test_shipped_files_are_what_the_command_prints(self):
        for kind, (text, _) in SCHEMAS.items():
            shipped = (SHIPPED / f"{kind}.json").read_text()
            self.assertEqual(shipped, text, f"renew it: waitpoint schema {kind} > scenarios/schemas/{kind}.json")

    def test_is_a_schema(self):
        for _, schema in SCHEMAS.values():
            jsonschema.Draft202012Validator.check_schema(schema)

    def test_documents_of_the_tree_are_valid(self):
        checked = 0
        for file in sorted(ROOT.glob("**/*.yaml")):
            folder = str(file.parent.relative_to(ROOT))
            if folder in OWN_MODULES or folder.startswith(("build", "tests/fuzz", "tests/schema")):
                continue
            text = file.read_text()
            if not re.search("^format: 1", text, re.MULTILINE):
                continue
            with self.subTest(file=file):
                document = documents.load(text)
                errors = sorted(VALIDATORS[documents.kind_of(document)].iter_errors(document), key=str)
                self.assertEqual([], [f"{list(e.absolute_path)}: {e.message[:300]}" for e in errors])
            checked += 1
        self.assertGreater(checked, 20)

    def test_shipped_documents_name_their_schema(self):
        for file in sorted((ROOT / "scenarios").glob("**/*.yaml")):
            text = file.read_text()
            if not re.search("^format: 1", text, re.MULTILINE):
                continue
            first = text.splitlines()[0]
            match = re.match(r"# yaml-language-server: \$schema=(\S+)$", first)
            with self.subTest(file=file):
                self.assertTrue(match, first)
                named = (file.parent / match[1]).resolve()
                self.assertEqual(SHIPPED / f"{documents.kind_of(documents.load(text))}.json", named)

    def test_readers_accept_the_complete_documents_and_so_do_the_schemas(self):
        with Readers() as readers:
            for kind, document in complete_documents():
                with self.subTest(document=str(document)[:200]):
                    self.assertEqual("good", readers.verdict(kind, document))
                    self.assertEqual([], [f"{list(e.absolute_path)}: {e.message[:200]}"
                                          for e in VALIDATORS[kind].iter_errors(document)])

    def test_all_declared_keys_are_in_complete_documents(self):
        declared, given = set(), set()

        def collect(schema):
            if isinstance(schema, dict):
                properties = schema.get("properties")
                if isinstance(properties, dict) and schema.get("type") == "object":
                    declared.update(properties)
                for part in schema.values():
                    collect(part)
            elif isinstance(schema, list):
                for part in schema:
                    collect(part)

        collect(DEFINITIONS)
        for _, document in complete_documents():
            given.update(key for path in mutants.places(document) for key in path if isinstance(key, str))
        self.assertEqual(set(), declared - given - {"include", "model", "frame", "robots_from_map", "kind", "scale", "tcl", "block_cost_ns", "cost_us"})
        print(f"{len(declared)} keys")

    def test_schemas_and_readers_agree_on_mistakes(self):
        tried = only_readers = refused = 0
        disagreeing = []
        with Readers() as readers:
            for kind, document in complete_documents():
                validator = VALIDATORS[kind]
                for path in mutants.places(document):
                    if "modules" in path and "robots" not in document:
                        continue  # a module's parameters are read when a robot has it
                    for what, mutant in mutants.mutants_at(validator, document, path):
                        if len(path) > 4 and random.Random(f"{path} {what}").random() > 0.4:
                            continue
                        verdict = readers.verdict(kind, mutant)
                        is_valid = validator.is_valid(mutant)
                        tried += 1
                        refused += verdict != "good"
                        if is_valid == (verdict == "good"):
                            continue
                        if is_valid and ONLY_READERS.search(verdict):
                            only_readers += 1
                            continue
                        disagreeing.append(f"{'.'.join(map(str, path))}: {what}: schema {is_valid}, reader {verdict}")
        print(f"{tried} mutants, {refused} refused by the readers, {only_readers} by the readers alone as listed, "
              f"{len(disagreeing)} disagreeing")
        self.assertEqual("", "\n".join(disagreeing[:40]))


if __name__ == "__main__":
    unittest.main()
