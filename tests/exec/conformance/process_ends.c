// SPDX-License-Identifier: BSD-3-Clause
// Ends of multi-threaded processes.
#include "tests/exec/conformance/processes.h"

static int report = -1;

static void tell(const char* letter) {
  if (write(report, letter, 1) != 1) _exit(99);
}

static void tell_a(void) { tell("a"); }
static void tell_b(void) { tell("b"); }

static void* exit_with_18(void* unused) {
  (void)unused;
  exit(18);
}

static void* _exit_with_19(void* unused) {
  (void)unused;
  _exit(19);
}

static void expect_end(const char* file, int line, void* (*end)(void*), int status, const char* told) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    report = ends[1];
    atexit(tell_a);
    atexit(tell_b);
    at_quick_exit(tell_b);
    at_quick_exit(tell_a);
    start(end, NULL);
    for (;;) sleep(1);
  }
  close(ends[1]);
  expect_exit(file, line, child, status);
  char text[8] = "";
  expect_equal(file, line, "told", read(ends[0], text, 7), (long long)strlen(told));
  expect_equal(file, line, told, strcmp(text, told), 0);
}

#define EXPECT_END(end, status, told) expect_end(__FILE__, __LINE__, end, status, told)

static void* quick_exit_with_20(void* unused) {
  (void)unused;
  quick_exit(20);
}

static void* _Exit_with_22(void* unused) {
  (void)unused;
  _Exit(22);
}
CASE(exit_in_a_thread_calls_handlers_last_first) { EXPECT_END(exit_with_18, 18, "ba"); }
CASE(_exit_in_a_thread_calls_none) { EXPECT_END(_exit_with_19, 19, ""); }
CASE(quick_exit_in_a_thread_calls_its_own) { EXPECT_END(quick_exit_with_20, 20, "ab"); }
CASE(_Exit_in_a_thread_calls_none) { EXPECT_END(_Exit_with_22, 22, ""); }
static void exit_again(void) { _exit(23); }
CASE_ENDING_WITH(23, a_handler_of_exit_may_end_with_another_status) {
  atexit(exit_again);
  exit(1);
}
CASE(what_was_printed_is_written_at_exit) {
  int ends[2];
  EXPECT_IS(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], 1);
    printf("printed");
    exit(0);
  }
  EXPECT_EXIT(child, 0);
  char text[16] = "";
  EXPECT_IS(read(ends[0], text, 15), 7);
}
