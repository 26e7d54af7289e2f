// SPDX-License-Identifier: BSD-3-Clause
#include "core/time.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();

TEST(Duration, TakesAnyUnitThatNanosecondsHoldExactly) {
  EXPECT_EQ(Duration(20ms).ns(), 20'000'000);
  EXPECT_EQ(Duration(3h).ns(), 10'800'000'000'000);
  EXPECT_EQ(Duration(-7us).ns(), -7000);
  EXPECT_EQ(Duration(std::chrono::duration<std::uint8_t>(200)).ns(), 200'000'000'000);
}

TEST(Duration, CalculatesInIntegers) {
  EXPECT_EQ(Duration(1s) + Duration(1ns), Duration::from_ns(1'000'000'001));
  EXPECT_EQ(Duration(1s) - Duration(2s), Duration(-1s));
  EXPECT_EQ(-Duration(5ms), Duration(-5ms));
  EXPECT_EQ(3 * Duration(5ms), Duration(15ms));
  EXPECT_EQ(Duration(10ms) / 4, Duration(2500us));
  EXPECT_EQ(Duration(10ms) / Duration(3ms), 3);
  EXPECT_EQ(Duration(-10ms) / Duration(3ms), -3);
  EXPECT_LT(Duration(-1ns), Duration());
  EXPECT_LT(Duration(most / 1'000'000'000 * 1s), Duration::max());
}

TEST(Duration, RoundsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(Duration::from_seconds(0.1).ns(), 100'000'000);
  EXPECT_EQ(Duration::from_seconds(-0.1).ns(), -100'000'000);
  EXPECT_EQ(Duration::from_seconds(1.4e-9).ns(), 1);
  EXPECT_EQ(Duration::from_seconds(1.6e-9).ns(), 2);
  EXPECT_DOUBLE_EQ(Duration(1500ms).seconds(), 1.5);
}

TEST(Time, IsAPointAndDurationADistance) {
  const Time t = Time::from_ns(100);
  EXPECT_EQ(t + Duration(20ns), Time::from_ns(120));
  EXPECT_EQ(t - Duration(20ns), Time::from_ns(80));
  EXPECT_EQ(Time::from_ns(120) - t, Duration(20ns));
  EXPECT_EQ(t.since_start(), Duration(100ns));
  static_assert(!std::is_convertible_v<Duration, Time> && !std::is_convertible_v<Time, Duration>);
  static_assert(!std::is_constructible_v<Duration, double> && !std::is_constructible_v<Duration, int>);
}

TEST(TimeDeathTest, AnOverflowIsABug) {
  EXPECT_DEATH(Time::max() + Duration(1ns), "virtual time overflows");
  EXPECT_DEATH(Time::from_ns(least) - Duration(1ns), "virtual time overflows");
  EXPECT_DEATH(Time::from_ns(most) - Time::from_ns(-1), "virtual time overflows");
  EXPECT_DEATH(Duration::max() + Duration(1ns), "virtual time overflows");
  EXPECT_DEATH(Duration::from_ns(least) - Duration(1ns), "virtual time overflows");
  EXPECT_DEATH(-Duration::from_ns(least), "virtual time overflows");
  EXPECT_DEATH(Duration(1h) * (most / 1000), "virtual time overflows");
  EXPECT_DEATH(Duration(most * 1s), "virtual time overflows");
  EXPECT_DEATH(Duration(std::chrono::duration<std::uint64_t, std::nano>(1ull << 63)), "virtual time overflows");
  EXPECT_DEATH(Duration::from_ns(least) / -1, "virtual time overflows");
  EXPECT_DEATH(Duration::from_ns(least) / Duration(-1ns), "virtual time overflows");
}

TEST(TimeDeathTest, MeaninglessSpansAreBugs) {
  EXPECT_DEATH(Duration(1s) / 0, "divided by zero");
  EXPECT_DEATH(Duration(1s) / Duration(), "divided by zero");
  EXPECT_DEATH(Duration::from_seconds(1e10), "out of range");
  EXPECT_DEATH(Duration::from_seconds(std::numeric_limits<double>::quiet_NaN()), "out of range");
  EXPECT_DEATH(Period::every(Duration()), "must be positive");
  EXPECT_DEATH(Period::every(Duration(-1ms)), "must be positive");
  EXPECT_DEATH(Period::hertz(0), "must be positive");
  EXPECT_DEATH(Period::every(1s).first_tick_at_or_after(Duration(-1ns)), "start of the run");
  EXPECT_DEATH(Period::every(1h).tick(most), "virtual time overflows");
  EXPECT_DEATH(Period::every(1h).tick(least), "virtual time overflows");
}

TEST(Period, TicksAt75HertzAreMultiplesRoundedOnce) {
  const Period period = Period::hertz(75);
  EXPECT_EQ(period.tick(0), Duration());
  EXPECT_EQ(period.tick(1).ns(), 13'333'333);
  EXPECT_EQ(period.tick(2).ns(), 26'666'667);
  EXPECT_EQ(period.tick(3).ns(), 40'000'000);
  // No drift after a day: a sum of rounded periods would be 2.16 ms off.
  for (std::int64_t s : {1, 60, 86400}) EXPECT_EQ(period.tick(75 * s), Duration(std::chrono::seconds(s)));
  for (std::int64_t k = 1; k < 10000; ++k) {
    const long double exact = static_cast<long double>(k) * 1e9L / 75;
    EXPECT_LE(std::abs(static_cast<long double>(period.tick(k).ns()) - exact), 0.5L);
  }
}

TEST(Period, FindsTheFirstTickAtOrAfterAnyTime) {
  const RandomStream random(1, "", "ticks");
  for (const Period period : {Period::hertz(75), Period::hertz(1), Period::hertz(999'999'937), Period::every(7ns),
                              Period::every(20ms), Period::every(1h)}) {
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Duration at = Duration::from_ns(static_cast<std::int64_t>(random.below(1ull << (1 + i % 55), i)));
      const std::int64_t k = period.first_tick_at_or_after(at);
      EXPECT_GE(period.tick(k), at);
      EXPECT_TRUE(k == 0 || period.tick(k - 1) < at);
    }
    for (std::int64_t k = 0; k < 300; ++k) EXPECT_EQ(period.first_tick_at_or_after(period.tick(k)), k);
  }
}

TEST(Time, IsWrittenInSecondsWithNineDecimals) {
  EXPECT_EQ(to_string(Time::from_ns(12'345'000'000)), "12.345000000");
  EXPECT_EQ(to_string(Time()), "0.000000000");
  EXPECT_EQ(to_string(Duration(-1ns)), "-0.000000001");
  EXPECT_EQ(to_string(Duration::from_ns(least)), "-9223372036.854775808");
  EXPECT_EQ(to_string(Time::max()), "9223372036.854775807");
}

}  // namespace
}  // namespace waitpoint
