// SPDX-License-Identifier: BSD-3-Clause
// More clients than the backlog of the server's socket, each with a request in two small pieces and an answer that
// exceeds its small buffer, while a thread polls the clock.
#include <netinet/in.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { clients = 8, answer = 1 << 20 };

static struct sockaddr_in address;
static int listening;
static volatile int is_done;

static void check(int holds, const char* what) {
  if (!holds) perror(what), exit(1);
}

static void* ask(void* unused) {
  static __thread char bytes[4096];
  const int small = 4096, asking = socket(AF_INET, SOCK_STREAM, 0);
  check(setsockopt(asking, SOL_SOCKET, SO_RCVBUF, &small, sizeof small) == 0, "setsockopt");
  check(connect(asking, (struct sockaddr*)&address, sizeof address) == 0, "connect");
  check(write(asking, "a", 1) == 1 && write(asking, "b", 1) == 1, "write");
  long all = 0;
  for (ssize_t got; (got = read(asking, bytes, sizeof bytes)) > 0;) all += got;
  check(all == answer, "read");
  close(asking);
  return unused;
}

static void* serve(void* unused) {
  static char bytes[answer];
  usleep(10000);
  for (int i = 0; i < clients; ++i) {
    const int asked = accept(listening, NULL, NULL);
    char request[2];
    check(recv(asked, request, 2, MSG_WAITALL) == 2 && memcmp(request, "ab", 2) == 0, "recv");
    check(write(asked, bytes, sizeof bytes) == sizeof bytes, "write");
    close(asked);
  }
  return unused;
}

static void* look_at_clock(void* unused) {
  while (!is_done) usleep(1000);
  return unused;
}

int main(void) {
  listening = socket(AF_INET, SOCK_STREAM, 0);
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  check(bind(listening, (struct sockaddr*)&address, size) == 0 && listen(listening, 1) == 0, "listen");
  getsockname(listening, (struct sockaddr*)&address, &size);
  pthread_t asking[clients], serving, looking;
  pthread_create(&looking, NULL, look_at_clock, NULL);
  pthread_create(&serving, NULL, serve, NULL);
  for (int i = 0; i < clients; ++i) pthread_create(&asking[i], NULL, ask, NULL);
  for (int i = 0; i < clients; ++i) pthread_join(asking[i], NULL);
  pthread_join(serving, NULL);
  is_done = 1;
  pthread_join(looking, NULL);
}
