// SPDX-License-Identifier: BSD-3-Clause
// Atomic variables, in the names and semantics of std::atomic and std::atomic_flag.
//
// Each operation is a waitpoint, so that exploration covers the interleavings of atomics, too. All tasks run in one OS
// thread: for any requested memory order, the operations have a single total order (memory_order_seq_cst), and the weak
// form of compare-exchange never fails spuriously. Orders that the standard forbids for an operation are bugs.
//
// After the end of the run, operations that tasks may repeat until they see a change (load, exchange, compare_exchange,
// test_and_set, wait) throw Unwind as blocking calls do; the others still take effect and do not throw.
//
// Outside any task an atomic is plain memory, and the value stored there is the initial value of every run: after a
// run, the atomic has that value again.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/sync/clock.hpp"
#include "fibers/sync/ignored_accesses.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint {

using std::memory_order;
using std::memory_order_acq_rel;
using std::memory_order_acquire;
using std::memory_order_consume;
using std::memory_order_relaxed;
using std::memory_order_release;
using std::memory_order_seq_cst;

namespace sync {

/// True if two values are the same bit for bit, padding aside.
template <class T>
bool same_bits(T a, T b) {
#if defined(__has_builtin)
#if __has_builtin(__builtin_clear_padding)
  if constexpr (!std::has_unique_object_representations_v<T> && !std::is_same_v<T, float> &&
                !std::is_same_v<T, double>) {
    __builtin_clear_padding(&a);
    __builtin_clear_padding(&b);
  }
#endif
#endif
  return std::memcmp(&a, &b, sizeof a) == 0;
}

constexpr bool can_load(memory_order order) { return order != memory_order_release && order != memory_order_acq_rel; }
constexpr bool can_store(memory_order order) {
  return order == memory_order_relaxed || order == memory_order_release || order == memory_order_seq_cst;
}

template <class T>
concept AtomicNumber = (std::is_integral_v<T> && !std::is_same_v<T, bool>) || std::is_floating_point_v<T>;
template <class T>
concept AtomicInteger = AtomicNumber<T> && std::is_integral_v<T>;
template <class T>
concept AtomicPointer = std::is_pointer_v<T> && std::is_object_v<std::remove_pointer_t<T>>;

/// a + b, without overflow for integers: they wrap around.
template <class T, class Difference>
T sum(T a, Difference b) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
  else
    return a + b;
}
template <class T, class Difference>
T difference(T a, Difference b) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
  else
    return a - b;
}

}  // namespace sync

template <class T>
class atomic {
  static_assert(std::is_trivially_copyable_v<T> && std::is_copy_constructible_v<T> && std::is_copy_assignable_v<T>);

 public:
  using value_type = T;
  using difference_type = std::conditional_t<std::is_pointer_v<T>, std::ptrdiff_t, T>;
  static constexpr bool is_always_lock_free = true;  // no other operation can be in progress

  constexpr atomic() noexcept(std::is_nothrow_default_constructible_v<T>) : value_(), initial_() {}
  /// `label` is shown in reports; it must outlive the atomic.
  constexpr atomic(T value, const char* label = "") noexcept
      : object_("atomic", label), value_(value), initial_(value) {}
  atomic(const atomic&) = delete;
  atomic& operator=(const atomic&) = delete;

  bool is_lock_free() const noexcept { return true; }

