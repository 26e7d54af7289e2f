// SPDX-License-Identifier: BSD-3-Clause
// Shared by cases on sockets: a pair, and bulk data.
#pragma once

#include "tests/exec/conformance/harness.h"

#include <stdatomic.h>
#include <sys/socket.h>

static int ends[2];
static atomic_int done;
static char big[3000000];
static inline void make_pair(int type) { EXPECT_IS(socketpair(AF_UNIX, type, 0, ends), 0); }

static inline void fill_big(void) {
  for (size_t i = 0; i < sizeof big; ++i) big[i] = (char)(i * 7 + i / 1000);
}

static inline void* send_one(void* unused) {
  let_others_wait();
  atomic_fetch_add(&done, 1);
  EXPECT_IS(send(ends[1], "x", 1, 0), 1);
  return unused;
}

static inline void* receive_big(void* descriptor) {
  static char received[sizeof big];
  let_others_wait();
  EXPECT_IS(recv(*(int*)descriptor, received, sizeof received, MSG_WAITALL), (long long)sizeof received);
  EXPECT_IS(memcmp(received, big, sizeof big), 0);
  return NULL;
}
