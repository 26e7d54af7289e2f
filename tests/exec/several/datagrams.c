// SPDX-License-Identifier: BSD-3-Clause
//
// datagrams send PORT: sends ten datagrams with the time, one each 100 ms, every second one in two parts; datagrams
// receive PORT: prints the delay of each.
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

struct datagram {
  int number;
  long long sent_ns;
};

static long long now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000000000LL + now.tv_nsec;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((unsigned short)atoi(argv[2]))};
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  struct datagram datagram = {0, 0};
  if (strcmp(argv[1], "receive") == 0) {
    if (bind(descriptor, (struct sockaddr*)&address, sizeof address) != 0) return 1;
    while (recv(descriptor, &datagram, sizeof datagram, 0) == sizeof datagram) {
      printf("number %d after %lld ms\n", datagram.number, (now_ns() - datagram.sent_ns) / 1000000);
      fflush(stdout);
    }
  }
  for (; strcmp(argv[1], "send") == 0 && datagram.number < 10; ++datagram.number) {
    usleep(100000);
    datagram.sent_ns = now_ns();
    struct iovec parts[] = {{&datagram, 4}, {(char*)&datagram + 4, sizeof datagram - 4}};
    const struct msghdr message = {
        .msg_name = &address, .msg_namelen = sizeof address, .msg_iov = parts, .msg_iovlen = 2};
    if (datagram.number % 2 != 0)
      sendmsg(descriptor, &message, 0);
    else
      sendto(descriptor, &datagram, sizeof datagram, 0, (struct sockaddr*)&address, sizeof address);
  }
  return 0;
}