  T load(memory_order order = memory_order_seq_cst) const {
    WAITPOINT_REQUIRE(sync::can_load(order), "an atomic load with a release order");
    before_looking(kernel::Operation::load);
    return get();
  }
  operator T() const { return load(); }
  void store(T value, memory_order order = memory_order_seq_cst) {
    WAITPOINT_REQUIRE(sync::can_store(order), "an atomic store with an acquire order");
    before_changing(kernel::Operation::store);
    put(value);
  }
  T operator=(T value) {
    store(value);
    return value;
  }
  T exchange(T value, memory_order = memory_order_seq_cst) {
    before_looking(kernel::Operation::exchange);
    return put(value);
  }
  bool compare_exchange_strong(T& expected, T desired, memory_order, memory_order failure) {
    WAITPOINT_REQUIRE(sync::can_load(failure), "a compare-exchange with a release order for its failure");
    return compare_exchange_strong(expected, desired);
  }
  bool compare_exchange_strong(T& expected, T desired, memory_order = memory_order_seq_cst) {
    before_looking(kernel::Operation::compare_exchange);
    const bool equal = sync::same_bits(get(), expected);
    if (equal)
      put(desired);
    else
      expected = get();
    return equal;
  }
  bool compare_exchange_weak(T& expected, T desired, memory_order success, memory_order failure) {
    return compare_exchange_strong(expected, desired, success, failure);
  }
  bool compare_exchange_weak(T& expected, T desired, memory_order order = memory_order_seq_cst) {
    return compare_exchange_strong(expected, desired, order);
  }

  T fetch_add(difference_type by,
              memory_order = memory_order_seq_cst) requires sync::AtomicNumber<T> || sync::AtomicPointer<T> {
    before_changing(kernel::Operation::modify);
    return put(sync::sum(get(), by));
  }
  T fetch_sub(difference_type by,
              memory_order = memory_order_seq_cst) requires sync::AtomicNumber<T> || sync::AtomicPointer<T> {
    before_changing(kernel::Operation::modify);
    return put(sync::difference(get(), by));
  }
  T fetch_and(T bits, memory_order = memory_order_seq_cst) requires sync::AtomicInteger<T> {
    before_changing(kernel::Operation::modify);
    return put(static_cast<T>(get() & bits));
  }
  T fetch_or(T bits, memory_order = memory_order_seq_cst) requires sync::AtomicInteger<T> {
    before_changing(kernel::Operation::modify);
    return put(static_cast<T>(get() | bits));
  }
  T fetch_xor(T bits, memory_order = memory_order_seq_cst) requires sync::AtomicInteger<T> {
    before_changing(kernel::Operation::modify);
    return put(static_cast<T>(get() ^ bits));
  }

  T operator+=(difference_type by) requires sync::AtomicNumber<T> || sync::AtomicPointer<T> {
    return sync::sum(fetch_add(by), by);
  }
  T operator-=(difference_type by) requires sync::AtomicNumber<T> || sync::AtomicPointer<T> {
    return sync::difference(fetch_sub(by), by);
  }
  T operator++() requires sync::AtomicInteger<T> || sync::AtomicPointer<T> { return *this += 1; }
  T operator--() requires sync::AtomicInteger<T> || sync::AtomicPointer<T> { return *this -= 1; }
  T operator++(int) requires sync::AtomicInteger<T> || sync::AtomicPointer<T> { return fetch_add(1); }
  T operator--(int) requires sync::AtomicInteger<T> || sync::AtomicPointer<T> { return fetch_sub(1); }
  T operator&=(T bits) requires sync::AtomicInteger<T> { return static_cast<T>(fetch_and(bits) & bits); }
  T operator|=(T bits) requires sync::AtomicInteger<T> { return static_cast<T>(fetch_or(bits) | bits); }
  T operator^=(T bits) requires sync::AtomicInteger<T> { return static_cast<T>(fetch_xor(bits) ^ bits); }

  /// Blocks until a notification finds the value different from `old`; returns at once if it differs already.
  void wait(T old, memory_order order = memory_order_seq_cst) const {
    WAITPOINT_REQUIRE(sync::can_load(order), "an atomic load with a release order");
    (void)wait_before(old, Time::max());
  }
  /// As wait(); false if the value is still `old` at the deadline. The standard has no timed waits here.
  template <class Rep, class Ratio>
  bool try_wait_for(T old, const std::chrono::duration<Rep, Ratio>& span) const {
    return wait_before(old, sync::after(span));
  }
  template <class Clock, class Span>
  bool try_wait_until(T old, const std::chrono::time_point<Clock, Span>& deadline) const {
    return wait_before(old, sync::until(deadline));
  }
  void notify_one() {
    if (kernel::running == nullptr) return;
    before_changing(kernel::Operation::notify_one);
    const sync::IgnoredAccesses ignored_accesses;
    if (kernel::wake_one(*kernel::running->scheduler, object_) != nullptr) kernel::note_transfer();
  }
  void notify_all() {
    if (kernel::running == nullptr) return;
    before_changing(kernel::Operation::notify_all);
    if (object_.first_waiter != nullptr) kernel::note_transfer();
    kernel::wake_all(*kernel::running->scheduler, object_);
  }

