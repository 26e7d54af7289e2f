// SPDX-License-Identifier: BSD-3-Clause
// Work-stealing queues: their owner pushes and takes items at the tail, thieves steal at the head. The specimens with
// the same text on simulated threads (tests/zoo) and on system threads (tests/exec/zoo).
//
// The includer declares the primitives before, in this namespace: Crew, check, atomic, mutex.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>

namespace waitpoint::zoo {
namespace {

inline constexpr int no_item = -1;

// In the style of Cilk's THE protocol: owner and thief first announce what they take, then look for the other's
// announcement; the lock decides between them. Here the thief looks before it announces.
template <bool mended>
class TheQueue {
 public:
  void push(int item) {
    const int tail = tail_.load();
    items_[place(tail)].store(item);
    tail_.store(tail + 1);
  }

  int take() {
    int tail = tail_.load() - 1;
    tail_.store(tail);
    if (head_.load() <= tail) return items_[place(tail)].load();
    tail_.store(tail + 1);
    const std::lock_guard guard(lock_);
    tail = tail_.load() - 1;
    if (head_.load() > tail) return no_item;
    tail_.store(tail);
    return items_[place(tail)].load();
  }

  int steal() {
    const std::lock_guard guard(lock_);
    const int head = head_.load();
    if (mended) head_.store(head + 1);
    if (head >= tail_.load()) {
      if (mended) head_.store(head);
      return no_item;
    }
    if (!mended) head_.store(head + 1);
    return items_[place(head)].load();
  }

 private:
  static constexpr std::size_t size = 8;
  static std::size_t place(int number) { return static_cast<std::size_t>(number) % size; }

  std::array<atomic<int>, size> items_;
  atomic<int> head_{0}, tail_{0};
  mutex lock_;
};

// Who takes at either end holds the queue by its state word; the owner needs it for the last item only. Here it looks
// whether that is so before it has announced what it takes.
template <bool mended>
class StateQueue {
 public:
  void push(int item) {
    const int tail = tail_.load();
    items_[place(tail)].store(item);
    tail_.store(tail + 1);
  }

  int take() {
    const int tail = tail_.load() - 1;
    if (!mended && head_.load() < tail) {
      tail_.store(tail);
      return items_[place(tail)].load();
    }
    int was_free = free;
    if (!state_.compare_exchange_strong(was_free, held)) return no_item;
    int item = no_item;
    if (head_.load() <= tail) {
      tail_.store(tail);
      item = items_[place(tail)].load();
    }
    state_.store(free);
    return item;
  }

  int steal() {
    int was_free = free;
    if (!state_.compare_exchange_strong(was_free, held)) return no_item;
    int item = no_item;
    if (const int head = head_.load(); head < tail_.load()) {
      item = items_[place(head)].load();
      head_.store(head + 1);
    }
    state_.store(free);
    return item;
  }

 private:
  enum State { free, held };
  static constexpr std::size_t size = 8;
  static std::size_t place(int number) { return static_cast<std::size_t>(number) % size; }

  std::array<atomic<int>, size> items_;
  atomic<int> head_{0}, tail_{0}, state_{free};
};

// The owner pushes two items and takes one, several times; two thieves steal now and then. What is left is taken in the
// end: each item must have come exactly once.
template <class Queue>
void steal_from() {
  constexpr int rounds = 3, attempts = 2;
  constexpr std::size_t thieves = 2, items = std::size_t{2} * rounds;
  Queue queue;
  std::array<std::array<int, items>, thieves + 1> taken{};  // by thread and item
  const auto note = [&taken](std::size_t thread, int item) {
    if (item != no_item) ++taken[thread][static_cast<std::size_t>(item)];
  };
  Crew crew;
  crew.add("owner", [&] {
    for (int round = 0; round < rounds; ++round) {
      queue.push(2 * round);
      queue.push(2 * round + 1);
      note(0, queue.take());
    }
  });
  for (std::size_t thief = 1; thief <= thieves; ++thief)
    crew.add("thief", [&, thief] {
      for (int attempt = 0; attempt < attempts; ++attempt) note(thief, queue.steal());
    });
  crew.join();
  for (int item = queue.steal(); item != no_item; item = queue.steal()) note(0, item);
  for (std::size_t item = 0; item < items; ++item) {
    int times = 0;
    for (const auto& own : taken) times += own[item];
    check(times == 1, times == 0 ? "an item is lost" : "an item is taken twice");
  }
}

}  // namespace
}  // namespace waitpoint::zoo
