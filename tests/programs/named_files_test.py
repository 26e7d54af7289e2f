# SPDX-License-Identifier: BSD-3-Clause
"""The files that a scenario names: named_files_test.py BUILD [CLASS[.TEST]...].

strace is the oracle: what it shows as opened or executed below the scenarios' folder is what `check --files` lists. Outputs never replace
a file of the list.
"""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import generated_scenarios  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
WAITPOINT = BUILD / "tools/waitpoint"
PROGRAMS = BUILD / "tests/exec/several"
ROOT = pathlib.Path(__file__).resolve().parents[2]
OPENED = re.compile(r'\b(?:openat\(AT_FDCWD, |open\(|execve\()"([^"]*)"(.*)\) += (?:\d+)$')


def waitpoint(*words, cwd=None, before=()):
    return subprocess.run([*before, WAITPOINT, *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=cwd)


def parts():
    """The parts of this build that generated scenarios need."""
    found = {"tcl"} if (BUILD / "libwaitpoint-tcl.so").exists() else set()
    with tempfile.TemporaryDirectory() as folder:
        mesh, scenario = pathlib.Path(folder, "m.gltf"), pathlib.Path(folder, "s.yaml")
        mesh.write_text(generated_scenarios.gltf(generated_scenarios.inline(struct.pack("<9f", 0, 0, 0, 2, 0, 0, 0, 3, 0))))
        scenario.write_text("format: 1\nworld: {shapes: [{mesh: m.gltf, at_m: [20, 20]}]}\n"
                            "robots: [{name: a, start: [0, 0, 0], shape: {radius_m: 0.2, height_m: 1}}]\n")
        return found | ({"gltf"} if waitpoint("check", scenario).returncode == 0 else set())


HAS = parts()


def traced(trace, cwd, *words):
    """The command's end, and the regular files that it and its children opened or executed, without links."""
    for old in trace.parent.glob(trace.name + ".*"):
        old.unlink()
    # A file for each process: in one, a call that another's interrupts has two lines.
    done = waitpoint(*words, cwd=cwd, before=["strace", "-ff", "-qq", "-s", "4096", "-o", trace, "-e", "trace=openat,open,execve"])
    lines = [line for one in trace.parent.glob(trace.name + ".*") for line in one.read_text(errors="replace").splitlines()]
    names = [found[1] for found in map(OPENED.search, lines) if found and "O_DIRECTORY" not in found[2]]
    paths = {pathlib.Path(os.path.realpath(cwd / name)) for name in names}
    return done, {path for path in paths if path.is_file()}


def below(folder, paths):
    return {str(path.relative_to(folder)) for path in paths if path.is_relative_to(folder)}


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name).resolve()

    def listed(self, scenario, cwd, *words):
        """The files of `check --files` by their use, without links."""
        done = waitpoint("check", "--files", "--json", scenario, *words, cwd=cwd)
        if done.returncode != 0:
            return None
        files = json.loads(done.stdout)["result"]["files"]
        lines = [line for line in done.stderr.splitlines() if re.match(r"  (read|executed|written|folder) ", line)]
        self.assertEqual(lines, [f"  {file['use']:<9} {file['name']}" for file in files])
        uses = {}
        for file in files:
            uses.setdefault(file["use"], set()).add(pathlib.Path(os.path.realpath(cwd / file["name"])))
        return uses


