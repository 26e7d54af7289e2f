// SPDX-License-Identifier: BSD-3-Clause
// The names of threads.hpp on the standard library's threads and the wall clock: for the robot itself.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "core/time.hpp"
#include "fibers/kernel/clock_options.hpp"
#include "fibers/kernel/stack_arena.hpp"

namespace waitpoint::threads {

using kernel::ClockKind;
using kernel::ClockOptions;
using std::chrono::steady_clock;

struct real {};
using kind = real;

/// Wall-clock time since the process first asked.
inline Time now() {
  static const steady_clock::time_point start = steady_clock::now();
  return Time() + Duration(std::chrono::nanoseconds(steady_clock::now() - start));
}
inline void compute(Duration) {}
inline void compute(Duration, Duration) {}
inline void access_hardware(Duration) {}
template <class T>
void record(std::uint64_t, const T&) {}

struct mutex : std::mutex {
  mutex() = default;
  explicit mutex(const char*) {}
};
using observer_lock = std::lock_guard<mutex>;
struct timed_mutex : std::timed_mutex {
  timed_mutex() = default;
  explicit timed_mutex(const char*) {}
};
struct condition_variable : std::condition_variable_any {
  condition_variable() = default;
  explicit condition_variable(const char*) {}
};
/// Not the standard library's: libstdc++ 12's loses wake-ups where several threads acquire.
template <std::ptrdiff_t LeastMax = PTRDIFF_MAX>
class counting_semaphore {
 public:
  explicit counting_semaphore(std::ptrdiff_t initial, const char* = "") : count_(initial) {}
  static constexpr std::ptrdiff_t max() noexcept { return LeastMax; }

  // Notifies under the lock: who acquires may destroy the semaphore then.
  void release(std::ptrdiff_t units = 1) {
    const std::lock_guard guard(mutex_);
    count_ += units;
    units == 1 ? released_.notify_one() : released_.notify_all();
  }
  void acquire() {
    std::unique_lock lock(mutex_);
    released_.wait(lock, [this] { return count_ > 0; });
    --count_;
  }
  bool try_acquire() {
    const std::lock_guard guard(mutex_);
    return count_ > 0 && count_-- > 0;
  }
  template <class Rep, class Ratio>
  bool try_acquire_for(const std::chrono::duration<Rep, Ratio>& span) {
    return try_acquire_until(steady_clock::now() + std::chrono::ceil<std::chrono::nanoseconds>(span));
  }
  bool try_acquire_until(steady_clock::time_point deadline) {
    std::unique_lock lock(mutex_);
    if (!released_.wait_until(lock, deadline, [this] { return count_ > 0; })) return false;
    --count_;
    return true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable released_;
  std::ptrdiff_t count_;
};
using binary_semaphore = counting_semaphore<1>;

struct processor {
  explicit processor(const char* = "") {}
};

struct thread_attributes {
  const char* name = "thread";
  kernel::StackSize stack = kernel::StackSize::medium;
  bool service = false;
  ClockOptions clock = {};  ///< not heeded, like the rest: the system has its own
  processor* on = nullptr;
  int priority = 0;
};

class thread : public std::thread {
 public:
  thread() = default;
  template <class Function, class... Arguments>
  requires(!std::is_same_v<std::remove_cvref_t<Function>, thread> &&
           !std::is_same_v<std::remove_cvref_t<Function>, thread_attributes>) explicit thread(Function&& function,
                                                                                              Arguments&&... arguments)
      : std::thread(std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
  template <class Function, class... Arguments>
  thread(const thread_attributes&, Function&& function, Arguments&&... arguments)
      : std::thread(std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
};

namespace this_thread {
using std::this_thread::get_id;
using std::this_thread::sleep_for;
using std::this_thread::sleep_until;
using std::this_thread::yield;
inline void sleep_for(Duration span) { std::this_thread::sleep_for(std::chrono::nanoseconds(span.ns())); }
inline void sleep_until(Time time) { sleep_for(time - now()); }
}  // namespace this_thread

class periodic_timer {
 public:
  explicit periodic_timer(Period period, Duration phase = Duration(), const char* = "")
      : period_(period), phase_(phase) {}

  std::int64_t wait() {
    const Duration since = now().since_start() - phase_;
    const std::int64_t coming = since < Duration() ? 0 : period_.first_tick_at_or_after(since + Duration::from_ns(1));
    if (next_ < 0) next_ = coming;
    if (next_ >= coming) {
      next_ = coming;
      this_thread::sleep_until(Time() + phase_ + period_.tick(coming));
    }
    const std::int64_t last = next_ >= coming ? coming : coming - 1;
    const std::int64_t ticks = last - next_ + 1;
    due_ = Time() + phase_ + period_.tick(last);
    next_ = last + 1;
    return ticks;
  }
  Time due() const { return due_; }

 private:
  Period period_;
  Duration phase_;
  std::int64_t next_ = -1;
  Time due_;
};

}  // namespace waitpoint::threads
