# SPDX-License-Identifier: BSD-3-Clause
"""Runs do not depend on the kind of their standard streams: streams_test.py BUILD."""

import concurrent.futures
import os
import pty
import re
import subprocess
import threading
import unittest

from exec_case import ExecCase, Summary, WAITPOINT, explore, replay_words

# Fails in each of these ways, having written to both streams.
FAILING = r"""
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
int main(int count, char** words) {
  const char* way = words[1];
  if (write(1, "begin\n", 6) < 0 || write(2, "begin\n", 6) < 0) return 9;
  if (isatty(1)) return 8;
  for (int i = 0; strcmp(way, "much") == 0 && i < 3000; ++i) printf("line %d of a text that no pipe holds\n", i);
  if (strcmp(way, "status") == 0) return 3;
  assert(strcmp(way, "assert") != 0);
  if (strcmp(way, "address") == 0) *(volatile int*)8 = 1;
  abort();
}
"""
WAYS = "abort", "status", "assert", "address", "much"
FAMILIES = ("sh -c '{}'", "sh -c '{}; exit $?'", "sh -c 'echo start; {}; echo end >&2; exit 4'", "sh -c '{} | cat; exit 5'",
            "sh -c '{} & wait $!'", "sh -c '(sleep 1; {} 2>&1) >&2; exit 6'", "env {}", "bash -c 'for i in 1 2; do {}; done'")


def with_terminal(words):
    """The status and the output of a process whose three streams are one terminal."""
    outer, inner = pty.openpty()
    output = bytearray()

    def read():
        try:
            while part := os.read(outer, 65536):
                output.extend(part)
        except OSError:
            pass  # all that had the terminal have ended

    process = subprocess.Popen(words, stdin=inner, stdout=inner, stderr=inner)
    os.close(inner)
    reader = threading.Thread(target=read)
    reader.start()
    status = process.wait(timeout=120)
    reader.join()
    os.close(outer)
    return status, output.decode(errors="replace")


class Streams(ExecCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.program = cls.folder / "failing"
        subprocess.run(["gcc", "-O1", "-g", "-x", "c", "-", "-o", cls.program], input=FAILING, text=True, check=True)

    def replays(self, words):
        """Status and standard error of the replay with each kind of streams."""
        command = [WAITPOINT, "explore", *words]
        with open(os.devnull) as nothing, open(self.folder / f"output {threading.get_ident()}", "w+") as file:
            done = subprocess.run(command, stdin=nothing, stdout=file, stderr=subprocess.STDOUT, timeout=120)
            file.seek(0)
            yield "file", done.returncode, file.read()
        done = subprocess.run(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
        yield "pipe", done.returncode, done.stdout.decode(errors="replace")
        yield "terminal", *with_terminal(command)
        shell = ["sh", "-c", 'exec "$@" <&- >&- 2>"$0"', str(self.folder / f"errors {threading.get_ident()}"), *command]
        status = subprocess.run(shell, timeout=120).returncode
        with open(shell[3], errors="replace") as errors:
            yield "closed", status, errors.read()

    def find_and_replay(self, family, way):
        words = family.format(f"{self.program} {way}")
        found = explore("--iterations", "2", "--", *(["sh", "-c", words] if not words.startswith("env") else words.split()))
        self.assertEqual(found.returncode, 1, found.stderr)
        return list(self.replays(replay_words(found.stdout)))

    def test_files_pipes_terminals_and_none_replay_a_failure_of_a_family(self):
        cases = [(family, way) for family in FAMILIES for way in WAYS]
        self.assertEqual(len(cases), 40)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            ended = {case: pool.submit(self.find_and_replay, *case) for case in cases}
            for case, replays in ended.items():
                for kind, status, text in replays.result():
                    with self.subTest(family=case[0], way=case[1], streams=kind):
                        self.assertEqual(status, 1, text)
                        self.assertIn("waitpoint: the same run as in the record", text)
                        self.assertTrue("begin" in text or kind == "closed", text)

    def test_files_pipes_and_terminals_leave_the_digest_of_a_run(self):
        words = ["sh", "-c", "for i in 1 2 3; do echo $i; (echo $i >&2; sleep 0.1; echo $i) & done; wait"]
        command = [WAITPOINT, "exec", "--seed", "5", "--", *words]
        texts = {}
        for kind in "file", "pipe", "nothing":
            with open(self.folder / "output" if kind == "file" else os.devnull, "w") as file:
                done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE if kind == "pipe" else file,
                                      stderr=subprocess.PIPE, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            texts[kind] = done.stderr
        texts["terminal"] = with_terminal(["sh", "-c", '"$@" </dev/null', "sh", *command])[1]
        digests = {kind: Summary(text).digest for kind, text in texts.items()}
        self.assertEqual(len(set(digests.values())), 1, digests)


if __name__ == "__main__":
    unittest.main()
