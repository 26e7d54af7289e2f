// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/explore/body.hpp"

#include <vector>

#include "fibers/sync/ignored_accesses.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::bench {

namespace {

// Sized for about a hundred switch points per schedule, including instrumented accesses to memory.
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
constexpr int rounds = 4;
#else
constexpr int rounds = 7;
#endif

}  // namespace

void contend() {
  constexpr int threads = 4;
  mutex m;
  int count = 0;
  std::vector<thread> contenders;
  contenders.reserve(threads);
  for (int i = 0; i < threads; ++i)
    contenders.emplace_back([&] {
      for (int k = 0; k < rounds; ++k) {
        m.lock();
        ++count;
        m.unlock();
      }
    });
  for (thread& contender : contenders) contender.join();
}

}  // namespace waitpoint::bench
