// SPDX-License-Identifier: BSD-3-Clause
//
// Shows the effect, named by the first argument, of an option of `waitpoint exec`.
#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>
#include <x86intrin.h>

static int connect_to(const char* host) {
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons(9)};
  inet_pton(AF_INET, host, &address.sin_addr);
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  return connect(descriptor, (struct sockaddr*)&address, sizeof address) == 0 ? 0 : errno;
}

int main(int argc, char** argv) {
  const char* const what = argc > 1 ? argv[1] : "";
  if (strcmp(what, "counter") == 0) {
    unsigned processor;
    const unsigned long long first = __rdtsc(), second = __rdtscp(&processor);
    usleep(1000);
    printf("%llu %llu %u\n", second - first, __rdtsc() - second, processor);
  } else if (strcmp(what, "trapped") == 0) {
    const unsigned long long first = __rdtsc();
    usleep(1000);
    const unsigned long long slept = __rdtsc() - first;
    return slept < 1000000 || slept >= 1010000;
  } else if (strcmp(what, "isolated") == 0) {
    return connect_to("192.0.2.1") != EACCES;
  } else if (strcmp(what, "connect") == 0) {
    printf("%d %d\n", connect_to("127.0.0.1"), connect_to("192.0.2.1") == EACCES);
  } else if (strcmp(what, "random") == 0) {
    const unsigned char* const bytes = (const unsigned char*)getauxval(AT_RANDOM);
    for (int i = 0; i < 16; ++i) printf("%02x", bytes[i]);
    unsigned long guard;
    __asm__("movq %%fs:0x28, %0" : "=r"(guard));
    printf(" %lx\n", guard);
  } else if (strcmp(what, "date") == 0) {
    const struct timespec date = {1000000000, 0};
    if (clock_settime(CLOCK_REALTIME, &date) != 0) return 1;
    printf("%ld\n", (long)time(NULL));
  }
  return 0;
}
