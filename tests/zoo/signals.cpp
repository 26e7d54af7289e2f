// SPDX-License-Identifier: BSD-3-Clause
// Signals without a waiter, to the wrong one, or with less meaning than assumed.
#include <deque>
#include <mutex>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {
namespace {

// The flag is set and the signal sent without the lock: between the check of the flag and the wait.
template <bool mended>
void lost_wake_up() {
  mutex lock;
  condition_variable arrived;
  atomic<bool> letter(false);
  Crew crew;
  crew.add("postman", [&] {
    std::unique_lock guard(lock, std::defer_lock);
    if (mended) guard.lock();
    letter.store(true);
    arrived.notify_one();
  });
  crew.add("addressee", [&] {
    std::unique_lock guard(lock);
    while (!letter.load()) arrived.wait(guard);
  });
  crew.join();
}

// A bounded buffer whose producers and consumers wait on one condition variable, of whom one is woken: it may be of the
// same kind.
template <bool mended>
void one_condition() {
  mutex lock;
  condition_variable changed;
  int items = 0;
  const auto signal = [&] { mended ? changed.notify_all() : changed.notify_one(); };
  Crew crew;
  for (int i = 0; i < 2; ++i)
    crew.add("maker", [&] {
      std::unique_lock guard(lock);
      while (items == 1) changed.wait(guard);
      ++items;
      signal();
    });
  for (int i = 0; i < 2; ++i)
    crew.add("user", [&] {
      std::unique_lock guard(lock);
      while (items == 0) changed.wait(guard);
      --items;
      signal();
    });
  crew.join();
}

// The woken thread assumes a letter: another may have taken it.
template <bool mended>
void if_in_place_of_while() {
  mutex lock;
  condition_variable filled;
  std::deque<int> letters;
  Crew crew;
  for (int i = 0; i < 2; ++i)
    crew.add("reader", [&] {
      std::unique_lock guard(lock);
      if (letters.empty()) filled.wait(guard);
      while (mended && letters.empty()) filled.wait(guard);
      check(!letters.empty(), "an empty mailbox is read");
      letters.pop_front();
    });
  crew.add("writer", [&] {
    for (int i = 0; i < 2; ++i) {
      const std::lock_guard guard(lock);
      letters.push_back(i);
      filled.notify_one();
    }
  });
  crew.join();
}

// A barrier that the last thread to leave resets. The next round begins when the first is out: it may reach the barrier
// again while others have yet to leave, which then find a count that is too high, and wait forever.
template <bool mended>
void barrier_reuse() {
  constexpr int members = 3;
  mutex lock;
  condition_variable full;
  int arrived = 0, left = 0, generation = 0;
  const auto pass = [&] {
    std::unique_lock guard(lock);
    const int mine = generation;
    if (++arrived == members) {
      if (mended) arrived = 0;
      ++generation;
      full.notify_all();
    } else {
      full.wait(guard, [&] { return mended ? generation != mine : arrived == members; });
    }
    if (!mended && ++left == members) arrived = left = 0;
  };
  counting_semaphore<> out(0), next_round(0);
  Crew crew;
  for (int i = 0; i < members; ++i)
    crew.add("member", [&] {
      pass();
      out.release();
      next_round.acquire();
      pass();
    });
  out.acquire();
  next_round.release(members);
  crew.join();
}

// A token ring: all wait on one condition variable, and the woken thread need not be the next.
template <bool mended>
void token_ring() {
  constexpr int stations = 4;
  mutex ring;
  condition_variable passed;
  int holder = 0;
  Crew crew;
  for (int i = 0; i < stations; ++i)
    crew.add("station", [&, i] {
      std::unique_lock guard(ring);
      passed.wait(guard, [&] { return holder == i; });
      holder = i + 1;
      mended ? passed.notify_all() : passed.notify_one();
    });
  crew.join();
}

// Two docks and, by a miscount, three permits.
template <bool mended>
void one_permit_too_many() {
  counting_semaphore<> permits(mended ? 2 : 3);
  atomic<int> docked(0);
  Crew crew;
  for (int i = 0; i < 4; ++i)
    crew.add("robot", [&] {
      permits.acquire();
      check(docked.fetch_add(1) < 2, "three robots at two docks");
      docked.fetch_sub(1);
      permits.release();
    });
  crew.join();
}

// The start signal is an event without memory: a worker that does not wait yet never starts.
template <bool mended>
void start_signal() {
  mutex lock;
  condition_variable start;
  int ready = 0;
  bool started = false;
  Crew crew;
  for (int i = 0; i < 4; ++i)
    crew.add("worker", [&] {
      std::unique_lock guard(lock);
      ++ready;
      if (mended)
        start.wait(guard, [&] { return started; });
      else
        start.wait(guard);
    });
  crew.add("foreman", [&] {
    const std::lock_guard guard(lock);
    started = true;
    start.notify_all();
  });
  crew.join();
}

// A mailbox of two letters: the check for room precedes the lock.
template <bool mended>
void mailbox_full() {
  constexpr int room = 2;
  mutex lock;
  atomic<int> letters(0);
  Crew crew;
  for (int i = 0; i < 3; ++i)
    crew.add("sender", [&] {
      std::unique_lock guard(lock, std::defer_lock);
      if (mended) guard.lock();
      const bool has_room = letters.load() < room;
      if (!mended) guard.lock();
      if (has_room) check(letters.fetch_add(1) < room, "a letter falls out of the mailbox");
    });
  crew.join();
}

}  // namespace

Specimens signals() {
  return {{"lost wake-up", lost_wake_up<false>, lost_wake_up<true>, 2, "signal"},
          {"one condition for two", one_condition<false>, one_condition<true>, 2, "signal"},
          {"if in place of while", if_in_place_of_while<false>, if_in_place_of_while<true>, 1, "signal"},
          {"barrier reuse", barrier_reuse<false>, barrier_reuse<true>, 1, "signal"},
          {"token ring", token_ring<false>, token_ring<true>, 1, "signal"},
          {"one permit too many", one_permit_too_many<false>, one_permit_too_many<true>, 2, "signal"},
          {"start signal", start_signal<false>, start_signal<true>, 1, "signal"},
          {"mailbox full", mailbox_full<false>, mailbox_full<true>, 1, "signal"}};
}

}  // namespace waitpoint::zoo
