// SPDX-License-Identifier: BSD-3-Clause
//
// A program whose global variables have names of functions of the C library, as C allows where no header declares them.
#include <pthread.h>

_Bool send, close, fork, poll, kill, memcpy, strlen, snprintf, fflush;

static void* set(void* of) {
  send = close = fork = poll = kill = memcpy = strlen = snprintf = fflush = 1;
  return of;
}

int main(void) {
  pthread_t thread;
  pthread_create(&thread, 0, set, 0);
  pthread_join(thread, 0);
  return send && close && fork && poll && kill && memcpy && strlen && snprintf && fflush ? 0 : 1;
}
