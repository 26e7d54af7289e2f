// SPDX-License-Identifier: BSD-3-Clause
// Datagrams between two processes over the loopback, a millisecond apart, and the port that the system gives a socket:
//
//   datagrams receive   prints number and travelling time, in microseconds, of each, until none comes for a second
//   datagrams send N    sends N, and ends immediately after the last
//   datagrams port      prints the port of a new socket
#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

struct datagram {
  int number;
  struct timespec sent;
};

static struct sockaddr_in at(int port) {
  return (struct sockaddr_in){.sin_family = AF_INET, .sin_port = htons(port), .sin_addr = {htonl(INADDR_LOOPBACK)}};
}

static void receive_all(int end) {
  const struct sockaddr_in own = at(5000);
  const struct timeval patience = {1, 0};
  if (bind(end, (const struct sockaddr*)&own, sizeof own) != 0) exit(3);
  setsockopt(end, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  struct datagram got;
  while (recv(end, &got, sizeof got, 0) == (ssize_t)sizeof got) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long long ns = (now.tv_sec - got.sent.tv_sec) * 1000000000LL + now.tv_nsec - got.sent.tv_nsec;
    printf("%d %.1f\n", got.number, 1e-3 * (double)ns);
  }
}

static void send_some(int end, int count) {
  const struct sockaddr_in to = at(5000);
  for (int i = 0; i < count; ++i) {
    usleep(1000);
    struct datagram out = {.number = i};
    clock_gettime(CLOCK_MONOTONIC, &out.sent);
    if (i % 2 == 0)
      sendto(end, &out, sizeof out, 0, (const struct sockaddr*)&to, sizeof to);
    else if (connect(end, (const struct sockaddr*)&to, sizeof to) == 0)
      send(end, &out, sizeof out, 0);
  }
}

int main(int argc, char** argv) {
  const int end = socket(AF_INET, SOCK_DGRAM, 0);
  if (argc == 3 && strcmp(argv[1], "send") == 0) {
    send_some(end, atoi(argv[2]));
  } else if (argc == 2 && strcmp(argv[1], "receive") == 0) {
    receive_all(end);
  } else {
    struct sockaddr_in own = at(0);
    socklen_t size = sizeof own;
    bind(end, (struct sockaddr*)&own, size);
    getsockname(end, (struct sockaddr*)&own, &size);
    printf("%d\n", ntohs(own.sin_port));
  }
  return 0;
}
