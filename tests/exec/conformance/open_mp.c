// SPDX-License-Identifier: BSD-3-Clause
// OpenMP programs, whose runtime waits by direct system calls.
#include "tests/exec/conformance/harness.h"

#include <omp.h>

CASE(a_loop_is_summed_up) {
  long sum = 0;
#pragma omp parallel for reduction(+ : sum) num_threads(4)
  for (int i = 0; i < 1000; ++i) sum += i;
  EXPECT_IS(sum, 499500);
}
CASE(one_thread_at_a_time_is_in_a_critical_section) {
  int count = 0;
#pragma omp parallel num_threads(4)
  for (int i = 0; i < 100; ++i) {
#pragma omp critical
    ++count;
  }
  EXPECT_IS(count, 400);
}
CASE(nobody_passes_a_barrier_before_all_have_come) {
  int rounds[4] = {0}, all_there = 1;
#pragma omp parallel num_threads(4)
  for (int round = 1; round < 20; ++round) {
    rounds[omp_get_thread_num()] = round;
#pragma omp barrier
    for (int i = 0; i < 4; ++i)
      if (rounds[i] != round) all_there = 0;
#pragma omp barrier
  }
  EXPECT(all_there);
}

static int fibonacci(int number) {
  int one = 0, other = 0;
  if (number < 2) return number;
#pragma omp task shared(one)
  one = fibonacci(number - 1);
#pragma omp task shared(other)
  other = fibonacci(number - 2);
#pragma omp taskwait
  return one + other;
}
CASE(tasks_are_waited_for) {
  int result = 0;
#pragma omp parallel num_threads(4)
#pragma omp single
  result = fibonacci(12);
  EXPECT_IS(result, 144);
}
CASE(what_is_ordered_comes_in_order) {
#pragma omp parallel for ordered schedule(dynamic) num_threads(3)
  for (int i = 0; i < 8; ++i) {
    const char letter[2] = {(char)('a' + i), '\0'};
#pragma omp ordered
    note(letter);
  }
  EXPECT_NOTED("abcdefgh");
}
CASE(a_lock_keeps_threads_apart) {
  omp_lock_t lock;
  volatile int count = 0;
  omp_init_lock(&lock);
#pragma omp parallel num_threads(4)
  for (int i = 0; i < 50; ++i) {
    omp_set_lock(&lock);
    count = count + 1;
    omp_unset_lock(&lock);
  }
  omp_destroy_lock(&lock);
  EXPECT_IS(count, 200);
}
CASE(teams_may_be_made_within_teams_again_and_again) {
  int count = 0;
  omp_set_max_active_levels(2);
  for (int i = 0; i < 10; ++i)
#pragma omp parallel num_threads(2)
#pragma omp parallel num_threads(2)
  {
#pragma omp atomic
    ++count;
  }
  EXPECT_IS(count, 40);
}
