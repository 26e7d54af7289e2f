// SPDX-License-Identifier: BSD-3-Clause
//
// A server and a client, each a process, that talk over TCP by the C library's streams. The reads and writes of a
// stream are the library's own calls.
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

static void serve(int listener) {
  for (int i = 0; i < 3; ++i) {
    const int connection = accept(listener, NULL, NULL);
    FILE *const from = fdopen(dup(connection), "r"), *const to = fdopen(connection, "w");
    int a, b;
    while (fscanf(from, "%d %d", &a, &b) == 2) {
      sleep(1);
      fprintf(to, "%d\n", a * b);
      fflush(to);
    }
    fclose(to);
    fclose(from);
  }
}

static void ask(const struct sockaddr_in* address) {
  for (int i = 1; i <= 3; ++i) {
    const int connection = socket(AF_INET, SOCK_STREAM, 0);
    if (connect(connection, (const struct sockaddr*)address, sizeof *address) != 0) exit(1);
    FILE *const from = fdopen(dup(connection), "r"), *const to = fdopen(connection, "w");
    char line[100];
    fprintf(to, "%d 7\n", i);
    fflush(to);
    if (fgets(line, sizeof line, from) == NULL) exit(2);
    fputs(line, stdout);
    fclose(to);
    fclose(from);
  }
}

int main(void) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  socklen_t size = sizeof address;
  if (bind(listener, (struct sockaddr*)&address, size) != 0 || listen(listener, 1) != 0) return 1;
  getsockname(listener, (struct sockaddr*)&address, &size);
  if (fork() == 0) {
    serve(listener);
    _exit(0);
  }
  ask(&address);
  wait(NULL);
  return 0;
}
