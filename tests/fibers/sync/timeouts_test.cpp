// SPDX-License-Identifier: BSD-3-Clause
// Every timed call takes any duration and a time point of any clock: the past has expired, out of range is without
// limit, and a fraction of a nanosecond is rounded up.
#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <vector>

#include "fibers/sync/barrier.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/latch.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {

// A user's own clock; its epoch is 40 years before the start of the run.
struct boot_clock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<boot_clock>;
  static constexpr bool is_steady = true;
  static constexpr duration before_start = std::chrono::years(40);
  static time_point now() { return time_point(steady_clock::now().time_since_epoch() + before_start); }
};
Time to_time(boot_clock::time_point t) {
  return Time::from_ns((t.time_since_epoch() - boot_clock::before_start).count());
}

namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// All objects that a task can wait for, held by another task until `until`.
struct Everything {
  timed_mutex plain;
  recursive_timed_mutex recursive;
  shared_timed_mutex shared;
  counting_semaphore<> empty{0};
  latch closed{1};
  barrier<> others{2};
  barrier<>::arrival_token arrival = others.arrive();
  mutex m;
  condition_variable silent;
  condition_variable_any silent_too;

  void hold_until(Time end) {
    plain.lock(), recursive.lock(), shared.lock();
    this_thread::sleep_until(end);
    plain.unlock(), recursive.unlock(), shared.unlock();
    empty.release();
    closed.count_down();
    (void)others.arrive();
    const std::lock_guard guard(m);
    silent.notify_one(), silent_too.notify_one();
  }
};

// Each timed wait with a duration, and with the time point at its end; true if in time.
template <class Span>
std::vector<std::function<bool(Everything&)>> waits(Span span) {
  const auto end = [span] { return steady_clock::now() + span; };
  using Lock = std::unique_lock<mutex>;
  const auto taken = [](auto& lockable, bool has) {
    if (has) lockable.unlock();
    return has;
  };
  const auto shared = [](shared_timed_mutex& lockable, bool has) {
    if (has) lockable.unlock_shared();
    return has;
  };
  return {
      [=](Everything& e) { return taken(e.plain, e.plain.try_lock_for(span)); },
      [=](Everything& e) { return taken(e.plain, e.plain.try_lock_until(end())); },
      [=](Everything& e) { return taken(e.recursive, e.recursive.try_lock_for(span)); },
      [=](Everything& e) { return taken(e.recursive, e.recursive.try_lock_until(end())); },
      [=](Everything& e) { return taken(e.shared, e.shared.try_lock_for(span)); },
      [=](Everything& e) { return taken(e.shared, e.shared.try_lock_until(end())); },
      [=](Everything& e) { return shared(e.shared, e.shared.try_lock_shared_for(span)); },
      [=](Everything& e) { return shared(e.shared, e.shared.try_lock_shared_until(end())); },
      [=](Everything& e) { return e.empty.try_acquire_for(span); },
      [=](Everything& e) { return e.empty.try_acquire_until(end()); },
      [=](Everything& e) { return e.closed.try_wait_for(span); },
      [=](Everything& e) { return e.closed.try_wait_until(end()); },
      [=](Everything& e) { return e.others.try_wait_for(e.arrival, span); },
      [=](Everything& e) { return e.others.try_wait_until(e.arrival, end()); },
      [=](Everything& e) {
        Lock lock(e.m);
        return e.silent.wait_for(lock, span) == cv_status::no_timeout;
      },
      [=](Everything& e) {
        Lock lock(e.m);
        return e.silent.wait_until(lock, end()) == cv_status::no_timeout;
      },
      [=](Everything& e) {
        Lock lock(e.m);
        return e.silent_too.wait_for(lock, span) == cv_status::no_timeout;
      },
      [=](Everything& e) {
        Lock lock(e.m);
        return e.silent_too.wait_until(lock, end()) == cv_status::no_timeout;
      },
  };
}

// Every wait in every order, for an object that becomes available after `held`: its result and its duration.
template <class Span>
void expect_each(Span span, Duration held, bool in_time, Duration takes) {
  for (std::size_t i = 0; i < waits(span).size(); ++i) {
    SCOPED_TRACE("wait " + std::to_string(i));
    in_every_order([&] {
      sleep_for(1s);  // so that negative durations are after the start of the run
      const Time begin = now();
      Everything e;
      thread holder([&] { e.hold_until(begin + held); });
      sleep_for(1ns);
      EXPECT_EQ(waits(span)[i](e), in_time);
      EXPECT_EQ(now() - begin, takes + Duration(1ns));
      holder.join();
    });
  }
}

TEST(Timeouts, PastDeadlinesDoNotWait) {
  expect_each(0s, 1h, false, Duration());
  expect_each(-1ms, 1h, false, Duration());
  expect_each(-1000h, 1h, false, Duration());
  expect_each(std::chrono::duration<double>(-1e-12), 1h, false, Duration());
}

TEST(Timeouts, AreKeptToTheNanosecondAndRoundedUp) {
  expect_each(3ms, 1h, false, 3ms);
  expect_each(std::chrono::duration<std::int8_t, std::ratio<60>>(2), 1h, false, 2min);
  expect_each(std::chrono::duration<std::int64_t, std::pico>(1001), 1h, false, 2ns);
  expect_each(3ms, 2ms, true, 2ms - 1ns);
}

TEST(Timeouts, OutOfRangeIsForEver) {
  in_every_order([] {
    timed_mutex m;
    m.lock();
    std::vector<thread> threads;
    for (int i = 0; i < 6; ++i)
      threads.emplace_back([&, i] {
        using std::chrono::time_point;
        const bool got = i == 0   ? m.try_lock_for(std::chrono::hours::max())
                         : i == 1 ? m.try_lock_for(std::chrono::nanoseconds::max())
                         : i == 2 ? m.try_lock_for(std::chrono::duration<double>(1e300))
                         : i == 3 ? m.try_lock_until(steady_clock::time_point::max())
                         : i == 4 ? m.try_lock_until(time_point<steady_clock, std::chrono::hours>::max())
                                  : m.try_lock_until(boot_clock::time_point::max());
        EXPECT_TRUE(got);
        EXPECT_EQ(now(), Time() + Duration(1h));
        m.unlock();
      });
    sleep_for(1h);
    m.unlock();
    for (thread& t : threads) t.join();
  });
  in_order([] {
    binary_semaphore s(0);
    using std::chrono::time_point;
    EXPECT_FALSE(s.try_acquire_until(steady_clock::time_point::min()));
    EXPECT_FALSE(s.try_acquire_until(time_point<steady_clock, std::chrono::hours>::min()));
    EXPECT_FALSE(s.try_acquire_for(std::chrono::hours::min()));
    EXPECT_EQ(now(), Time());
  });
}

TEST(Timeouts, AreOnAnyClockThatHasAToTime) {
  in_order([] {
    binary_semaphore s(0);
    EXPECT_FALSE(s.try_acquire_until(boot_clock::now() + 3ms));
    EXPECT_EQ(now(), Time() + Duration(3ms));
    EXPECT_FALSE(s.try_acquire_until(boot_clock::now() - 1ms));
    EXPECT_EQ(now(), Time() + Duration(3ms));
  });
}

}  // namespace
}  // namespace waitpoint
