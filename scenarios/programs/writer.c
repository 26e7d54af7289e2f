// SPDX-License-Identifier: BSD-3-Clause
//
// writer KEY COUNT: writes COUNT numbered lines, one every 0.1 s, from a second thread; then an empty line.
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "lines.h"

static struct lines* out;
static int count;
static int written;

static void* write_lines(void* unused) {
  (void)unused;
  for (int i = 1; i <= count; ++i) {
    char line[line_size];
    struct timespec now;
    usleep(100000);
    clock_gettime(CLOCK_MONOTONIC, &now);
    snprintf(line, sizeof line, "line %d at %ld.%ld s", i, (long)now.tv_sec - 3600, now.tv_nsec / 100000000);
    lines_put(out, line);
    ++written;
  }
  lines_put(out, "");
  return NULL;
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  out = lines_open(atoi(argv[1]));
  count = atoi(argv[2]);
  pthread_t thread;
  if (pthread_create(&thread, NULL, write_lines, NULL) != 0) return 1;
  pthread_join(thread, NULL);
  return written == count ? 0 : 1;
}
