// SPDX-License-Identifier: BSD-3-Clause
//
// Waits forever on a descriptor that only this program could make ready, created in the way that the first argument
// names.
#define _GNU_SOURCE
#include <fcntl.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

int main(int argc, char** argv) {
  const char* const way = argc > 1 ? argv[1] : "";
  int ends[2] = {-1, -1}, descriptor = -1;
  if (pipe2(ends, strcmp(way, "pipe2") == 0 ? O_CLOEXEC : 0) != 0) return 1;
  if (strcmp(way, "pipe") == 0 && pipe(ends) != 0) return 1;
  if (strcmp(way, "socketpair") == 0 && socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return 1;
  descriptor = ends[0];
  if (strcmp(way, "eventfd") == 0) descriptor = eventfd(0, 0);
  if (strcmp(way, "dup") == 0) descriptor = dup(ends[0]);
  if (strcmp(way, "dup2") == 0) descriptor = dup2(ends[0], 50);
  if (strcmp(way, "dup3") == 0) descriptor = dup3(ends[0], 50, 0);
  if (strcmp(way, "fcntl") == 0) descriptor = fcntl(ends[0], F_DUPFD, 50);
  if (strncmp(way, "epoll", 5) == 0) {
    const int epoll = strcmp(way, "epoll_create") == 0 ? epoll_create(1) : epoll_create1(0);
    struct epoll_event event = {.events = EPOLLIN};
    const int watched = strcmp(way, "epoll of outside") == 0 ? 0 : ends[0];
    if (epoll_ctl(epoll, EPOLL_CTL_ADD, watched, &event) != 0) return 1;
    return epoll_wait(epoll, &event, 1, -1);
  }
  char byte;
  return (int)read(descriptor, &byte, 1);
}
