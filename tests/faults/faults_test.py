# SPDX-License-Identifier: BSD-3-Clause
"""Every output file is whole or as it was, whichever system call fails while it is written: faults_test.py BUILD [--all].

failing-calls runs a command, numbers its calls on the files of a folder, and lets one of them fail. A command is run once for
each of its calls, each with another error; with --all with every error that suits the call. Exits with 77, skipped, where
processes cannot be traced.
"""

import concurrent.futures
import dataclasses
import errno
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ALL = "--all" in sys.argv and not sys.argv.remove("--all")
HERE = pathlib.Path(__file__).resolve().parent
WAITPOINT = BUILD / "tools/waitpoint"
FAILING_CALLS = BUILD / "tests/faults/failing-calls"
SCENARIO = HERE / "short.yaml"
MARK = ".waitpoint-"
OLD = b"from an earlier run\n"

# A plus: later calls of the kind fail, too.
EFFECTS = {
    "open": ["ENOSPC", "EINTR", "EACCES", "EROFS", "EDQUOT", "ENFILE", "EIO"],
    "write": ["ENOSPC+", "EINTR", "EIO", "short+", "EDQUOT+", "ENOSPC", "short", "EFBIG+", "EINTR"],
    "lseek": ["EINVAL", "EIO"],
    "ftruncate": ["EIO"],
    "sync": ["EIO"],
    "chmod": ["EIO"],
    "close": ["EIO", "EDQUOT", "EINTR", "ENOSPC"],
    "rename": ["EIO", "ENOSPC", "EINTR", "EACCES", "EDQUOT"],
    "flock": ["ENOLCK", "EINTR"],
}
RETRIED = ("EINTR", "short", "short+")
# The wall clock's figures: of a summary as JSON, as text, and in a table of seeds.
UNREPEATABLE = re.compile(rb'"(?:wall_s|real_time_factor)": [-+.\de]+|[.\d]+ times real time \([.\d]+ s\)| +[.\d]+(?=  wp1:)')


@dataclasses.dataclass
class Outcome:
    status: int
    errors: list  # lines
    files: dict  # contents by name
    calls: list = dataclasses.field(default_factory=list)  # (kind, file)


def environment():
    return {**os.environ, "LC_ALL": "C"}


def repeatable(text):
    return UNREPEATABLE.sub(b"", text)


def contents(folder):
    return {path.name: repeatable(path.read_bytes()) for path in folder.iterdir()}


class Command:
    """A command line whose words with FOLDER/ name its output files."""

    def __init__(self, *words, to_file=False):
        self.words = [str(word) for word in words]
        self.to_file = to_file  # standard output, too

    def run(self, position=0, effect="-", old=False, names=()):
        """`old`: the files of these names exist before."""
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made).resolve() / "out"
            folder.mkdir()
            for name in names if old else ():
                (folder / name).write_bytes(OLD)
            log = folder.parent / "calls"
            own_words = [word.replace("FOLDER", str(folder)) for word in self.words]
            words = [FAILING_CALLS, folder, log, str(position), effect, *own_words]
            with open(folder / "stdout" if self.to_file else os.devnull, "wb") as output:
                done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, timeout=120,
                                      env=environment())
            calls = [tuple(line.split(" ", 1)) for line in log.read_text().splitlines()]
            return Outcome(done.returncode, repeatable(done.stderr).decode().replace(str(folder), "FOLDER").splitlines(),
                           contents(folder), calls)


def error_text(effect):
    return os.strerror(getattr(errno, effect.rstrip("+")))


def run(*options, **more):
    return Command(WAITPOINT, "run", SCENARIO, *options, **more)


TEXT_FILES = ["--summary", "FOLDER/s.json", "--picture", "FOLDER/p.svg", "--trajectory", "FOLDER/t.tum", "--digests",
              "FOLDER/digests", "--events", "FOLDER/events", "--journal", "FOLDER/journal", "--record-durations",
              "FOLDER/durations"]


GROWING = "results"  # has its name from the beginning, and may end at each line


