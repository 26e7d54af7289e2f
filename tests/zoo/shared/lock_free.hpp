// SPDX-License-Identifier: BSD-3-Clause
// Lock-free code that is nearly correct: the specimens with the same text on simulated threads (tests/zoo) and on
// system threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, this_thread, atomic.
#pragma once

#include <array>
#include <cstddef>

namespace waitpoint::zoo {
namespace {

// A work-stealing queue: the owner takes at the tail, a thief at the head; for the last job they must agree.
template <bool mended>
void work_stealing() {
  constexpr int jobs = 3;
  atomic<int> head(0), tail(jobs);
  std::array<atomic<int>, jobs> done;
  Crew crew;
  crew.add("owner", [&] {
    for (;;) {
      const int last = tail.fetch_sub(1) - 1;
      int first = head.load();
      if (first > last) break;
      if (mended && first == last && !head.compare_exchange_strong(first, first + 1)) break;
      check(done[static_cast<std::size_t>(last)].fetch_add(1) == 0, "a job is done twice");
      if (first == last) break;
    }
  });
  crew.add("thief", [&] {
    for (int i = 0; i < 2; ++i) {
      int first = head.load();
      if (first >= tail.load()) break;
      if (head.compare_exchange_strong(first, first + 1))
        check(done[static_cast<std::size_t>(first)].fetch_add(1) == 0, "a job is done twice");
    }
  });
  crew.join();
}

// A sequence lock whose reader checks for a write in progress before it reads, but not again afterwards.
template <bool mended>
void sequence_lock() {
  atomic<int> sequence(0), x(0), y(0);
  Crew crew;
  crew.add("localisation", [&] {
    for (int i = 1; i <= 3; ++i) {
      sequence.fetch_add(1);
      x.store(i);
      y.store(i);
      sequence.fetch_add(1);
    }
  });
  crew.add("motion", [&] {
    const int before = sequence.load();
    if (before % 2 != 0) return;
    const int seen_x = x.load(), seen_y = y.load();
    if (mended && sequence.load() != before) return;
    check(seen_x == seen_y, "half a position");
  });
  crew.join();
}

// A lock of one flag that is tested and set in two steps.
template <bool mended>
void spin_flag() {
  atomic<bool> taken(false);
  atomic<int> inside(0);
  Crew crew;
  for (int i = 0; i < 2; ++i)
    crew.add("actuator", [&] {
      if (mended) {
        while (taken.exchange(true)) this_thread::yield();
      } else {
        while (taken.load()) this_thread::yield();
        taken.store(true);
      }
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      taken.store(false);
    });
  crew.join();
}

// Peterson's lock with its first two stores swapped.
template <bool mended>
void petersons_lock() {
  std::array<atomic<bool>, 2> wants;
  atomic<std::size_t> turn(0);
  atomic<int> inside(0);
  Crew crew;
  for (std::size_t i = 0; i < 2; ++i)
    crew.add("side", [&, i] {
      if (mended) wants[i].store(true);
      turn.store(1 - i);
      if (!mended) wants[i].store(true);
      while (wants[1 - i].load() && turn.load() != i) this_thread::yield();
      check(inside.fetch_add(1) == 0, "two are inside");
      inside.fetch_sub(1);
      wants[i].store(false);
    });
  crew.join();
}

// A three-bit sequence number: a reader delayed by eight messages takes the ninth for the first.
template <bool mended>
void sequence_wrap() {
  constexpr int wrap = mended ? 1000 : 8;
  atomic<int> sequence(0), value(0);
  Crew crew;
  crew.add("sender", [&] {
    for (int i = 1; i <= 10; ++i) {
      sequence.store(-1);
      value.store(i);
      sequence.store(i % wrap);
    }
  });
  crew.add("receiver", [&] {
    const int before = sequence.load();
    if (before == -1) return;
    const int first = value.load();
    const int second = value.load();
    if (sequence.load() == before) check(first == second, "a message has become another one");
  });
  crew.join();
}

}  // namespace
}  // namespace waitpoint::zoo