 private:
  void refresh() const {
    const sync::IgnoredAccesses ignored_accesses;
    if (kernel::enter(object_)) value_ = initial_;
  }
  void before_looking(kernel::Operation operation) const {
    if (kernel::running == nullptr) return;
    refresh();
    sync::before_blocking(operation, object_);
  }
  void before_changing(kernel::Operation operation) const {
    if (kernel::running == nullptr) return;
    refresh();
    sync::before_releasing(operation, object_);
  }
  T get() const {
    const sync::IgnoredAccesses ignored_accesses;
    return value_;
  }
  // Returns the previous value.
  T put(T value) {
    const sync::IgnoredAccesses ignored_accesses;
    const T before = value_;
    value_ = value;
    if (kernel::running == nullptr) initial_ = value;
    return before;
  }
  bool wait_before(T old, Time deadline) const {
    (void)sync::running_task();
    before_looking(kernel::Operation::wait);
    while (sync::same_bits(get(), old)) {
      if (deadline <= now()) return false;
      if (!sync::block(object_, deadline)) return !sync::same_bits(get(), old);
    }
    return true;
  }

  mutable sync::Object object_{"atomic"};
  mutable T value_;
  T initial_;
};

template <class T>
atomic(T) -> atomic<T>;

class atomic_flag {
 public:
  constexpr atomic_flag() = default;
  /// `label` is shown in reports; it must outlive the flag.
  explicit constexpr atomic_flag(const char* label) : set_(false, label) {}
  atomic_flag(const atomic_flag&) = delete;
  atomic_flag& operator=(const atomic_flag&) = delete;

  bool test(memory_order order = memory_order_seq_cst) const { return set_.load(order); }
  bool test_and_set(memory_order order = memory_order_seq_cst) { return set_.exchange(true, order); }
  void clear(memory_order order = memory_order_seq_cst) { set_.store(false, order); }
  void wait(bool old, memory_order order = memory_order_seq_cst) const { set_.wait(old, order); }
  template <class Rep, class Ratio>
  bool try_wait_for(bool old, const std::chrono::duration<Rep, Ratio>& span) const {
    return set_.try_wait_for(old, span);
  }
  template <class Clock, class Span>
  bool try_wait_until(bool old, const std::chrono::time_point<Clock, Span>& deadline) const {
    return set_.try_wait_until(old, deadline);
  }
  void notify_one() { set_.notify_one(); }
  void notify_all() { set_.notify_all(); }

 private:
  atomic<bool> set_{false, ""};
};

/// A waitpoint; all operations are sequentially consistent already.
inline void atomic_thread_fence(memory_order) {
  (void)kernel::waitpoint(*sync::running_task().scheduler, kernel::Operation::fence, nullptr);
}
/// No effect: signals are delivered at waitpoints.
inline void atomic_signal_fence(memory_order) {}

using atomic_bool = atomic<bool>;
using atomic_char = atomic<char>;
using atomic_int = atomic<int>;
using atomic_uint = atomic<unsigned>;
using atomic_long = atomic<long>;
using atomic_ulong = atomic<unsigned long>;
using atomic_llong = atomic<long long>;
using atomic_ullong = atomic<unsigned long long>;
using atomic_int32_t = atomic<std::int32_t>;
using atomic_uint32_t = atomic<std::uint32_t>;
using atomic_int64_t = atomic<std::int64_t>;
using atomic_uint64_t = atomic<std::uint64_t>;
using atomic_size_t = atomic<std::size_t>;
using atomic_ptrdiff_t = atomic<std::ptrdiff_t>;

}  // namespace waitpoint
