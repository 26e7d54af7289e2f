// SPDX-License-Identifier: BSD-3-Clause
//
// filter IN OUT: copies every second line from one key to another, in capital letters, and the final empty line.
#include <ctype.h>
#include <stdlib.h>

#include "lines.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  struct lines* in = lines_open(atoi(argv[1]));
  struct lines* out = lines_open(atoi(argv[2]));
  char line[line_size];
  for (int number = 1; lines_take(in, line), line[0] != '\0'; ++number) {
    if (number % 2 != 0) continue;
    for (char* c = line; *c != '\0'; ++c) *c = (char)toupper((unsigned char)*c);
    lines_put(out, line);
  }
  lines_put(out, "");
  lines_remove(in);
  return 0;
}
