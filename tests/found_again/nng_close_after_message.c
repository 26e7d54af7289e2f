// SPDX-License-Identifier: BSD-3-Clause
// nng, issue 1236: sockets are closed after a message from one to the other (TCP, in one process).
#include <nng/nng.h>
#include <nng/protocol/pair0/pair.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int error) {
  if (error != 0) {
    fprintf(stderr, "%s\n", nng_strerror(error));
    _Exit(3);
  }
}

int main(void) {
  const char* address = "tcp://127.0.0.1:9899";
  nng_socket listener;
  nng_socket dialer;
  char text[8];
  size_t size = sizeof text;
  check(nng_pair0_open(&listener));
  check(nng_listen(listener, address, NULL, 0));
  check(nng_pair0_open(&dialer));
  check(nng_dial(dialer, address, NULL, 0));
  check(nng_send(listener, "hello", 5, 0));
  check(nng_recv(dialer, text, &size, 0));
  check(nng_close(dialer));
  check(nng_close(listener));
  return 0;
}
