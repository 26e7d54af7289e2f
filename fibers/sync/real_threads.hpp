// SPDX-License-Identifier: BSD-3-Clause
// The names of threads.hpp on the standard library's threads and the wall clock: for the robot itself.
#pragma once

#include <atomic>
#include <barrier>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <latch>
#include <mutex>
#include <shared_mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "core/time.hpp"
#include "core/working_set.hpp"
#include "fibers/clocks/clock_options.hpp"
#include "fibers/switch/stack_arena.hpp"
#include "fibers/sync/local_values.hpp"
#include "fibers/sync/real_priority_mutex.hpp"

namespace waitpoint::threads {

using kernel::ClockKind;
using kernel::ClockOptions;
using kernel::LockProtocol;
using std::async;
using std::atomic_signal_fence;
using std::atomic_thread_fence;
using std::call_once;
using std::future;
using std::launch;
using std::nostopstate;
using std::nostopstate_t;
using std::packaged_task;
using std::promise;
using std::shared_future;
using std::stop_callback;
using std::stop_source;
using std::stop_token;
using std::chrono::steady_clock;
using waitpoint::mutex_attributes;

struct system_clock : std::chrono::system_clock {
  template <class Span>
  static std::chrono::sys_time<Span> to_sys(const std::chrono::sys_time<Span>& t) {
    return t;
  }
  template <class Span>
  static std::chrono::sys_time<Span> from_sys(const std::chrono::sys_time<Span>& t) {
    return t;
  }
};

struct real {};
using kind = real;

/// Wall-clock time since the first call in the process.
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
struct recursive_mutex : std::recursive_mutex {
  recursive_mutex() = default;
  explicit recursive_mutex(const char*) {}
};
struct recursive_timed_mutex : std::recursive_timed_mutex {
  recursive_timed_mutex() = default;
  explicit recursive_timed_mutex(const char*) {}
};
struct shared_mutex : std::shared_mutex {
  shared_mutex() = default;
  explicit shared_mutex(const char*) {}
};
struct shared_timed_mutex : std::shared_timed_mutex {
  shared_timed_mutex() = default;
  explicit shared_timed_mutex(const char*) {}
};
struct condition_variable_any : std::condition_variable_any {
  condition_variable_any() = default;
  explicit condition_variable_any(const char*) {}
};
struct condition_variable : std::condition_variable_any {
  condition_variable() = default;
  explicit condition_variable(const char*) {}
};
/// Not the standard library's: libstdc++ 12's loses wake-ups with several acquiring threads.
template <std::ptrdiff_t LeastMax = PTRDIFF_MAX>
class counting_semaphore {
 public:
  explicit counting_semaphore(std::ptrdiff_t initial, const char* = "") : count_(initial) {}
  static constexpr std::ptrdiff_t max() noexcept { return LeastMax; }

  // Notifies under the lock: the acquiring thread may destroy the semaphore afterwards.
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

struct latch : std::latch {
  explicit latch(std::ptrdiff_t expected, const char* = "") : std::latch(expected) {}
};
struct no_completion {
  void operator()() noexcept {}
};
template <class Completion = no_completion>
struct barrier : std::barrier<Completion> {
  explicit barrier(std::ptrdiff_t expected, Completion completion = Completion(), const char* = "")
      : std::barrier<Completion>(expected, std::move(completion)) {}
};

struct processor {
  explicit processor(const char* = "") {}
};

template <class T>
struct atomic : std::atomic<T> {
  atomic() = default;
  constexpr atomic(T value, const char* = "") noexcept : std::atomic<T>(value) {}
  using std::atomic<T>::operator=;
};
struct atomic_flag : std::atomic_flag {
  constexpr atomic_flag() = default;
  explicit constexpr atomic_flag(const char*) {}
};
struct once_flag : std::once_flag {
  constexpr once_flag() = default;
  explicit constexpr once_flag(const char*) {}
};

inline sync::LocalValues& local_values() {
  static thread_local sync::LocalValues values;
  return values;
}

/// Unlike thread_local, this can be a member.
template <class T>
using fiber_local = sync::Local<T, local_values>;

struct thread_attributes {
  const char* name = "thread";
  kernel::StackSize stack = kernel::StackSize::medium;
  bool service = false;
  ClockOptions clock = {};  ///< ignored, like the rest: the system has its own
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

class jthread : public std::jthread {
 public:
  jthread() = default;
  template <class Function, class... Arguments>
  requires(!std::is_same_v<std::remove_cvref_t<Function>, jthread> &&
           !std::is_same_v<std::remove_cvref_t<Function>, thread_attributes>) explicit jthread(Function&& function,
                                                                                               Arguments&&... arguments)
      : std::jthread(std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
  template <class Function, class... Arguments>
  jthread(const thread_attributes&, Function&& function, Arguments&&... arguments)
      : std::jthread(std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
};

namespace this_thread {
using std::this_thread::get_id;
using std::this_thread::sleep_for;
using std::this_thread::sleep_until;
using std::this_thread::yield;
inline void sleep_for(Duration span) { std::this_thread::sleep_for(std::chrono::nanoseconds(span.ns())); }
inline void sleep_until(Time time) { sleep_for(time - now()); }
inline void set_working_set(const WorkingSet&) {}
inline void set_work(const char*, const char*) {}
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
