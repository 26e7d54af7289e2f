// SPDX-License-Identifier: BSD-3-Clause
// nng (docs/found.md): a thread closes the socket on which another one sends.
#include <nng/nng.h>
#include <nng/protocol/pipeline0/push.h>
#include <pthread.h>
#include <stdio.h>

static nng_socket pusher;

static void* close_it(void* unused) {
  nng_close(pusher);
  return unused;
}

int main(void) {
  pthread_t closer;
  setvbuf(stdout, NULL, _IONBF, 0);
  nng_push0_open(&pusher);
  nng_socket_set_ms(pusher, NNG_OPT_SENDTIMEO, 100);
  pthread_create(&closer, NULL, close_it, NULL);
  const int result = nng_send(pusher, "text", 4, 0);
  pthread_join(closer, NULL);
  return result == NNG_ECLOSED || result == NNG_ETIMEDOUT ? 0 : 3;
}
