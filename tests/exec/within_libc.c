// SPDX-License-Identifier: BSD-3-Clause
//
// An internal wait of the C library, named by the first argument: natively each ends.
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static FILE *in, *out;
static char order[64];

// A lock internal to the C library, held while its holder sleeps.
static void* hold(void* unused) {
  flockfile(out);
  strcat(order, "a");
  usleep(10000);
  strcat(order, "b");
  funlockfile(out);
  return unused;
}
static const char* printed = "xy";
static void* print(void* unused) {
  usleep(1000);
  if (printed[1] == '\0')
    fputc(printed[0], out);
  else
    fputs(printed, out);
  strcat(order, "c");
  return unused;
}

// A FILE* on a pipe with its other end in another thread.
static void* read_line(void* unused) {
  char line[64] = "";
  if (fgets(line, sizeof line, in) != NULL) strcat(order, line);
  return unused;
}
static void* write_line(void* unused) {
  usleep(1000);
  strcat(order, "w");
  fputs("line", out);
  fclose(out);
  return unused;
}

// Exceeds the capacity of a pipe.
enum { much = 300000 };
static void* write_much(void* unused) {
  char* const bytes = malloc(much);
  memset(bytes, 'm', much);
  if (fwrite(bytes, 1, much, out) == much && fclose(out) == 0) strcat(order, "W");
  free(bytes);
  return unused;
}
static void* read_much(void* unused) {
  int count = 0;
  usleep(1000);
  while (fgetc(in) == 'm') ++count;
  strcat(order, count == much ? "R" : "?");
  return unused;
}

static void meet(void* (*one)(void*), void* (*other)(void*)) {
  pthread_t first, second;
  pthread_create(&first, NULL, one, NULL);
  pthread_create(&second, NULL, other, NULL);
  pthread_join(first, NULL);
  pthread_join(second, NULL);
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  int ends[2];
  if (pipe(ends) != 0) return 1;
  in = fdopen(ends[0], "r");
  out = fdopen(ends[1], "w");
  if (strcmp(what, "character") == 0) printed = "x";
  if (strcmp(what, "lock") == 0 || strcmp(what, "character") == 0) meet(hold, print);
  if (strcmp(what, "pipe") == 0) meet(read_line, write_line);
  if (strcmp(what, "much") == 0) meet(write_much, read_much);
  // Started programs are not simulated.
  if (strcmp(what, "start") == 0)
    sprintf(order, "%d",
            WEXITSTATUS(system("python3 -c 'import threading\n"
                               "t = threading.Thread(target=print, args=[5]); t.start(); t.join()'; exit 3")));
  printf("%s\n", order);
  return 0;
}
