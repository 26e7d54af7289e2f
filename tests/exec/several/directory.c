// SPDX-License-Identifier: BSD-3-Clause
// directory NAME FOLDER: goes to FOLDER, writes NAME into the file "mark" there in two threads, and prints where it is.
#define _GNU_SOURCE
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <unistd.h>

static void* write_mark(void* name) {
  for (int i = 0; i < 3; ++i) {
    usleep(1000);
    FILE* file = fopen("mark", "a");
    if (file == NULL) return NULL;
    fprintf(file, "%s\n", (const char*)name);
    fclose(file);
  }
  return name;
}

int main(int argc, char** argv) {
  char here[4096];
  pthread_t other;
  void* result = NULL;
  if (argc < 3 || chdir("nowhere") == 0 || chdir(argv[2]) != 0) return 2;
  pthread_create(&other, NULL, write_mark, argv[1]);
  if (write_mark(argv[1]) == NULL || pthread_join(other, &result) != 0 || result == NULL) return 3;
  printf("%s is in %s\n", argv[1], getcwd(here, sizeof here));
  const int root = open("/", O_RDONLY | O_DIRECTORY);
  if (fchdir(root) != 0 || close(root) != 0) return 4;
  usleep(1000);
  printf("%s is in %s\n", argv[1], getcwd(here, sizeof here));
  return 0;
}
