// SPDX-License-Identifier: BSD-3-Clause
// Programs for --memory weak: "buffer" aborts if two threads miss each other's relaxed stores; "pass" with a release
// and an acquire never; "mutex" and "futex" hand a value over by the C library and by the system; "barrier" has a fence
// in one thread only, the system's for all; "wait" loops.
#include <linux/futex.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace {

constexpr auto relaxed = std::memory_order_relaxed;
std::atomic<int> x(0), y(0), flag(0);

void buffer() {
  int seen_x = 0, seen_y = 0;
  std::thread one([&] {
    x.store(1, relaxed);
    seen_y = y.load(relaxed);
  });
  std::thread two([&] {
    y.store(1, relaxed);
    seen_x = x.load(relaxed);
  });
  one.join();
  two.join();
  if (seen_x + seen_y == 0) std::abort();
}

void pass() {
  std::thread one([] {
    x.store(1, relaxed);
    flag.store(1, std::memory_order_release);
  });
  if (flag.load(std::memory_order_acquire) == 1 && x.load(relaxed) != 1) std::abort();
  one.join();
}

void under_a_mutex() {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  const auto count = [] {
    pthread_mutex_lock(&lock);
    x.store(x.load(relaxed) + 1, relaxed);
    pthread_mutex_unlock(&lock);
  };
  std::thread one(count), two(count);
  one.join();
  two.join();
  if (x.load(relaxed) != 2) std::abort();
}

long futex(int operation, int value) { return syscall(SYS_futex, &flag, operation, value, nullptr, nullptr, 0); }

void at_a_futex() {
  std::thread one([] {
    x.store(1, relaxed);
    flag.store(1, relaxed);
    futex(FUTEX_WAKE_PRIVATE, 1);
  });
  const bool has_waited = futex(FUTEX_WAIT_PRIVATE, 0) == 0;
  if (flag.load(relaxed) != 1 || (has_waited && x.load(relaxed) != 1)) std::abort();
  one.join();
}

void buffer_with_a_barrier() {
  constexpr int registration = 1 << 4, of_the_process = 1 << 3;  // MEMBARRIER_CMD_..._PRIVATE_EXPEDITED
  if (syscall(SYS_membarrier, registration, 0, 0) != 0) return;
  int seen_x = 0, seen_y = 0;
  std::thread cheap([&] {
    x.store(1, relaxed);
    std::atomic_signal_fence(std::memory_order_seq_cst);
    seen_y = y.load(relaxed);
  });
  std::thread dear([&] {
    y.store(1, relaxed);
    if (syscall(SYS_membarrier, of_the_process, 0, 0) != 0) std::exit(3);
    seen_x = x.load(relaxed);
  });
  cheap.join();
  dear.join();
  if (seen_x + seen_y == 0) std::abort();
}

void wait() {
  std::thread one([] { flag.store(1, relaxed); });
  while (flag.load(relaxed) == 0) {
  }
  one.join();
}

}  // namespace

int main(int, char** arguments) {
  if (std::strcmp(arguments[1], "buffer") == 0) buffer();
  if (std::strcmp(arguments[1], "pass") == 0) pass();
  if (std::strcmp(arguments[1], "mutex") == 0) under_a_mutex();
  if (std::strcmp(arguments[1], "futex") == 0) at_a_futex();
  if (std::strcmp(arguments[1], "barrier") == 0) buffer_with_a_barrier();
  if (std::strcmp(arguments[1], "wait") == 0) wait();
  return 0;
}
