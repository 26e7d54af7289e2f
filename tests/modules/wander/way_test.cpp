// SPDX-License-Identifier: BSD-3-Clause
#include "modules/wander/way.hpp"

#include <gtest/gtest.h>

#include "core/exact_math.hpp"

namespace waitpoint::wander {
namespace {

using posters::BaseCommand;
using posters::LaserReading;

// Half a turn in steps of a degree, with range 8 m and an echo at `range_m` from `from_deg` to `to_deg`.
LaserReading scan_with(double from_deg, double to_deg, double range_m) {
  LaserReading scan;
  scan.first_angle_rad = -0.5 * exact::pi;
  scan.angle_step_rad = exact::pi / 180;
  scan.range_max_m = 8;
  for (int i = 0; i <= 180; ++i) {
    const double at_deg = i - 90;
    scan.range_m.push_back(static_cast<float>(from_deg <= at_deg && at_deg <= to_deg ? range_m : 8));
  }
  return scan;
}
const LaserReading nothing = scan_with(1000, 1000, 0);

Time seconds(double s) { return Time::from_ns(static_cast<std::int64_t>(s * 1e9)); }

BaseCommand decide(Way& way, const LaserReading& scan, bool stalled = false, double at_s = 0) {
  BaseCommand command;
  way.decide(scan, stalled, seconds(at_s), command);
  return command;
}

TEST(Way, LeadsAheadWhereThereIsRoomAndSlowerTheLessThereIs) {
  const Parameters usual;
  Way way(usual);
  EXPECT_EQ(decide(way, nothing).v_m_s, usual.v_m_s);
  EXPECT_EQ(decide(way, nothing).w_rad_s, 0);
  const BaseCommand near = decide(way, scan_with(-10, 10, 0.9)), nearer = decide(way, scan_with(-10, 10, 0.7));
  EXPECT_LT(near.v_m_s, usual.v_m_s);
  EXPECT_LT(nearer.v_m_s, near.v_m_s);
  EXPECT_GT(nearer.v_m_s, 0);
}

TEST(Way, LeadsPastWhatIsBesideTheLane) {
  Way way({});
  EXPECT_EQ(decide(way, scan_with(60, 90, 0.5)).v_m_s, Parameters().v_m_s);
  EXPECT_EQ(decide(way, scan_with(-90, -60, 0.5)).v_m_s, Parameters().v_m_s);
}

TEST(Way, TurnsOnTheSpotToTheSideWithMoreRoomUntilItIsClear) {
  Way way({});
  const BaseCommand away = decide(way, scan_with(-90, 5, 0.5));
  EXPECT_EQ(away.v_m_s, 0);
  EXPECT_GT(away.w_rad_s, 0);
  // The other side now has more room, but the turn continues: turning back and forth would not leave a corner.
  EXPECT_GT(decide(way, scan_with(-5, 90, 0.5)).w_rad_s, 0);
  EXPECT_EQ(decide(way, nothing).w_rad_s, 0);
  EXPECT_LT(decide(way, scan_with(-5, 90, 0.5)).w_rad_s, 0);
}

TEST(Way, BacksOffFromWhatItStallsAtForAWhileAndTurns) {
  Way way({});
  EXPECT_LT(decide(way, scan_with(-90, 5, 0.5), true, 1).v_m_s, 0);
  EXPECT_LT(decide(way, nothing, false, 1.9).v_m_s, 0);
  EXPECT_GT(decide(way, scan_with(-10, 10, 0.3), false, 2.1).w_rad_s, 0);
  EXPECT_GT(decide(way, nothing, false, 2.2).v_m_s, 0);
}

TEST(Way, SeesByAFewRaysAllAround) {
  LaserReading ring;
  ring.first_angle_rad = -exact::pi + exact::pi / 12;
  ring.angle_step_rad = exact::pi / 6;
  ring.range_max_m = 2;
  for (int i = 0; i < 12; ++i) ring.range_m.push_back(i == 0 || i == 11 ? 0.1f : 2.0f);
  Way way({});
  EXPECT_GT(decide(way, ring).v_m_s, 0) << "what is behind does not matter";
  ring.range_m[6] = 0.3f;
  EXPECT_EQ(decide(way, ring).v_m_s, 0);
  EXPECT_LT(decide(way, ring).w_rad_s, 0) << "ahead to the left";
}

}  // namespace
}  // namespace waitpoint::wander
