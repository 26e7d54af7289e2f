# SPDX-License-Identifier: BSD-3-Clause
"""Misuses of primitives and threads in unmodified programs: misuse_test.py BUILD."""

import subprocess
import unittest

from exec_case import ExecCase, WAITPOINT

MISUSES = {
    "unlocked by another": ("thread 1 unlocks mutex mutex, locked by main", "unlock"),
    "unlocked twice": ("main unlocks mutex mutex, which is not locked", "main"),
    "destroyed while locked": ("main destroys mutex mutex, locked by main", "main"),
    "locked when destroyed": ("main locks mutex mutex, which was destroyed", "main"),
    "locked when freed": ("thread 1 locks mutex at 0x[0-9a-f]+, whose memory was freed", "lock_and_unlock"),
    "two mutexes": ("thread 2 waits for condition variable condition with another mutex than those that wait already", "wait_with"),
    "waits without mutex": ("main waits for a condition with mutex mutex, which it has not locked", "main"),
    "condition destroyed": ("main destroys condition variable condition, awaited by thread 1", "main"),
    "semaphore destroyed": ("main destroys semaphore semaphore, awaited by thread 1", "main"),
    "rwlock unlocked by another": ("thread 1 unlocks read-write lock rwlock, locked by main", "unlock_rwlock"),
    "joined twice": ("main joins a thread that was joined before, or has ended detached", "main"),
    "joined when detached": ("main joins a detached thread", "main"),
}


class Misuse(ExecCase):
    def setUp(self):
        self.program = self.compile("misuse.c", "-g", "-O0")

    def run_it(self, command, *words):
        return self.run_words(WAITPOINT, *command, "--", self.program, *words)

    def run_words(self, *words):
        return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=120)

    def test_is_reported_with_its_place_and_the_program_continues(self):
        for way, (sentence, function) in MISUSES.items():
            done = self.run_it(["exec"], way)
            self.assertEqual(done.returncode, 0, way + done.stderr)
            self.assertRegex(done.stderr, rf"(?m)^misuse at \d\.\d+ s: {sentence}\n    at {function} at .*misuse\.c:\d+$", way)

    def test_is_a_failure_of_a_schedule(self):
        for way in ("unlocked by another", "locked when freed"):
            done = self.run_it(["explore"], way)
            self.assertEqual(done.returncode, 1, way)
            self.assertRegex(done.stdout, rf"failed at \S+ s: misuse: {MISUSES[way][0]}\n", way)

    def test_is_the_destruction_of_an_object_that_a_thread_is_about_to_use(self):
        done = self.run_it(["explore", "--iterations", "300"], "destroyed meanwhile")
        self.assertRegex(done.stdout, r": 300 schedules, \d+ distinct, \d+ failed")
        self.assertRegex(done.stdout, "misuse: thread 1 locks (read-write lock rwlock|mutex mutex), which was destroyed")

    def test_does_not_end_a_search(self):
        done = self.run_it(["explore", "--iterations", "300"], "beside a crash")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r" failed at \S+ s: terminated by signal 4 \(Illegal instruction\)\n")
        self.assertRegex(done.stdout, r"also found, by the default order: misuse: main unlocks mutex mutex, which is not locked\nreplay: ")

    def test_is_not_the_reuse_of_memory(self):
        done = self.run_it(["exec"])
        self.assertEqual((done.returncode, "misuse at" in done.stderr), (0, False), done.stderr)
        done = self.run_it(["explore", "--iterations", "100"])
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_is_not_another_mutex_after_a_signal(self):
        for seed in range(1, 4):
            done = self.run_it(["exec", "--seed", seed], "another mutex afterwards")
            self.assertEqual((done.returncode, "misuse at" in done.stderr), (0, False), done.stderr)

    def test_is_not_reported_for_an_allocator_without_sizes(self):
        allocator = self.compile("guarding_allocator.c", "-shared", "-fPIC", "-fno-builtin")
        command = [WAITPOINT, "exec", "--", "env", f"LD_PRELOAD={allocator}", self.program]
        done = self.run_words(*command)
        self.assertEqual((done.returncode, "misuse at" in done.stderr), (0, False), done.stderr)
        done = self.run_words(*command, "locked when freed")
        self.assertIn("misuse at", done.stderr)


if __name__ == "__main__":
    unittest.main()
