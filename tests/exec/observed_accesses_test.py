# SPDX-License-Identifier: BSD-3-Clause
"""All schedules at calls are all orders only if threads share memory by calls alone: observed_accesses_test.py BUILD."""

import json
import subprocess
import unittest

from exec_case import BUILD, WAITPOINT, ExecCase, explore

OBSERVED = "the program's own code shares no other memory in 20 schedules with accesses observed"
DOUBTED = "all schedules, but perhaps not all orders: no call orders the "

THREADS = """
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
%s
int main(void) {
  pthread_t one, two;
  pthread_create(&one, NULL, run, (void*)0L), pthread_create(&two, NULL, run, (void*)1L);
  pthread_join(one, NULL), pthread_join(two, NULL);
  return 0;
}
"""
LOCKED = THREADS % """
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int counter;
static void* run(void* none) {
  pthread_mutex_lock(&mutex);
  ++counter;
  pthread_mutex_unlock(&mutex);
  return none;
}"""
UNLOCKED = THREADS % """
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int other, counter;
static void* run(void* none) {
  ++counter;
  pthread_mutex_lock(&mutex);
  ++other;
  pthread_mutex_unlock(&mutex);
  return none;
}"""


class ObservedAccesses(ExecCase):
    def setUp(self):
        super().setUp()
        help_text = subprocess.run([WAITPOINT, "explore", "--switch-at", "accesses", "--iterations", "1", "--", "true"], capture_output=True, text=True).stderr
        if "Zydis" in help_text or not (BUILD / "libwaitpoint-exec-races.so").exists():
            self.skipTest("this build has no disassembler")

    def summary(self, source, *options, suffix=".c"):
        file, program = self.folder / f"shared{suffix}", self.folder / "shared"
        file.write_text(source)
        subprocess.run(["g++" if suffix == ".cpp" else "gcc", "-g", "-O1", "-pthread", file, "-o", program], check=True)
        done = explore("--switch-at", "calls", "--iterations", "4000", *options, "--", program)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_memory_behind_locks_is_no_other_sharing(self):
        for strategy in ("dpor", "portfolio"):
            text = self.summary(LOCKED, "--strategy", strategy)
            self.assertRegex(text, f"exhaust.*, switching at calls, {OBSERVED}\n$")

    def test_an_access_without_a_lock_is_named_with_its_variable(self):
        for strategy in ("dpor", "portfolio"):
            text = self.summary(UNLOCKED, "--strategy", strategy)
            self.assertNotIn("exhaust", text, strategy)
            self.assertRegex(text, DOUBTED + r"\w+ at \S*shared.c:10 and the \w+ at \S*shared.c:10 \(counter\)\n")

    def test_documents_have_the_reason(self):
        search = json.loads(self.summary(UNLOCKED, "--strategy", "dpor", "--json"))["result"]["search"]
        self.assertFalse(search["exhausted"])
        self.assertIn("(counter)", search["unproved"])
        search = json.loads(self.summary(LOCKED, "--strategy", "dpor", "--json"))["result"]["search"]
        self.assertTrue(search["exhausted"])
        self.assertIn(OBSERVED, search["scope"])

    def test_atomic_operations_are_no_calls(self):
        text = self.summary(THREADS % """
            static int counter;
            static void* run(void* none) { __atomic_fetch_add(&counter, 1, __ATOMIC_SEQ_CST); return none; }""", "--strategy", "dpor")
        self.assertIn(DOUBTED, text)

    def test_calls_that_order_threads_order_their_accesses(self):
        by_pipe = """
            #include <pthread.h>
            #include <unistd.h>
            static int ends[2], data;
            static void* take(void* none) { char c; if (read(ends[0], &c, 1) == 1) data += 1; return none; }
            int main(void) {
              pthread_t taker;
              if (pipe(ends) != 0) return 1;
              pthread_create(&taker, NULL, take, NULL);
              data = 5;
              if (write(ends[1], "x", 1) != 1) return 1;
              pthread_join(taker, NULL);
              return data != 6;
            }"""
        by_once = THREADS % """
            static pthread_once_t once = PTHREAD_ONCE_INIT;
            static int made;
            static void make(void) { made = 7; }
            static void* run(void* none) { pthread_once(&once, make); if (made != 7) abort(); return none; }"""
        by_condition = THREADS % """
            static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
            static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;
            static int is_there, data;
            static void* run(void* which) {
              if (which == NULL) data = 3;
              pthread_mutex_lock(&mutex);
              if (which == NULL) is_there = 1, pthread_cond_signal(&changed);
              while (which != NULL && !is_there) pthread_cond_wait(&changed, &mutex);
              pthread_mutex_unlock(&mutex);
              if (data != 3) abort();
              return NULL;
            }"""
        static_variable = """
            #include <thread>
            static int draw() { static int made = 4; return made; }
            static int used() { static const int made = draw(); return made; }
            int main() {
              std::thread one([] { if (used() != 4) __builtin_abort(); });
              const int seen = used();
              one.join();
              return seen != 4;
            }"""
        for source, suffix in ((by_pipe, ".c"), (by_once, ".c"), (by_condition, ".c"), (static_variable, ".cpp")):
            text = self.summary(source, "--strategy", "dpor", suffix=suffix)
            self.assertIn(OBSERVED, text, source)

    def test_memory_of_the_heap_has_one_thread_after_the_other(self):
        text = self.summary(THREADS % """
            static void* run(void* none) {
              int* const own = malloc(64);
              *own = 5;
              if (*own != 5) abort();
              free(own);
              return none;
            }""", "--strategy", "dpor")
        self.assertIn(OBSERVED, text)

    def test_several_processes_have_an_assumption(self):
        text = self.summary("#include <sys/wait.h>\n#include <unistd.h>\nint made;\nint main(void) {\n  made = 1;\n  if (fork() == 0) _exit(0);\n"
                            "  return wait(NULL) < 0;\n}\n")
        self.assertIn("if threads share memory by calls alone (accesses were not observed: the program has several processes)", text)


if __name__ == "__main__":
    unittest.main()
