// SPDX-License-Identifier: BSD-3-Clause
// CZMQ, issues 2019 and 2196: two threads make the first sockets of the program.
#include <czmq.h>

static void* use_pipe(void* unused) {
  zsock_t* end;
  zsock_t* other_end = zsys_create_pipe(&end);
  zsock_destroy(&end);
  zsock_destroy(&other_end);
  return unused;
}

int main(void) {
  pthread_t other;
  pthread_create(&other, NULL, use_pipe, NULL);
  use_pipe(NULL);
  pthread_join(other, NULL);
  return 0;
}
