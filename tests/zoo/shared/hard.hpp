// SPDX-License-Identifier: BSD-3-Clause
// Bugs in one of very many schedules, as hard as in the literature on testing of concurrent programs: the specimens
// with the same text on simulated threads (tests/zoo) and on system threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, atomic, mutex.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>

namespace waitpoint::zoo {
namespace {

// Each of many writers publishes the first value in one critical section and the second in the next. The reader must
// come after the first stage of one and before the second stage of all.
template <bool mended, int writers>
void two_stage_of_all() {
  mutex first_lock, second_lock;
  int first = 0, second = 0;
  Crew crew;
  for (int i = 0; i < writers; ++i)
    crew.add("writer", [&] {
      std::unique_lock guard(first_lock);
      first = 1;
      const int written = first;
      if (!mended) guard.unlock();
      const std::lock_guard inner(second_lock);
      second = written + 1;
    });
  crew.add("reader", [&] {
    std::unique_lock guard(first_lock);
    const int seen = first;
    guard.unlock();
    if (seen == 0) return;
    const std::lock_guard inner(second_lock);
    check(second == seen + 1, "the second stage is missing");
  });
  crew.join();
}

// Many writers set two variables, each in the same order; a checker must see both or neither.
template <bool mended, int writers>
void reorder_of_all() {
  mutex both;
  atomic<int> a(0), b(0);
  Crew crew;
  for (int i = 0; i < writers; ++i)
    crew.add("writer", [&] {
      std::unique_lock guard(both, std::defer_lock);
      if (mended) guard.lock();
      a.store(1);
      b.store(-1);
    });
  crew.add("checker", [&] {
    std::unique_lock guard(both, std::defer_lock);
    if (mended) guard.lock();
    const int seen_a = a.load();
    const int seen_b = b.load();
    check((seen_a == 0 && seen_b == 0) || (seen_a == 1 && seen_b == -1), "half of the pair");
  });
  crew.join();
}

// Each thread advances its counter by the value of the next one's: two reach Fibonacci's numbers. Only one order of all
// steps, up to a rotation, leads to `greatest`.
template <bool mended, std::size_t threads, int rounds, int greatest>
void growth() {
  std::array<atomic<int>, threads> counters;
  for (atomic<int>& counter : counters) counter.store(1);
  mutex all;
  Crew crew;
  for (std::size_t i = 0; i < threads; ++i)
    crew.add("counter", [&, i] {
      std::unique_lock guard(all, std::defer_lock);
      if (mended) guard.lock();
      for (int round = 0; round < rounds; ++round) counters[i].fetch_add(counters[(i + 1) % threads].load());
    });
  crew.join();
  for (const atomic<int>& counter : counters)
    check(counter.load() < greatest, "the gain is higher than any controller can bear");
}

}  // namespace
}  // namespace waitpoint::zoo
