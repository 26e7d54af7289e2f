// SPDX-License-Identifier: BSD-3-Clause
// The standard's atomics in instrumented code: they are switch points, and their memory orders count.
#include <atomic>
#include <memory>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/races/programs.hpp"

namespace waitpoint::races {
namespace {

// A payload, handed over by a flag with these memory orders.
template <std::memory_order Store, std::memory_order Load>
void handed_over() {
  std::atomic<int> flag(0);
  int payload = 0, seen = 0;
  thread other([&] {
    while (flag.load(Load) == 0) {
    }
    seen = payload;
  });
  payload = 1;
  flag.store(1, Store);
  other.join();
}

template <bool Released, bool Acquired>
void fenced() {
  std::atomic<int> flag(0);
  int payload = 0, seen = 0;
  thread other([&] {
    while (flag.load(std::memory_order_relaxed) == 0) {
    }
    if (Acquired) std::atomic_thread_fence(std::memory_order_acquire);
    seen = payload;
  });
  payload = 1;
  if (Released) std::atomic_thread_fence(std::memory_order_release);
  flag.store(1, std::memory_order_relaxed);
  other.join();
}

template <std::memory_order Success>
void spin_lock() {
  std::atomic<bool> locked(false);
  int shared = 0;
  const auto count = [&] {
    bool expected = false;
    while (!locked.compare_exchange_weak(expected, true, Success, std::memory_order_relaxed)) expected = false;
    ++shared;
    locked.store(false, std::memory_order_release);
  };
  thread one(count), two(count);
  one.join();
  two.join();
}

// A third thread modifies the flag between the release and the acquire: a read-modify-write continues the release
// sequence, a store ends it.
template <bool Modifies>
void release_sequence() {
  std::atomic<int> flag(0);
  int payload = 0, seen = 0;
  thread between([&] {
    while (flag.load(std::memory_order_relaxed) != 1) {
    }
    Modifies ? void(flag.fetch_add(1, std::memory_order_relaxed)) : flag.store(2, std::memory_order_relaxed);
  });
  thread reader([&] {
    while (flag.load(std::memory_order_relaxed) != 2) {
    }
    (void)flag.load(std::memory_order_acquire);
    seen = payload;
  });
  payload = 1;
  flag.store(1, std::memory_order_release);
  between.join();
  reader.join();
}

template <class T>
void counted() {
  std::atomic<T> count(T{0});
  const auto work = [&] {
    for (int i = 0; i < 3; ++i) {
      count.fetch_add(1, std::memory_order_relaxed);
      count.fetch_or(1);
      count.fetch_and(static_cast<T>(~T{0}));
      count.fetch_xor(0);
      count.fetch_sub(1);
      count.exchange(5);
    }
  };
  thread one(work), two(work);
  one.join();
  two.join();
}
void of_16_bytes() {
  alignas(16) unsigned __int128 value = 0;
  const auto work = [&] {
    unsigned __int128 expected = 0;
    while (!__atomic_compare_exchange_n(&value, &expected, expected + 1, false, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST)) {
    }
  };
  thread one(work), two(work);
  one.join();
  two.join();
}
void plain_against_atomic() {
  alignas(4) int value = 0;
  thread other([&] { std::atomic_ref(value).store(1); });
  value = 2;
  other.join();
}

constexpr auto relaxed = std::memory_order_relaxed, acquire = std::memory_order_acquire,
               release = std::memory_order_release, strongest = std::memory_order_seq_cst;

constexpr Program programs[] = {
    {"release_acquire", handed_over<release, acquire>, false},
    {"strongest", handed_over<strongest, strongest>, false},
    {"relaxed", handed_over<relaxed, relaxed>, true},
    {"relaxed_store", handed_over<relaxed, acquire>, true},
    {"relaxed_load", handed_over<release, relaxed>, true},
    {"two_fences", fenced<true, true>, false},
    {"release_fence_alone", fenced<true, false>, true},
    {"acquire_fence_alone", fenced<false, true>, true},
    {"spin_lock", spin_lock<acquire>, false},
    {"relaxed_spin_lock", spin_lock<relaxed>, true},
    {"release_sequence", release_sequence<true>, false},
    {"broken_release_sequence", release_sequence<false>, true},
    {"counted_8", counted<std::uint8_t>, false},
    {"counted_16", counted<std::uint16_t>, false},
    {"counted_32", counted<std::uint32_t>, false},
    {"counted_64", counted<std::uint64_t>, false},
    {"of_16_bytes", of_16_bytes, false},
    {"plain_against_atomic", plain_against_atomic, true},
};

}  // namespace

std::span<const Program> atomic_programs() { return programs; }

void share_late() {
  static std::atomic<std::atomic<int>*> shared;
  shared = nullptr;
  thread writer([&] {
    if (std::atomic<int>* const value = shared.load(); value != nullptr) value->store(1);
  });
  const auto value = std::make_unique<std::atomic<int>>(0);
  shared.store(value.get());
  (void)value->load();
  writer.join();
}

void wait_for_nobody() {
  thread other([] {
    std::atomic<bool> never(false);
    while (!never.load()) {
    }
  });
  other.join();
}

}  // namespace waitpoint::races
