# SPDX-License-Identifier: BSD-3-Clause
"""Shells and their children, in one simulation: shells_test.py BUILD.

Their output is as natively; equal seeds give equal runs, with one digest for all processes.
"""

import pathlib
import tempfile
import unittest

from family_case import Families, PYTHON


class Shells(Families):
    def test_pipelines(self):
        tree = pathlib.Path(__file__).resolve().parent
        runs = self.assertNative("sh", "-c", f"cd {tree} && cat *.c | sort | uniq -c | sort -rn | head -5; exit 3")
        self.assertGreaterEqual(runs[0].processes, 6)

    def test_a_compressor_with_threads_behind_a_pipe(self):
        tree = pathlib.Path(__file__).resolve().parent
        self.assertRepeats("bash", "-c", f"tar c -C {tree} . | gzip -n | wc -c")

    def test_sleeps_of_all_processes_are_in_one_time(self):
        script = "sleep 2 & for i in 1 2 3; do sleep 1; echo $i at $(date +%s); done; wait; date +%s"
        begin = 1704067200  # 2024-01-01
        for run in self.assertRepeats("sh", "-c", script):
            self.assertEqual(run.output.split(),
                             ["1", "at", f"{begin + 1}", "2", "at", f"{begin + 2}", "3", "at", f"{begin + 3}", f"{begin + 3}"])

    def test_signals_and_statuses(self):
        script = "sleep 100 & kill $!; wait $!; echo $?; (exit 5); echo $?; trap 'echo caught' USR1; kill -USR1 $$; $0 -c 'kill $$'; echo $?"
        for shell in "sh", "bash":
            self.assertNative(shell, "-c", script, shell)

    def test_ids_are_the_same_in_every_run(self):
        self.assertEqual(self.assertRepeats("sh", "-c", "echo $$; sh -c 'echo $$ $PPID'")[0].output.split()[0], "1000")

    def test_here_documents_and_substitutions(self):
        self.assertNative("bash", "-c", "x=$(cat <<END\none\ntwo\nEND\n); echo \"$x\" | while read l; do echo \"<$l>\"; done; read y < <(echo three); echo $y")

    def test_a_script_that_executes_another_program(self):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "wrapper"
            script.write_text('#!/bin/sh\nexec "$@"\n')
            script.chmod(0o755)
            self.assertNative(script, PYTHON, "-c", "import threading; t = threading.Thread(target=print, args=[5]); t.start(); t.join()")

    def test_named_pipes_read_by_streams_of_the_c_library(self):
        script = "cd $0; mkfifo a b; (seq 3; sleep 1; seq 3) > a & sort < a; (seq 3; sleep 1; seq 3) > b & sort b; date +%S > time; rm a b"
        with tempfile.TemporaryDirectory() as folder:
            self.assertNative("sh", "-c", script, folder)
            self.assertEqual(pathlib.Path(folder, "time").read_text(), "02\n")

    def test_processes_left_over_are_ended(self):
        # In 10 s; not a divisor, as some releases of sleep add a nanosecond.
        run = self.assertRepeats("sh", "-c", "(while sleep 0.9; do echo on; done) & echo off", seeds=[1])[0]
        self.assertEqual(run.output.split()[0], "off")
        self.assertEqual(run.output.split().count("on"), 11)


if __name__ == "__main__":
    unittest.main()
