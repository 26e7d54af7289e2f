// SPDX-License-Identifier: BSD-3-Clause
// nng, issues 1543 and 1813: a thread closes the socket on which another one waits for a reply (TCP, in one process).
#include <nng/nng.h>
#include <nng/protocol/reqrep0/rep.h>
#include <nng/protocol/reqrep0/req.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static nng_socket requester;

static void check(int error) {
  if (error != 0) {
    fprintf(stderr, "%s\n", nng_strerror(error));
    _Exit(3);
  }
}

static void* close_it(void* unused) {
  check(nng_close(requester));
  return unused;
}

int main(void) {
  const char* address = "tcp://127.0.0.1:9898";
  nng_socket replier;
  char text[8];
  size_t size = sizeof text;
  pthread_t closer;
  check(nng_rep0_open(&replier));
  check(nng_listen(replier, address, NULL, 0));
  check(nng_req0_open(&requester));
  check(nng_dial(requester, address, NULL, 0));
  check(nng_send(requester, "date", 4, 0));
  pthread_create(&closer, NULL, close_it, NULL);
  const int result = nng_recv(requester, text, &size, 0);
  if (result != NNG_ECLOSED) check(result);
  pthread_join(closer, NULL);
  check(nng_close(replier));
  return 0;
}
