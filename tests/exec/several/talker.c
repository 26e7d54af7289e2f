// SPDX-License-Identifier: BSD-3-Clause
//
// talker serve NAME: tells the time to the first caller, and ends without closing.
// talker call NAME: calls until a server answers, and reads to the end.
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  strncpy(address.sun_path + 1, argv[2], sizeof address.sun_path - 2);  // an abstract name, in no folder
  const socklen_t size = (socklen_t)(sizeof address.sun_family + 1 + strlen(argv[2]));
  const int socket_of_all = socket(AF_UNIX, SOCK_STREAM, 0);
  if (strcmp(argv[1], "serve") == 0) {
    sleep(3);
    if (bind(socket_of_all, (struct sockaddr*)&address, size) != 0 || listen(socket_of_all, 1) != 0) return 1;
    const int other = accept(socket_of_all, NULL, NULL);
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    dprintf(other, "it is %ld s", (long)now.tv_sec - 3600);
    return 0;
  }
  while (connect(socket_of_all, (struct sockaddr*)&address, size) != 0) sleep(2);
  char words[100];
  size_t length = 0;
  for (ssize_t got; (got = read(socket_of_all, words + length, sizeof words - length)) > 0;) length += (size_t)got;
  printf("heard: %.*s\n", (int)length, words);
  return 0;
}
