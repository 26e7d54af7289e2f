// SPDX-License-Identifier: BSD-3-Clause
//
// Starts itself in each way, with "started", which prints the year and ends with status 7.
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char** environ;

static void tell(const char* way, int status) {
  printf("%s %d\n", way, WEXITSTATUS(status));
  fflush(stdout);
}

int main(int argc, char** argv) {
  char* const words[] = {argv[0], "started", NULL};
  char command[512], line[64] = "";
  int status = 0;
  pid_t child = 0;
  if (argc > 1 && strcmp(argv[1], "started") == 0) {
    const time_t now = time(NULL);
    printf("%d\n", 1900 + gmtime(&now)->tm_year);
    return getenv("LD_PRELOAD") != NULL || getenv("WAITPOINT_EXEC") != NULL ? 1 : 7;
  }
  snprintf(command, sizeof command, "%s started; exit $?", argv[0]);
  tell("system", system(command));
  FILE* const stream = popen(command, "r");
  if (fgets(line, sizeof line, stream) != NULL) printf("%s", line);
  tell("popen", pclose(stream));
  if (posix_spawn(&child, argv[0], NULL, NULL, words, environ) == 0) waitpid(child, &status, 0);
  tell("posix_spawn", status);
  child = fork();
  if (child == 0) execv(argv[0], words);
  waitpid(child, &status, 0);
  tell("fork", status);
  return execv(argv[0], words);
}
