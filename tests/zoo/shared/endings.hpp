// SPDX-License-Identifier: BSD-3-Clause
// Ends during ongoing work: the specimens with the same text on simulated threads (tests/zoo) and on system threads
// (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, this_thread, atomic, condition_variable,
// mutex, promise, stop_source.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>

namespace waitpoint::zoo {
namespace {

// A stop requested between the check of the token and the wait wakes no one. Mended, the stopper takes the lock.
template <bool mended>
void stop_between() {
  mutex lock;
  condition_variable work;
  stop_source source;
  Crew crew;
  crew.add("stopper", [&] {
    source.request_stop();
    std::unique_lock guard(lock, std::defer_lock);
    if (mended) guard.lock();
    work.notify_all();
  });
  crew.add("worker", [&] {
    std::unique_lock guard(lock);
    while (!source.stop_requested()) work.wait(guard);
  });
  crew.join();
}

// Two answers to one request: each checks for an earlier one.
template <bool mended>
void promise_kept_twice() {
  promise<int> answer;
  atomic<bool> given(false);
  Crew crew;
  for (int i = 0; i < 2; ++i)
    crew.add("server", [&, i] {
      const bool was_given = mended ? given.exchange(true) : given.load();
      if (was_given) return;
      given.store(true);
      answer.set_value(i);
    });
  crew.join();
  (void)answer.get_future().get();
}

// A request is completed while its client cancels it: both finish it, and its buffer is returned twice.
template <bool mended>
void cancel_against_complete() {
  enum State { pending, running, completed, cancelled };
  atomic<State> state(pending);
  atomic<int> given_back(0);
  Crew crew;
  crew.add("server", [&] {
    State seen = pending;
    if (!state.compare_exchange_strong(seen, running)) return;
    seen = running;
    if (mended && !state.compare_exchange_strong(seen, completed)) return;
    if (!mended) state.store(completed);
    given_back.fetch_add(1);
  });
  crew.add("client", [&] {
    State seen = state.load();
    while (seen != completed && !state.compare_exchange_strong(seen, cancelled)) {
    }
    if (seen != completed) given_back.fetch_add(1);
  });
  crew.join();
  check(given_back.load() == 1, "the buffer is given back twice");
}

// Readers register after they have read the table in use; the old table is freed when no reader is registered.
template <bool mended>
void freed_in_use() {
  std::array<atomic<bool>, 2> freed;
  std::array<atomic<int>, 2> readers;
  atomic<std::size_t> used(0);
  Crew crew;
  crew.add("reader", [&] {
    std::size_t table = used.load();
    readers[table].fetch_add(1);
    while (mended && table != used.load()) {
      readers[table].fetch_sub(1);
      table = used.load();
      readers[table].fetch_add(1);
    }
    check(!freed[table].load(), "a table is read that is freed");
    readers[table].fetch_sub(1);
  });
  crew.add("updater", [&] {
    used.store(1);
    while (readers[0].load() != 0) this_thread::yield();
    freed[0].store(true);
  });
  crew.join();
}

// A pool closes when no job is open; a job that creates another closes itself first.
template <bool mended>
void closed_too_early() {
  atomic<int> open(1);
  atomic<bool> closed(false);
  Crew crew;
  crew.add("job", [&] {
    for (int i = 0; i < 3; ++i) {
      if (mended) open.fetch_add(1);
      open.fetch_sub(1);
      if (!mended) open.fetch_add(1);
      check(!closed.load(), "a job comes to a pool that is closed");
    }
    open.fetch_sub(1);
  });
  crew.add("pool", [&] {
    while (open.load() != 0) this_thread::yield();
    closed.store(true);
  });
  crew.join();
}

}  // namespace
}  // namespace waitpoint::zoo