class Faults(unittest.TestCase):
    faults = 0  # injected so far

    @classmethod
    def setUpClass(cls):
        tried = subprocess.run([FAILING_CALLS, tempfile.gettempdir(), os.devnull, "0", "-", "true"], capture_output=True) \
            if FAILING_CALLS.exists() else None
        if tried is None or tried.returncode != 0:
            print("processes cannot be traced here", flush=True)
            os._exit(77)

    def whole(self, command, status=0):
        """The outcome without faults, which repeats."""
        good = command.run()
        self.assertEqual(good.status, status, good.errors)
        self.assertTrue(good.calls)
        return good

    def walk(self, command, status=0, bad_status=2, stride=1, of_library=False):
        """`of_library`: by a library that may give up when a signal interrupts it, and may not need each lseek()."""
        good = self.whole(command, status)
        jobs = []
        for position, (kind, name) in enumerate(good.calls, 1):
            effects = EFFECTS[kind]
            chosen = effects if ALL else [effects[position // stride % len(effects)]] if position % stride == 0 else []
            jobs += [(position, kind, name, effect) for effect in chosen]
        Faults.faults += len(jobs)
        outputs = sorted(name for name in good.files if name != "stdout")
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            outcomes = pool.map(lambda job: command.run(job[0], job[3], job[0] % 2 == 0, outputs), jobs)
            for (position, kind, name, effect), outcome in zip(jobs, outcomes):
                with self.subTest(position=position, kind=kind, name=name, effect=effect):
                    self.check(outcome, good, kind, name, effect, OLD if position % 2 == 0 else None, bad_status, of_library)

    def check(self, outcome, good, kind, name, effect, old, bad_status, of_library):
        for made in outcome.files:
            self.assertNotIn(MARK, made, "a temporary file is left")
        # Neither loses data: a lock that cannot be had, and the closing of what has its name.
        harmless = kind == "flock" or (kind == "close" and MARK not in name and name not in ("stdout", GROWING))
        is_retried = effect in RETRIED
        if of_library and (effect == "EINTR" or kind == "lseek"):
            is_retried = outcome.status == good.status
        if is_retried or harmless:
            self.assertEqual((outcome.status, outcome.errors, outcome.files), (good.status, good.errors, good.files))
            return
        if GROWING in good.files:
            grown = outcome.files.get(GROWING, old)
            self.assertTrue(grown in (old, None) or good.files[GROWING].startswith(grown), grown)
        for file in set(good.files) - {"stdout", GROWING}:
            self.assertIn(outcome.files.get(file), (old, good.files[file]), f"{file} is neither old nor new")
        new_lines = [line for line in outcome.errors if line not in good.errors]
        self.assertEqual((outcome.status, len(new_lines)), (bad_status, 1), outcome.errors)
        shown = "standard output" if name == "stdout" else "FOLDER/" + name.partition(MARK)[0]
        if effect.endswith("+"):
            shown = f"({shown}|FOLDER/[^:]+)"
        reasons = error_text(effect) + ("|its index cannot be read back" if of_library else "")
        self.assertRegex(new_lines[0], f"^waitpoint: {shown}: cannot be written: ({reasons})$")


class OfRuns(Faults):
    def test_in_files_of_text(self):
        self.walk(run(*TEXT_FILES, to_file=True))

    def test_in_a_summary_of_many_runs(self):
        self.walk(run("--seeds", "1..2", "--summary", "FOLDER/s.json", to_file=True))

    def test_in_a_recording_for_foxglove(self):
        self.walk(run("--record", "FOLDER/r.mcap"))

    def test_in_a_recording_for_carmen(self):
        self.walk(run("--record", "FOLDER/r.log"))

    def test_in_a_ros_bag(self):
        bag = run("--record", "FOLDER/r.bag")
        if any("./dev add bags" in line for line in bag.run().errors):
            self.skipTest("this waitpoint was built without rosbag_storage")
        self.walk(bag, stride=1 if ALL else 3, of_library=True)

    def test_in_standard_output_as_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder) / "log"
            log.write_text("earlier line\n")
            with open(log, "a") as output:
                words = [WAITPOINT, "run", SCENARIO, "--summary", "-"]
                subprocess.run(words, stdout=output, stderr=subprocess.DEVNULL, check=True)
            first, _, rest = log.read_text().partition("\n")
            self.assertEqual((first, json.loads(rest)["outcome"]), ("earlier line", "time limit"))

    def test_in_the_journal_of_a_replay(self):
        with tempfile.TemporaryDirectory() as folder:
            journal = pathlib.Path(folder) / "journal"
            subprocess.run([WAITPOINT, "run", SCENARIO, "--journal", journal], capture_output=True, check=True)
            self.walk(run("--replay-journal", journal, "--journal", "FOLDER/again", to_file=True))


class OfOtherCommands(Faults):
    def test_in_files_of_explore(self):
        self.walk(Command(WAITPOINT, "explore", SCENARIO, "--property", "goals_reached=1", "--iterations", "2", "--results",
                          "FOLDER/results", "--schedule", "FOLDER/schedule", "--trace", "FOLDER/trace.json"), status=1)

    def test_in_the_trace_of_a_replay(self):
        with tempfile.TemporaryDirectory() as folder:
            words = [WAITPOINT, "explore", SCENARIO, "--property", "goals_reached=1", "--schedule", f"{folder}/schedule"]
            self.assertEqual(subprocess.run(words, capture_output=True).returncode, 1)
            self.walk(Command(*words[:-2], "--replay", f"{folder}/schedule", "--trace", "FOLDER/trace.json"), status=1)

    def test_in_files_of_exploring_a_program(self):
        self.require_exec()
        self.walk(Command(WAITPOINT, "explore", "--iterations", "2", "--results", "FOLDER/results", "--schedule",
                          "FOLDER/schedule", "--trace", "FOLDER/trace.json", "--", "false"), status=1)

    def require_exec(self):
        if not (BUILD / "libwaitpoint-exec.so").exists():
            self.skipTest("this waitpoint was built without exec")

    def test_in_the_trace_of_exec(self):
        self.require_exec()
        self.walk(Command(WAITPOINT, "exec", "--trace", "FOLDER/trace.json", "--", "true"), bad_status=125)

    def test_in_standard_output(self):
        for words in (["check", SCENARIO], ["run", SCENARIO, "--verify"], ["--help"], ["--version"],
                      ["run", SCENARIO, "--summary", "-"]):
            self.walk(Command(WAITPOINT, *words, to_file=True))


class FullDisks(Faults):
    """Not one failing call, but all from the limit on, as the system has it."""

    RECORDINGS = [["--record", f"FOLDER/r.{kind}"] for kind in ("mcap", "log", "bag")]

    def check_full(self, words, prepare, error):
        command = run(*words)
        good = self.whole(command)
        greatest = max(len(content) for content in good.files.values())
        for limit in sorted({0, 1, 4096, greatest // 2, greatest - 1}):
            with self.subTest(words=words, limit=limit), tempfile.TemporaryDirectory() as made:
                folder = pathlib.Path(made) / "out"
                folder.mkdir()
                for name in good.files:
                    (folder / name).write_bytes(b"")
                done = subprocess.run([word.replace("FOLDER", str(folder)) for word in command.words], capture_output=True,
                                      text=True, env=environment(), preexec_fn=lambda: prepare(limit))
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
                self.assertRegex(done.stderr, rf"^waitpoint: {folder}/[\w.]+: cannot be written: {error}$")
                files = contents(folder)
                self.assertEqual(set(files), set(good.files))
                for name, content in files.items():
                    self.assertIn(content, (b"", good.files[name]))

    def test_as_files_that_may_not_grow(self):
        for words in [TEXT_FILES, *self.RECORDINGS]:
            self.check_full(words, lambda size: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)), "File too large")

    def test_as_a_full_file_system(self):
        if subprocess.run(["unshare", "-rm", "true"], capture_output=True).returncode != 0:
            self.skipTest("no file system can be mounted here")
        for words in [TEXT_FILES, *self.RECORDINGS]:
            command = run(*words)
            good = self.whole(command)
            with self.subTest(words=words), tempfile.TemporaryDirectory() as folder:
                # A page is taken by what was there before.
                name = min(good.files)
                script = f"""mount -t tmpfs -o size=16k none {folder} && cd {folder} && mkdir out && echo old >out/{name} &&
                    "$@"; echo "status $?"; ls out; cat out/{name}"""
                done = subprocess.run(["unshare", "-rm", "sh", "-c", script, "sh",
                                       *(word.replace("FOLDER", f"{folder}/out") for word in command.words)],
                                      capture_output=True, text=True, env=environment())
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertRegex(done.stderr, rf"^waitpoint: {folder}/out/[\w.]+: cannot be written: No space left on device$")
                after = done.stdout.partition("status 2\n")[2].splitlines()
                self.assertEqual(after[-1:], ["old"])
                self.assertFalse([name for name in after if MARK in name])

    def test_standard_output(self):
        with open("/dev/full", "wb") as full:
            for words in (["run", SCENARIO], ["run", SCENARIO, "--summary", "-"], ["check", SCENARIO], ["--version"]):
                done = subprocess.run([WAITPOINT, *words], stdout=full, stderr=subprocess.PIPE, text=True, env=environment())
                self.assertEqual(done.returncode, 2)
                self.assertEqual(done.stderr.splitlines()[-1],
                                 "waitpoint: standard output: cannot be written: No space left on device")

    def test_standard_output_with_real_threads(self):
        native = BUILD / "tools/waitpoint-native"
        if not native.exists():
            self.skipTest("this waitpoint was built without real threads")
        with open("/dev/full", "wb") as full:
            for words in (["run", SCENARIO, "--until", "0.1"], ["--help"]):
                done = subprocess.run([native, *words], stdout=full, stderr=subprocess.PIPE, text=True, env=environment())
                self.assertEqual((done.returncode, done.stderr),
                                 (2, "waitpoint: standard output: cannot be written: No space left on device\n"))

    def test_do_not_cost_the_files_theirs_if_only_standard_output_is_full(self):
        with tempfile.TemporaryDirectory() as folder, open("/dev/full", "wb") as full:
            words = [WAITPOINT, "run", SCENARIO, "--events", f"{folder}/events"]
            done = subprocess.run(words, stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(os.listdir(folder), ["events"])

    def test_pipe_without_a_reader(self):
        reading, writing = os.pipe()
        os.close(reading)
        with tempfile.TemporaryDirectory() as folder, open(writing, "wb") as pipe:
            words = [WAITPOINT, "run", SCENARIO, "--events", f"{folder}/events"]
            done = subprocess.run(words, stdout=pipe, stderr=subprocess.PIPE, env=environment())
            self.assertEqual((done.returncode, os.listdir(folder)), (2, ["events"]))
            self.assertEqual(done.stderr, b"waitpoint: standard output: cannot be written: Broken pipe\n")


def tearDownModule():
    print(f"{Faults.faults} runs with a failing call")


if __name__ == "__main__":
    unittest.main()
