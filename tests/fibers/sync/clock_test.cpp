// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using this_thread::sleep_until;

TEST(Clock, BothShowTheLocalVirtualTime) {
  in_order([] {
    const steady_clock::time_point steady = steady_clock::now();
    const system_clock::time_point system = system_clock::now();
    EXPECT_EQ(steady.time_since_epoch(), 0ns);
    sleep_for(3s);
    compute(5ns);
    EXPECT_EQ(steady_clock::now() - steady, 3s + 5ns);
    EXPECT_EQ(system_clock::now() - system, 3s + 5ns);
  });
}

TEST(Clock, ARunStartsInTheYear2000UnlessToldOtherwise) {
  in_order([] {
    const auto begin = system_clock::to_sys(system_clock::now());
    EXPECT_EQ(begin, std::chrono::sys_days(std::chrono::year(2000) / 1 / 1));
    EXPECT_EQ(system_clock::to_time_t(system_clock::now()), 946'684'800);
    sleep_for(1500ms);
    EXPECT_EQ(system_clock::to_time_t(system_clock::now()), 946'684'801);
  });
  SimulationOptions options;
  options.start_date = std::chrono::sys_days(std::chrono::year(1969) / 12 / 31) + 23h;
  const Report report = simulate(
      [] {
        EXPECT_EQ(system_clock::to_time_t(system_clock::now()), -3600);
        sleep_until(system_clock::from_time_t(60));
        EXPECT_EQ(now(), at(1h + 1min));
      },
      options);
  EXPECT_TRUE(report.passed) << report;
}

TEST(Clock, SleepsUntilTimePointsOfEitherClockInAnyUnit) {
  in_every_order([] {
    sleep_until(steady_clock::time_point(2ms));
    EXPECT_EQ(now(), at(2ms));
    sleep_until(std::chrono::time_point_cast<std::chrono::seconds>(steady_clock::now()) + 1s);
    EXPECT_EQ(now(), at(1s));
    sleep_until(system_clock::now() + 5ms);
    EXPECT_EQ(now(), at(1005ms));
    const std::chrono::sys_days next_day(std::chrono::year(2000) / 1 / 2);
    sleep_until(system_clock::from_sys(next_day));
    EXPECT_EQ(now(), at(24h));
    sleep_until(std::chrono::time_point<steady_clock, std::chrono::duration<double>>(90'000.25s));
    EXPECT_EQ(now(), at(90'000'250ms));
  });
}

TEST(Clock, PastDeadlinesTakeNoTime) {
  in_every_order([] {
    sleep_for(1h);
    sleep_for(-1s);
    sleep_for(std::chrono::hours::min());
    sleep_for(std::chrono::duration<double>(-std::numeric_limits<double>::infinity()));
    sleep_until(steady_clock::time_point(1ms));
    sleep_until(steady_clock::time_point::min());
    sleep_until(system_clock::time_point());
    sleep_until(system_clock::time_point::min());
    sleep_until(std::chrono::time_point<system_clock, std::chrono::hours>::min());
    EXPECT_FALSE(binary_semaphore(0).try_acquire_for(-1ns));
    EXPECT_EQ(now(), at(1h));
  });
}

TEST(Clock, FractionsOfANanosecondAreRoundedUp) {
  in_order([] {
    sleep_for(std::chrono::duration<std::int64_t, std::pico>(1));
    EXPECT_EQ(now(), at(1ns));
    sleep_for(std::chrono::duration<double, std::nano>(1.25));
    EXPECT_EQ(now(), at(3ns));
    sleep_for(std::chrono::duration<int, std::ratio<1, 3>>(1));
    EXPECT_EQ(now(), at(333'333'337ns));
    sleep_for(std::chrono::duration<float>(0.5f));
    EXPECT_EQ(now(), at(833'333'337ns));
    sleep_for(
        std::chrono::duration<double>(1e-3));  // 1e-3 as a double exceeds a millisecond, but scales to exactly one
    EXPECT_EQ(now(), at(834'333'337ns));
  });
}

// The only remaining event is at the end of time, before which a run stops.
TEST(Clock, DurationsBeyondTheRangeAreEndless) {
  const auto waits_for_ever = [](const std::function<void()>& wait) {
    const Report report = simulate([&] {
      sleep_for(1s);
      wait();
    });
    EXPECT_EQ(report.end, RunEnd::time_reached) << report;
    EXPECT_EQ(report.end_time, at(1s));
  };
  waits_for_ever([] { sleep_for(std::chrono::hours::max()); });
  waits_for_ever([] { sleep_for(std::chrono::nanoseconds::max()); });
  waits_for_ever([] { sleep_for(std::chrono::duration<unsigned long long>::max()); });
  waits_for_ever([] { sleep_for(std::chrono::duration<std::int64_t, std::ratio<1, 3>>(20'000'000'000'000)); });
  waits_for_ever([] { sleep_for(std::chrono::duration<double>(1e30)); });
  waits_for_ever([] { sleep_for(std::chrono::duration<double>(std::numeric_limits<double>::infinity())); });
  waits_for_ever([] { sleep_until(steady_clock::time_point::max()); });
  waits_for_ever([] { sleep_until(system_clock::time_point::max()); });
  waits_for_ever([] { sleep_until(std::chrono::time_point<system_clock, std::chrono::years>::max()); });
}

TEST(Clock, ATimePointBeforeAnEarlyStartIsForEverOnlyWhereItCannotBeSaid) {
  SimulationOptions options;
  options.start_date = std::chrono::sys_days(std::chrono::year(1700) / 1 / 1);
  const Report report = simulate([] { sleep_until(system_clock::time_point(240 * std::chrono::years(1))); }, options);
  EXPECT_EQ(report.end, RunEnd::time_reached) << report;
}

TEST(ClockDeathTest, ADurationThatIsNotANumberIsABug) {
  const char* message = "a duration or a time is not a number";
  EXPECT_DEATH(simulate([] { sleep_for(std::chrono::duration<double>(std::nan(""))); }), message);
  EXPECT_DEATH(simulate([] { (void)binary_semaphore(0).try_acquire_for(std::chrono::duration<float>(std::nanf(""))); }),
               message);
  using Point = std::chrono::time_point<steady_clock, std::chrono::duration<double>>;
  EXPECT_DEATH(simulate([] { sleep_until(Point(std::chrono::duration<double>(std::nan("")))); }), message);
}

TEST(ClockDeathTest, UseOutsideAnyTask) {
  const char* message = "a simulated primitive is used outside a simulated task";
  EXPECT_DEATH(steady_clock::now(), message);
  EXPECT_DEATH(system_clock::now(), message);
  EXPECT_DEATH(to_time(system_clock::time_point()), message);
}

}  // namespace
}  // namespace waitpoint
