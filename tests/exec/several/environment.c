// SPDX-License-Identifier: BSD-3-Clause
// environment NAME: changes variables of its environment and looks again after a millisecond. Prints NAME and what it
// finds by getenv(), in `environ` and in main()'s third argument.
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char* value(const char* name) {
  const char* found = getenv(name);
  return found != NULL ? found : "none";
}

static const char* in(char** all, const char* name) {
  for (; all != NULL && *all != NULL; ++all)
    if (strncmp(*all, name, strlen(name)) == 0 && (*all)[strlen(name)] == '=') return *all + strlen(name) + 1;
  return "none";
}

int main(int argc, char** argv, char** variables) {
  if (argc < 2) return 2;
  char put[64];
  snprintf(put, sizeof put, "PUT=by %s", argv[1]);
  const char* given = in(variables, "GIVEN");
  printf("%s: given %s, set %s\n", argv[1], given, value("SET"));
  setenv("SET", argv[1], 1);
  setenv("SET", "another", 0);
  putenv(put);
  unsetenv("GIVEN");
  usleep(1000);
  printf("%s: set %s %s, put %s %s, given %s\n", argv[1], value("SET"), in(environ, "SET"), value("PUT"),
         in(environ, "PUT"), value("GIVEN"));
  usleep(1000);
  clearenv();
  printf("%s: %s", argv[1], value("SET"));
  char* mine[] = {"SET=of a list", NULL};
  environ = mine;
  printf(" %s", value("SET"));
  setenv("SET", "again", 1);
  setenv("MORE", "again", 1);
  printf(" %s %s\n", value("SET"), in(environ, "MORE"));
  return 0;
}
