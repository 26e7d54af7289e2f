// SPDX-License-Identifier: BSD-3-Clause
//
// reader KEY: prints lines up to the empty one, and their number at exit, which is also its exit status.
#include <stdio.h>
#include <stdlib.h>

#include "lines.h"

static int lines_read;

static void tell(void) { printf("%d lines\n", lines_read); }

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  struct lines* in = lines_open(atoi(argv[1]));
  char line[line_size];
  atexit(tell);
  for (; lines_take(in, line), line[0] != '\0'; ++lines_read) printf("%s\n", line);
  lines_remove(in);
  return lines_read;
}
