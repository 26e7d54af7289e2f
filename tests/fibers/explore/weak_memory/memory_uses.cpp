// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/memory_uses.hpp"

#include <atomic>
#include <cstdint>
#include <new>

#include "fibers/explore/check.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::weak_memory {
namespace {

constexpr auto relaxed = std::memory_order_relaxed;

template <class Function>
void in_two_threads(const Function& function) {
  thread one(function), two(function);
  one.join();
  two.join();
}

}  // namespace

void wait_for_a_flag() {
  std::atomic<bool> flag(false);
  thread waiter([&] {
    while (!flag.load(relaxed)) {
    }
  });
  flag.store(true, relaxed);
  waiter.join();
}

void reuse_memory() {
  alignas(std::atomic<int>) unsigned char memory[sizeof(std::atomic<int>)];
  for (int round = 0; round < 2; ++round) {
    auto* const value = new (memory) std::atomic<int>(10);
    thread one([&] { value->store(20, relaxed); });
    thread two([&] { check(value->load(relaxed) >= 10, "a value is read that was there before the construction"); });
    one.join();
    two.join();
    check(value->load(relaxed) == 20, "a value is read that was there before the join");
    value->~atomic();
    *std::launder(reinterpret_cast<int*>(memory)) = 1;
  }
}

void modify_plainly() {
  alignas(4) int value = 0;
  mutex lock;
  const auto work = [&] {
    lock.lock();
    const int before = std::atomic_ref(value).load(relaxed);
    value = before + 1;
    check(std::atomic_ref(value).load(relaxed) == before + 1, "a plain store is not read");
    std::atomic_ref(value).store(before + 2, relaxed);
    lock.unlock();
  };
  in_two_threads(work);
  check(value == 4, "an update is lost");
}

void access_in_two_sizes() {
  struct alignas(8) Halves {
    std::uint32_t low = 0, high = 0;
  } halves;
  const auto whole = [&] { return __atomic_load_n(reinterpret_cast<std::uint64_t*>(&halves), __ATOMIC_RELAXED); };
  thread one([&] { __atomic_store_n(&halves.low, 1, __ATOMIC_RELAXED); });
  thread two([&] { __atomic_fetch_add(&halves.high, 1, __ATOMIC_RELAXED); });
  one.join();
  two.join();
  check(whole() == (std::uint64_t{1} << 32 | 1), "a store to a half is not read");
  __atomic_store_n(reinterpret_cast<std::uint64_t*>(&halves), 0, __ATOMIC_RELAXED);
  check(__atomic_load_n(&halves.high, __ATOMIC_RELAXED) == 0, "a store to both halves is not read");
}

void store_often() {
  std::atomic<int> value(0);
  thread writer([&] {
    for (int i = 1; i <= 12; ++i) value.store(i, relaxed);
  });
  thread reader([&] { (void)value.load(relaxed); });
  writer.join();
  reader.join();
}

void construct_a_static() {
  in_two_threads([] {
    static const int made = [] {
      this_thread::yield();
      return 3;
    }();
    check(made == 3, "a static is used before it is made");
  });
}

void buffer_stores() {
  std::atomic<int> x(0), y(0);
  int seen_x = 0, seen_y = 0;
  thread one([&] {
    x.store(1, relaxed);
    seen_y = y.load(relaxed);
  });
  thread two([&] {
    y.store(1, relaxed);
    seen_x = x.load(relaxed);
  });
  one.join();
  two.join();
  check(seen_x + seen_y != 0, "both stores are missed");
}

}  // namespace waitpoint::weak_memory
