// SPDX-License-Identifier: BSD-3-Clause
// nanomsg, issues 894 and 1040: a message is sent while the receiver's socket is closed (in process).
#include <nanomsg/nn.h>
#include <nanomsg/pubsub.h>
#include <pthread.h>
#include <stdlib.h>

static const char address[] = "inproc://numbers";

static void* subscribe_once(void* unused) {
  const int subscriber = nn_socket(AF_SP, NN_SUB);
  if (nn_connect(subscriber, address) < 0) _Exit(3);
  nn_close(subscriber);
  return unused;
}

int main(void) {
  pthread_t other;
  const int publisher = nn_socket(AF_SP, NN_PUB);
  if (nn_bind(publisher, address) < 0) _Exit(3);
  pthread_create(&other, NULL, subscribe_once, NULL);
  nn_send(publisher, "1", 1, 0);
  pthread_join(other, NULL);
  nn_close(publisher);
  return 0;
}
