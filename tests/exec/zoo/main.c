// SPDX-License-Identifier: BSD-3-Clause
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/exec/zoo/zoo.h"

int mended = 0;

void check(int holds, const char* otherwise) {
  if (holds) return;
  fprintf(stderr, "%s\n", otherwise);
  exit(1);
}

static void list(void) {
  for (const struct specimen* const* table = tables; *table; ++table)
    for (const struct specimen* one = *table; one->name; ++one) printf("%s %s\n", one->needs, one->name);
}

int main(int argc, char** argv) {
  if (argc == 1) return list(), 0;
  mended = argc == 3 && strcmp(argv[2], "mended") == 0;
  for (const struct specimen* const* table = tables; *table; ++table)
    for (const struct specimen* one = *table; one->name; ++one)
      if (strcmp(one->name, argv[1]) == 0 && argc == 2 + mended) return one->run(one->threads), 0;
  fprintf(stderr, "expected one of the names, and 'mended' or nothing behind it\n");
  return 2;
}
