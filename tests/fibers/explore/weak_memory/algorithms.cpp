// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/algorithms.hpp"

#include <array>
#include <memory>

#include "fibers/explore/check.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::weak_memory {
namespace {

constexpr Order relaxed = std::memory_order_relaxed, acquire = std::memory_order_acquire,
                release = std::memory_order_release, seq_cst = std::memory_order_seq_cst;

// What a lock protects.
class Region {
 public:
  void enter() { check(inside_.exchange(true, relaxed) == false, "two threads are inside"); }
  void leave() { inside_.store(false, relaxed); }

 private:
  std::atomic<bool> inside_{false};
};

template <class Function>
void in_two_threads(const Function& function) {
  thread one([&] { function(0U); }), two([&] { function(1U); });
  one.join();
  two.join();
}

}  // namespace

void peterson(Order stores, Order loads) {
  std::array<std::atomic<bool>, 2> wants{};
  std::atomic<unsigned> turn(0);
  Region region;
  in_two_threads([&](unsigned own) {
    const unsigned other = 1 - own;
    wants[own].store(true, stores);
    turn.store(other, stores);
    while (wants[other].load(loads) && turn.load(loads) == other) {
    }
    region.enter();
    region.leave();
    wants[own].store(false, stores);
  });
}

void dekker(Order fence) {
  std::array<std::atomic<bool>, 2> wants{};
  std::atomic<unsigned> turn(0);
  Region region;
  in_two_threads([&](unsigned own) {
    const unsigned other = 1 - own;
    wants[own].store(true, relaxed);
    std::atomic_thread_fence(fence);
    while (wants[other].load(relaxed)) {
      if (turn.load(relaxed) == own) continue;
      wants[own].store(false, relaxed);
      while (turn.load(relaxed) != own) {
      }
      wants[own].store(true, relaxed);
      std::atomic_thread_fence(fence);
    }
    std::atomic_thread_fence(acquire);
    region.enter();
    region.leave();
    turn.store(other, relaxed);
    std::atomic_thread_fence(release);
    wants[own].store(false, relaxed);
  });
}

void spinlock(Order unlock) {
  std::atomic<bool> locked(false);
  std::atomic<int> count(0);
  in_two_threads([&](unsigned) {
    while (locked.exchange(true, acquire)) {
    }
    count.store(count.load(relaxed) + 1, relaxed);
    locked.store(false, unlock);
  });
  check(count.load(relaxed) == 2, "an update is lost");
}

void sequence_lock(Order writers_fence, Order readers_fence) {
  std::atomic<unsigned> sequence(0);
  std::atomic<int> left(0), right(0);
  thread writer([&] {
    for (int value = 1; value <= 2; ++value) {
      const unsigned before = sequence.load(relaxed);
      sequence.store(before + 1, relaxed);
      std::atomic_thread_fence(writers_fence);
      left.store(value, relaxed);
      right.store(value, relaxed);
      sequence.store(before + 2, release);
    }
  });
  const unsigned before = sequence.load(acquire);
  const int seen_left = left.load(relaxed), seen_right = right.load(relaxed);
  std::atomic_thread_fence(readers_fence);
  if (sequence.load(relaxed) == before && before % 2 == 0) check(seen_left == seen_right, "half of an update is read");
  writer.join();
}

namespace {

class Deque {
 public:
  static constexpr int none = 0;

  explicit Deque(Order fence_of_take) : fence_of_take_(fence_of_take) {}

  void push(int value) {
    const int bottom = bottom_.load(relaxed);
    (void)top_.load(acquire);
    values_[static_cast<unsigned>(bottom)].store(value, relaxed);
    std::atomic_thread_fence(release);
    bottom_.store(bottom + 1, relaxed);
  }
  int take() {
    const int bottom = bottom_.load(relaxed) - 1;
    bottom_.store(bottom, relaxed);
    std::atomic_thread_fence(fence_of_take_);
    int top = top_.load(relaxed);
    if (top > bottom) {
      bottom_.store(bottom + 1, relaxed);
      return none;
    }
    int value = values_[static_cast<unsigned>(bottom)].load(relaxed);
    if (top < bottom) return value;
    if (!top_.compare_exchange_strong(top, top + 1, seq_cst, relaxed)) value = none;
    bottom_.store(bottom + 1, relaxed);
    return value;
  }
  int steal() {
    int top = top_.load(acquire);
    std::atomic_thread_fence(seq_cst);
    if (top >= bottom_.load(acquire)) return none;
    const int value = values_[static_cast<unsigned>(top)].load(relaxed);
    return top_.compare_exchange_strong(top, top + 1, seq_cst, relaxed) ? value : none;
  }

 private:
  Order fence_of_take_;
  std::atomic<int> top_{0}, bottom_{0};
  std::array<std::atomic<int>, 4> values_{};
};

}  // namespace

void work_stealing_deque(Order fence_of_take) {
  Deque deque(fence_of_take);
  std::array<std::atomic<int>, 3> taken{};
  const auto note = [&](int value) {
    if (value != Deque::none)
      check(taken[static_cast<unsigned>(value)].fetch_add(1, relaxed) == 0, "an element is taken twice");
  };
  deque.push(1);
  deque.push(2);
  thread thief([&] {
    note(deque.steal());
    note(deque.steal());
  });
  note(deque.take());
  note(deque.take());
  thief.join();
}

namespace {

struct Settings {
  std::atomic<int> size{0};
};

}  // namespace

void double_checked_lock(Order publication, Order look) {
  mutex lock;
  std::atomic<Settings*> shared(nullptr);
  std::unique_ptr<Settings> made;
  in_two_threads([&](unsigned) {
    Settings* found = shared.load(look);
    if (found == nullptr) {
      lock.lock();
      found = shared.load(relaxed);
      if (found == nullptr) {
        made = std::make_unique<Settings>();
        found = made.get();
        found->size.store(7, relaxed);
        shared.store(found, publication);
      }
      lock.unlock();
    }
    check(found->size.load(relaxed) == 7, "the settings are read before they are made");
  });
}

}  // namespace waitpoint::weak_memory
