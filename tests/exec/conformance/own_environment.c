// SPDX-License-Identifier: BSD-3-Clause
// A program that defines the environment functions itself, as shells do; they do nothing before main().
#include "tests/exec/conformance/processes.h"

static int has_begun;
int unsetenv(const char* name) {
  (void)name;
  return has_begun ? 0 : -1;
}
int setenv(const char* name, const char* value, int replace) {
  (void)name;
  (void)value;
  (void)replace;
  return has_begun ? 0 : -1;
}
char* getenv(const char* name) {
  const size_t length = strlen(name);
  for (char** word = environ; *word != NULL; ++word)
    if (strncmp(*word, name, length) == 0 && (*word)[length] == '=') return *word + length + 1;
  return NULL;
}

CASE(starts_programs) {
  has_begun = 1;
  const pid_t child = fork();
  EXPECT(child >= 0);
  if (child == 0) execv("/bin/sh", say_11);
  EXPECT_EXIT(child, 11);
}
CASE(becomes_a_program_that_starts_others) {
  has_begun = 1;
  char* const words[] = {"sh", "-c", "/bin/true && exit 12", NULL};
  const pid_t child = fork();
  EXPECT(child >= 0);
  if (child == 0) execv("/bin/sh", words);
  EXPECT_EXIT(child, 12);
}
