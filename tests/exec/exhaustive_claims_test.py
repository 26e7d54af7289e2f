# SPDX-License-Identifier: BSD-3-Clause
"""An exhausted search has tried all orders, also of calls that wait for nothing: exhaustive_claims_test.py BUILD."""

import subprocess
import unittest

from exec_case import ExecCase, explore


class Claims(ExecCase):
    def expect_failure(self, source, suffix=".c", strategies=("dfs", "dpor", "portfolio")):
        """The failing order is found, or none is claimed to be the last."""
        file = self.folder / f"claimed{suffix}"
        file.write_text(source)
        program = self.folder / "claimed"
        subprocess.run(["g++" if suffix == ".cpp" else "gcc", "-g", "-O1", "-pthread", file, "-o", program], check=True)
        for strategy in strategies:
            done = explore("--strategy", strategy, "--no-minimize", "--", program)
            self.assertNotIn("exhaust", done.stdout, strategy)
            self.assertEqual(done.returncode, 1, f"{strategy}: {done.stdout}")

    def test_a_value_that_is_read_depends_on_its_changes(self):
        self.expect_failure("""
            #include <assert.h>
            #include <pthread.h>
            #include <semaphore.h>
            static sem_t units;
            static void* give(void* none) { sem_post(&units); return none; }
            int main(void) {
              pthread_t giver;
              int value;
              sem_init(&units, 0, 0);
              pthread_create(&giver, NULL, give, NULL);
              sem_getvalue(&units, &value);
              assert(value == 0);
              return 0;
            }""")

    def test_a_change_comes_between_two_readings_of_a_value(self):
        self.expect_failure("""
            #include <assert.h>
            #include <pthread.h>
            #include <semaphore.h>
            static sem_t units;
            static void* give(void* none) { for (int i = 0; i < 3; ++i) sem_post(&units); return none; }
            int main(void) {
              pthread_t giver;
              int before, after;
              sem_init(&units, 0, 0);
              pthread_create(&giver, NULL, give, NULL);
              sem_getvalue(&units, &before);
              sem_getvalue(&units, &after);
              pthread_join(giver, NULL);
              assert(before != 1 || after != 2);
              return 0;
            }""")

    def test_a_few_orders_of_many_at_a_value_are_not_taken_for_all(self):
        self.expect_failure("""
            #include <assert.h>
            #include <pthread.h>
            #include <semaphore.h>
            static sem_t units;
            static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
            static void* give(void* none) { for (int i = 0; i < 8; ++i) sem_post(&units); return none; }
            int main(void) {
              pthread_t giver;
              int before, after;
              sem_init(&units, 0, 0);
              pthread_create(&giver, NULL, give, NULL);
              sem_getvalue(&units, &before);
              for (int i = 0; i < 8; ++i) pthread_mutex_lock(&mutex), pthread_mutex_unlock(&mutex);
              sem_getvalue(&units, &after);
              pthread_join(giver, NULL);
              assert(before != 4 || after != 5);
              return 0;
            }""", strategies=("dpor", "portfolio"))

    def test_each_thread_can_be_the_first_at_a_once(self):
        self.expect_failure("""
            #include <assert.h>
            #include <pthread.h>
            static pthread_once_t once = PTHREAD_ONCE_INIT;
            static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
            static __thread int self;
            static int first;
            static void note(void) { first = self; }
            static void* run(void* which) {
              self = (int)(long)which;
              if (self == 2)
                pthread_mutex_lock(&mutex), pthread_mutex_unlock(&mutex);
              else
                pthread_once(&once, note);
              return NULL;
            }
            int main(void) {
              pthread_t threads[4];
              for (long i = 1; i < 4; ++i) pthread_create(&threads[i], NULL, run, (void*)i);
              for (int i = 1; i < 4; ++i) pthread_join(threads[i], NULL);
              assert(first == 1);
              return 0;
            }""", strategies=("dpor", "portfolio"))

    def test_each_thread_can_be_the_first_at_a_static_variable(self):
        self.expect_failure("""
            #include <cassert>
            #include <mutex>
            #include <thread>
            static std::mutex between;
            static int first(int self) {
              static const int made = self, copy = made;
              return copy;
            }
            int main() {
              int seen = 0;
              std::thread one([] { first(1); });
              std::thread two([] { std::lock_guard lock(between); });
              std::thread three([&] { seen = first(3); });
              one.join(), two.join(), three.join();
              assert(seen == 1);
            }""", ".cpp", ("dpor", "portfolio"))

    def test_a_system_call_by_number_depends_on_all_others(self):
        self.expect_failure("""
            #include <assert.h>
            #include <pthread.h>
            #include <sys/syscall.h>
            #include <unistd.h>
            static void* cover(void* none) { syscall(SYS_umask, 077); return none; }
            int main(void) {
              pthread_t other;
              syscall(SYS_umask, 022);
              pthread_create(&other, NULL, cover, NULL);
              const long seen = syscall(SYS_umask, 022);
              pthread_join(other, NULL);
              assert(seen == 022);
              return 0;
            }""")

    def test_two_calls_whose_order_matters_are_named(self):
        file, program = self.folder / "variable.c", self.folder / "variable"
        file.write_text("""
            #include <assert.h>
            #include <pthread.h>
            #include <stdlib.h>
            #include <unistd.h>
            static void* change(void* none) { setenv("V", "new", 1); return none; }
            int main(void) {
              pthread_t changer;
              setenv("V", "old", 1);
              pthread_create(&changer, NULL, change, NULL);
              access("/", F_OK);
              const char first = getenv("V")[0];
              pthread_join(changer, NULL);
              assert(first == 'o');
              return 0;
            }""")
        subprocess.run(["gcc", "-g", "-O1", "-pthread", file, "-o", program], check=True)
        done = explore("--switch-at", "calls", "--strategy", "random", "--", program)
        self.assertRegex(done.stdout, r"the two events whose order matters:\n  first in the failing run: .*, about to call setenv\n"
                                      r"      at change .*\n  first in a passing run: .*, about to call getenv\n      at main ")

    def test_locks_by_futexes_of_the_program_prove_nothing_at_calls(self):
        file, program = self.folder / "futex.c", self.folder / "futex"
        file.write_text("""
            #include <linux/futex.h>
            #include <pthread.h>
            #include <stdatomic.h>
            #include <sys/syscall.h>
            #include <unistd.h>
            static atomic_int word;
            static void* await(void* none) {
              while (word == 0) syscall(SYS_futex, &word, FUTEX_WAIT, 0, NULL, NULL, 0);
              return none;
            }
            int main(void) {
              pthread_t waiter;
              pthread_create(&waiter, NULL, await, NULL);
              word = 1;
              syscall(SYS_futex, &word, FUTEX_WAKE, 1, NULL, NULL, 0);
              return pthread_join(waiter, NULL);
            }""")
        subprocess.run(["gcc", "-g", "-O1", "-pthread", file, "-o", program], check=True)
        done = explore("--strategy", "dpor", "--", program)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("exhaust", done.stdout)
        self.assertIn("all schedules, but perhaps not all orders: the program waits by futexes of its own", done.stdout)


if __name__ == "__main__":
    unittest.main()