@unittest.skipUnless(shutil.which("strace"), "without strace")
class List(Folder):
    def compare(self, scenario, top, *words):
        """Compares the list with what strace shows below `top`; False if the scenario cannot be checked."""
        uses = self.listed(scenario, top, *words)
        if uses is None:
            return False
        read = below(top, uses["read"])
        done, opened = traced(self.folder / "trace", top, "check", "--files", scenario, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        # A shared object is loaded by a check already, a process is not started.
        opened_below = below(top, opened) - below(top, uses.get("executed", set()))
        self.assertEqual(opened_below, read, scenario)
        if any(use in uses for use in ("executed", "folder")):
            return True
        done, opened = traced(self.folder / "trace", top, "run", scenario, "--until", "0.02", *words)
        if "ROS nodes are not in this program" in done.stderr:
            return True
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertEqual(below(top, opened), read, scenario)
        return True

    def test_shipped_scenarios_list_the_opened_files(self):
        shipped = pathlib.Path(os.path.realpath(ROOT / "scenarios"))
        compared = [path.name for path in sorted(shipped.glob("*.yaml")) if self.compare(path.name, shipped)]
        self.assertLessEqual({"office.yaml", "office-10.yaml", "office-plan.yaml", "office-ros.yaml", "yard.yaml"}, set(compared))

    def test_generated_scenarios_list_the_opened_files(self):
        count = int(os.environ.get("WAITPOINT_GENERATED", "40"))
        for seed in range(count):
            with self.subTest(seed=seed):
                top = self.folder / str(seed)
                top.mkdir()
                scenario = generated_scenarios.write(top, seed, HAS)
                self.assertTrue(self.compare(scenario, top), waitpoint("check", scenario).stderr)

    @unittest.skipUnless((PROGRAMS / "writer.so").exists(), "without programs of robots")
    def test_programs_are_listed_as_executed(self):
        top = self.folder / "top"
        top.mkdir()
        shutil.copy(PROGRAMS / "writer.so", top)
        shutil.copy("/bin/true", top / "own")
        for programs, executed in (("{name: a, file: writer.so, arguments: [1, 2]}", {"writer.so"}), ("{name: a, command: [./own]}", {"own"})):
            for hosting in ("processes", "in-process") if "writer" in programs else ("processes",):
                (top / "s.yaml").write_text(f"format: 1\nuntil_s: 0.1\nhosting: {hosting}\nrobots: [{{name: ada, start: [0, 0, 0], "
                                            f"shape: {{radius_m: 0.2, height_m: 1}}, programs: [{programs}]}}]\n")
                uses = self.listed("s.yaml", top)
                self.assertEqual((below(top, uses["read"]), below(top, uses["executed"])), ({"s.yaml"}, executed), programs)
                opened = traced(self.folder / "trace", top, "run", "s.yaml")[1]
                self.assertEqual(below(top, opened), {"s.yaml"} | executed, programs)


def file_options(command):
    """The options of a command that name files, with the ending of their placeholder."""
    text = waitpoint(command, "--help-all").stdout
    return re.findall(r"^  (--[\w-]+) (?:TOKEN\||PREFIX|)FILE(\.\w+)?\b", text, re.MULTILINE)


LOG = "".join(f"FLASER 5 2 2 2 2 2 {i * 0.1} 0 0 {i * 0.1} 0 0 {i * 0.2} host {i * 0.2}\n" for i in range(5))
PLAN = ROOT / "scenarios/plans/guide.yaml"


class Outputs(Folder):
    def setUp(self):
        super().setUp()
        self.top = self.folder / "top"
        self.top.mkdir()

    def try_each_option(self, command, words, victims):
        """Each option that names a file, with a link to each victim as its value."""
        before = {victim: victim.read_bytes() for victim in victims}
        options = file_options(command)
        self.assertTrue(options, command)
        for option, ending in options:
            for number, victim in enumerate(victims):
                link = self.folder / f"to-victim-{number}{ending}"
                if not link.is_symlink():
                    link.symlink_to(victim)
                files = sorted(self.top.rglob("*"))
                done = waitpoint(command, *words, option, link)
                with self.subTest(command=command, option=option, victim=victim.name):
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertEqual(victim.read_bytes(), before[victim])
                    self.assertEqual(sorted(self.top.rglob("*")), files)

    def test_replace_no_file_of_the_scenario(self):
        scenario = generated_scenarios.write(self.top, 2, HAS)
        victims = sorted(self.listed(scenario, self.top)["read"])
        self.assertGreater(len(victims), 4)
        self.try_each_option("run", [scenario, "--until", "0.02"], victims)
        self.try_each_option("explore", [scenario, "--until", "0.02", "--iterations", "2"], victims)

    def test_replace_no_log_and_no_file_of_its_scenario(self):
        log, other = self.top / "a.log", self.top / "b.log"
        log.write_text(LOG)
        other.write_text(LOG)
        types = self.top / "types.yaml"
        types.write_text("format: 1\nrobot_types: {kind: {shape: {radius_m: 0.2, height_m: 1}, modules: [{name: rflex}, {name: sick}]}}\n")
        scenario = self.top / "s.yaml"
        scenario.write_text("format: 1\nrobot_types: {include: types.yaml}\nrobots: [{name: a, type: kind, start: [0, 0, 0]}]\n")
        given = ["--scenario", scenario]
        for command, words, read in (("play", [log], [log]), ("compare", [log, other], [log, other]), ("fit", [log], [log])):
            self.try_each_option(command, [*words, *given], [*read, scenario, types])

    def test_replace_no_plan(self):
        plan = self.top / "plan.yaml"
        plan.write_bytes(PLAN.read_bytes())
        self.try_each_option("plan", [plan], [plan])

    def test_trajectories_replace_no_file_of_the_scenario(self):
        scenario = generated_scenarios.write(self.top, 2, HAS)
        victim = sorted(self.listed(scenario, self.top)["read"])[0]
        before = victim.read_bytes()
        for name in ("t.tum", "t.estimated.tum", "t.odometry.tum"):
            link = self.folder / name
            link.symlink_to(victim)
            done = waitpoint("run", scenario, "--until", "0.02", "--trajectory", self.folder / "t.tum")
            self.assertEqual((done.returncode, victim.read_bytes()), (2, before), done.stderr)
            link.unlink()

    @unittest.skipUnless("tcl" in HAS, "without Tcl")
    def test_replace_no_file_of_a_running_script(self):
        scenario = self.top / "s.yaml"
        scenario.write_text("format: 1\nuntil_s: 1\nrobots: [{name: a, start: [0, 0, 0], shape: {radius_m: 0.2, height_m: 1}, executive: {tcl: s.tcl}}]\n")
        for mode, contents in (("r", "old"), ("w", "new")):
            (self.top / "data").write_text("old")
            (self.top / "s.tcl").write_text(f"set file [open data {mode}]\ncatch {{puts -nonewline $file new}}\nclose $file\n")
            self.assertEqual(waitpoint("run", scenario).returncode, 0)
            self.assertEqual((self.top / "data").read_text(), contents)
            (self.top / "data").write_text("old")
            done = waitpoint("run", scenario, "--picture", self.top / "data")
            self.assertIn("cannot be an output", done.stderr)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual((self.top / "data").read_text(), "old")


if __name__ == "__main__":
    unittest.main()
