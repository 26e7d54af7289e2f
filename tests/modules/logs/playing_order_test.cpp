// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "modules/logs/playing_order.hpp"

namespace waitpoint::logs {
namespace {

using namespace std::chrono_literals;

Time at(double seconds) { return Time() + Duration::from_seconds(seconds); }

// A log of scans and reports in the order of the calls.
class Log {
 public:
  Log& scan(double stamp_s, std::optional<Pose> odometry = std::nullopt) {
    log_.scans.push_back({.stamp = at(stamp_s), .place = places_++, .range_m = {1}, .odometry = odometry});
    return *this;
  }
  Log& report(double stamp_s, double x) {
    log_.odometry.push_back({at(stamp_s), places_++, {x, 0, 0}});
    return *this;
  }
  PlayingOrder order() const { return playing_order(log_); }

 private:
  SensorLog log_;
  std::uint64_t places_ = 0;
};

TEST(PlayingOrder, DatesCountFromTheFirstStamp) {
  const PlayingOrder order = Log().scan(976052857.5, Pose()).scan(976052858, Pose()).order();
  EXPECT_EQ(order.records[0].date, Time());
  EXPECT_EQ(order.records[1].date, at(0.5));
  EXPECT_EQ(order.late + order.equal + order.clock_set, 0u);
}

TEST(PlayingOrder, AScanWithoutOdometryHasThatBetweenTheReportsAroundIt) {
  const PlayingOrder order = Log().report(1, 0).report(2, 4).scan(1.25).order();
  ASSERT_EQ(order.records.size(), 3u);
  EXPECT_EQ(order.records[1].scan, 0u);
  EXPECT_EQ(order.records[1].odometry.x, 1);
  EXPECT_EQ(order.late, 1u);
}

TEST(PlayingOrder, AReportOfTheSameDateAsAScanIsLeftOut) {
  const PlayingOrder order = Log().report(1, 7).scan(1, Pose{5, 0, 0}).order();
  ASSERT_EQ(order.records.size(), 1u);
  EXPECT_EQ(order.records[0].odometry.x, 5);
}

TEST(PlayingOrder, ScansOfOneStampKeepTheirOrderAMicrosecondApart) {
  const PlayingOrder order = Log().scan(1, Pose{1, 0, 0}).scan(1, Pose{2, 0, 0}).scan(1, Pose{3, 0, 0}).order();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(order.records[i].scan, i);
    EXPECT_EQ(order.records[i].date, Time::from_ns(static_cast<std::int64_t>(i) * 1000));
  }
  EXPECT_EQ(order.equal, 2u);
}

TEST(PlayingOrder, AfterTheClockWasSetTheNextRecordFollowsAtOnce) {
  const PlayingOrder order = Log().scan(100, Pose()).scan(101, Pose()).scan(3, Pose()).scan(4, Pose()).order();
  EXPECT_EQ(order.clock_set, 1u);
  EXPECT_EQ(order.records[2].scan, 2u);
  EXPECT_LT(order.records[2].date, at(1.001));
  EXPECT_EQ(order.records[3].date, at(2));
  const PlayingOrder on = Log().scan(0, Pose()).scan(1e9, Pose()).scan(1e9 + 1, Pose()).order();
  EXPECT_EQ(on.clock_set, 1u);
  EXPECT_EQ(on.records[2].date, at(1));
}

TEST(PlayingOrder, ALogOfMoreThanADayIsRefused) {
  EXPECT_THROW(Log().scan(0, Pose()).scan(5e4, Pose()).scan(1e5, Pose()).order(), BadInput);
}

TEST(PlayingOrder, ALogOfMoreThanTenThousandKilometresIsRefused) {
  Log log;
  for (int i = 0; i < 12; ++i) log.scan(i, Pose{i % 2 == 0 ? 0.0 : 1e6, 0, 0});
  EXPECT_THROW(log.order(), BadInput);
}

}  // namespace
}  // namespace waitpoint::logs
