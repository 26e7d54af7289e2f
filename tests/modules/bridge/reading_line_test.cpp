// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/reading_line.hpp"

#include <gtest/gtest.h>

#include "modules/posters/laser.hpp"

namespace waitpoint::bridge {
namespace {

using namespace std::chrono_literals;

using Line = ReadingLine<posters::LaserReading>;

posters::LaserReading numbered_scan(std::uint32_t number) {
  posters::LaserReading scan;
  scan.number = number;
  return scan;
}

TEST(ReadingLine, GivesScansInOrderEachOnceAllItsBytesHaveCome) {
  Line line(Duration(190ms));
  EXPECT_TRUE(line.takes_time());
  EXPECT_EQ(line.next_arrival(), std::nullopt);
  line.send(Time() + Duration(200ms), numbered_scan(1));
  line.send(Time() + Duration(380ms), numbered_scan(2));  // queued: the first scan is still being transmitted
  EXPECT_EQ(line.next_arrival(), Time() + Duration(390ms));
  posters::LaserReading scan;
  EXPECT_FALSE(line.take(Time() + Duration(389ms), scan));
  EXPECT_TRUE(line.take(Time() + Duration(390ms), scan));
  EXPECT_EQ(scan.number, 1u);
  EXPECT_EQ(line.next_arrival(), Time() + Duration(580ms));
  EXPECT_FALSE(line.take(Time() + Duration(579ms), scan));
  EXPECT_TRUE(line.take(Time() + Duration(700ms), scan));
  EXPECT_EQ(scan.number, 2u);
  EXPECT_FALSE(line.take(Time() + Duration(900ms), scan));
}

TEST(ReadingLine, WithoutTransmissionTakesNoTime) { EXPECT_FALSE(Line(Duration()).takes_time()); }

}  // namespace
}  // namespace waitpoint::bridge
