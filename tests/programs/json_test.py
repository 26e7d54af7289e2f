# SPDX-License-Identifier: BSD-3-Clause
"""What --json prints has the form that docs/schemas tells: json_test.py BUILD."""

import json
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:
    print("without python3-jsonschema")
    sys.exit(77)

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = BUILD / "tools/waitpoint"
SCHEMAS = ROOT / "docs/schemas"
OFFICE = ROOT / "scenarios/office.yaml"


def strict(schema):
    """Nothing but what the schema describes: each key of an object has its place in it."""
    if isinstance(schema, list):
        return [strict(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    result = {key: strict(value) for key, value in schema.items()}
    if isinstance(schema.get("properties"), dict):
        result["additionalProperties"] = False
    return result


def local(schema, name, others):
    """The schema with references to other files made into ones to its own $defs; `others` gets the names of the files."""
    if isinstance(schema, list):
        return [local(part, name, others) for part in schema]
    if not isinstance(schema, dict):
        return schema
    result = {key: local(value, name, others) for key, value in schema.items()}
    if isinstance(schema.get("$ref"), str):
        file, _, path = schema["$ref"].partition("#")
        file = file or name
        others.add(file)
        result["$ref"] = f"#/$defs/{file}{path}"
    return result


def schema_of(name):
    """One schema, with all that it refers to."""
    others, parts = {name}, {}
    while others - parts.keys():
        for file in others - parts.keys():
            parts[file] = strict(local(json.loads((SCHEMAS / file).read_text()), file, others))
    return {"$schema": parts[name]["$schema"], "$ref": f"#/$defs/{name}", "$defs": parts}


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.program = cls.folder / "lost_update"
        subprocess.run(["gcc", "-O1", "-pthread", ROOT / "tests/exec/lost_update.c", "-o", cls.program], check=True)
        subprocess.run([PROGRAM, "run", OFFICE, "--until", "100", "--record", "run.log"], cwd=cls.folder,
                       capture_output=True)

    def call(self, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)

    def document(self, command, *words, status=0):
        """The document of a command, which is as its schema says, and its exit status."""
        done = self.call(command, "--json", *words)
        self.assertEqual(done.returncode, status, done.stderr)
        return self.checked(command, done.stdout, status)

    def checked(self, command, text, status):
        """The result in the text of a document, which is as the command's schema says."""
        document = json.loads(text)
        schema = schema_of(command.strip("-") + ".schema.json")
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(document)
        self.assertEqual((document["command"], document["status"]), (command, status))
        return document["result"]

    def test_version(self):
        self.assertEqual(self.document("--version")["digests"], "wp1")

    def test_run(self):
        text = self.call("run", OFFICE, "--until", "5")
        result = self.document("run", OFFICE, "--until", "5", status=1)
        self.assertIn(f"digest            {result['digest']}\n", text.stdout)
        self.assertEqual(result["unmet"], ["0 of 9 goals reached, expected all"])
        several = self.document("run", OFFICE, "--until", "2", "--seeds", "1..2", status=1)
        self.assertEqual([run["seed"] for run in several["runs"]], [1, 2])

    def test_run_without_a_result(self):
        """Nothing is on standard output, and one line on standard error."""
        for words in (["run", "no.yaml"], ["check", "no.yaml"], ["explore", "no.yaml"], ["play", "no.log"]):
            done = self.call(*words, "--json")
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), words)

    def test_no_file_goes_to_standard_output_beside_the_document(self):
        plan = ROOT / "scenarios/plans/guide.yaml"
        for words in (["run", OFFICE, "--summary"], ["run", OFFICE, "--events"], ["plan", plan, "--picture"],
                      ["explore", OFFICE, "--page"], ["play", "run.log", "--map"], ["fit", "run.log", "--out"],
                      ["compare", "run.log", "other.log", "--picture"]):
            for file in ("-", "/dev/stdout", "/proc/self/fd/1"):
                done = self.call(*words, file, "--json")
                expected = f"--json: expected no other file on standard output, found '{words[-1]} {file}'"
                self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", f"waitpoint: {expected}\n"))
        done = self.call("exec", "--json", "--trace", "-", "--", "true")
        self.assertEqual((done.returncode, done.stdout), (125, ""))

    def test_no_file_replaces_that_of_the_document(self):
        plan, out = ROOT / "scenarios/plans/guide.yaml", self.folder / "out"
        with out.open("w") as file:
            done = subprocess.run([PROGRAM, "plan", plan, "--json", "--picture", out], stdout=file, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, out.read_text()), (2, ""))
        with open("/dev/null", "w", encoding="utf-8") as file:
            subprocess.run([PROGRAM, "plan", plan, "--json", "--picture", "/dev/null"], stdout=file, stderr=file, check=True)

    def test_self_check(self):
        self.assertTrue(self.document("run", OFFICE, "--until", "0.5", "--verify")["same"])

    def signalled(self, expected, number, *options):
        """The output and status of a run to which a signal is sent when it has said what is expected."""
        run = subprocess.Popen([PROGRAM, "run", OFFICE, "--json", *options], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        while expected not in (line := run.stderr.readline()):
            self.assertTrue(line, f"the run ended without '{expected}'")
        run.send_signal(number)
        return run.communicate(timeout=60)[0], run.returncode

    def killed(self, number, *options):
        """The output and status of a run to which a signal is sent when it shows progress, on a terminal."""
        master, terminal = pty.openpty()
        self.addCleanup(os.close, master)
        with subprocess.Popen([PROGRAM, "run", OFFICE, "--json", *options], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                              stderr=terminal) as run:
            os.close(terminal)
            text = b""
            while b" s of " not in text:
                text += os.read(master, 4096)
            run.send_signal(number)
            try:
                while os.read(master, 4096):
                    pass
            except OSError:  # its end
                pass
            return run.communicate(timeout=60)[0], run.returncode

    def test_a_run_that_dies(self):
        output, status = self.killed(signal.SIGSEGV, "--speed", "100")
        self.assertEqual(status, -signal.SIGSEGV)
        result = self.checked("run", output, None)
        self.assertEqual(result["outcome"], "crashed")
        self.assertIn("dies of SIGSEGV", result["crash"])
        self.assertGreaterEqual(result["simulated_s"], 59)

    def test_a_served_run(self):
        output, status = self.signalled("the run is over", signal.SIGINT, "--serve", "--until", "1")
        self.assertEqual((status, self.checked("run", output, 1)["outcome"]), (1, "time limit"))

    @unittest.skipUnless((BUILD / "libwaitpoint-mpi.so").exists(), "the program has no ranks")
    def test_a_run_of_several_ranks(self):
        result = self.document("run", OFFICE.with_name("office-10.yaml"), "--until", "0.1", "--ranks", "2", status=1)
        alone = self.document("run", OFFICE.with_name("office-10.yaml"), "--until", "0.1", status=1)
        self.assertEqual((len(result["ranks"]), result["digest"]), (2, alone["digest"]))

    @unittest.skipUnless((BUILD / "libwaitpoint-nodes.so").exists() and (BUILD / "scenarios/nodes/driver").exists(),
                         "no nodes of ROS were built")
    def test_a_run_with_nodes(self):
        result = self.document("run", OFFICE.with_name("office-ros-modules.yaml"), "--until", "0.5", status=1)
        self.assertEqual(result["outcome"], "time limit")

    def test_text_goes_to_standard_error(self):
        words = ["run", OFFICE, "--until", "2"]
        speed = "  speed"
        text = [line for line in self.call(*words).stdout.splitlines() if not line.startswith(speed)]
        beside = self.call(*words, "--json").stderr.splitlines()
        self.assertEqual([line for line in text if line not in beside], [])

    def test_log_commands(self):
        result = self.document("play", "run.log")
        self.assertEqual(result["outcome"], "finished")
        self.assertTrue(self.document("play", "run.log", "--until", "1", "--verify")["same"])
        fitted = self.document("fit", "run.log")
        self.assertEqual(fitted["robot_type"], self.call("fit", "run.log").stdout)
        (self.folder / "same.log").write_bytes((self.folder / "run.log").read_bytes())
        self.assertEqual(self.document("compare", "run.log", "same.log")["quantities"][0]["distance"], 0)

    def test_check_and_plan(self):
        self.assertEqual(self.document("check", OFFICE)["goals"], 9)
        self.assertGreater(len(self.document("plan", ROOT / "scenarios/plans/guide.yaml")["actions"]), 1)

    def test_genom(self):
        description = ROOT / "examples/mast/mast.gen"
        self.assertNotIn("folder", self.document("genom", description, "--check"))
        written = self.document("genom", description, "--out", "mast")["written"]
        self.assertTrue(all((self.folder / "mast" / name).exists() for name in written))

    def test_explore_a_scenario(self):
        result = self.document("explore", OFFICE, "--until", "1", "--iterations", "2", "--property", "goals_reached=0")
        self.assertEqual((result["outcome"], result["search"]["schedules"]), ("passed", 2))
        goals = ["--property", "goals_reached=9"]
        result = self.document("explore", OFFICE, "--until", "1", *goals, status=1)
        self.assertEqual((result["outcome"], result["failure"]["kind"]), ("failed", "not as expected"))
        self.assertNotIn("search", result)
        token = result["failure"]["replay"].split("--replay ")[1]
        replayed = self.document("explore", OFFICE, "--until", "1", *goals, "--replay", token, status=1)
        self.assertEqual(replayed["summary"]["goals_reached"], 0)

    def test_explore_a_program(self):
        result = self.document("explore", "--", self.program, status=1)
        failure = result["failure"]
        self.assertEqual((failure["kind"], result["search"]["failed"]), ("not as expected", 1))
        token = failure["replay"].split("--replay ")[1].split()[0]
        replayed = self.document("explore", "--replay", token, "--", self.program, status=1)
        self.assertEqual(replayed["run"]["digest"], failure["digest"])
        passed = self.document("explore", "--strategy", "dpor", "--", self.program, "one lock")
        self.assertTrue(passed["search"]["exhausted"])

    def test_exec(self):
        done = self.call("exec", "--json", "--", "/bin/sh", "-c", "echo said; exit 3")
        self.assertEqual((done.returncode, done.stderr.splitlines()[0]), (3, "said"))
        self.assertEqual(self.document("exec", "--", "/bin/sh", "-c", "exit 3", status=3)["exit_status"], 3)
        self.assertEqual(self.document("exec", "--", self.program, "one lock")["threads"], 3)
        self.assertNotIn("failed", self.document("exec", "--seeds", "1..3", "--", self.program, "one lock"))

    def test_exec_of_a_program_that_a_signal_ends(self):
        for name, number in (("SIGKILL", 9), ("SIGTERM", 15), ("SIGSEGV", 11)):
            done = self.call("exec", "--json", "--", sys.executable, "-c", f"import os; os.kill(os.getpid(), {number})")
            self.assertEqual(done.returncode, -number)
            result = self.checked("exec", done.stdout, 128 + number)
            self.assertEqual((result["signal"], result.get("exit_status")), (name, None))


if __name__ == "__main__":
    unittest.main()
