// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/tracker.hpp"

#include <gtest/gtest.h>

#include "modules/locate/finder.hpp"
#include "modules/locate/map_surface.hpp"
#include "tests/modules/locate/floor.hpp"

namespace waitpoint::locate {
namespace {

const std::vector<std::string> hall = {
    "################",  //
    "#..............#",  //
    "#......##......#",  //
    "#......##......#",  //
    "#..............#",  //
    "#....#.........#",  //
    "#..............#",  //
    "################",
};

TEST(Tracker, CorrectsAnOdometryThatDrifts) {
  const OccupancyGrid map = floor_of(hall);
  const MapSurfaces surfaces(map);
  Pose truth = {1, 0.8, 0};
  Tracker tracker(surfaces.fine, {}, {truth, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}});
  for (int i = 0; i < 100; ++i) {
    const Pose motion = {0.05, 0, i > 70 ? 0.03 : 0};
    truth = compose(truth, motion);
    tracker.predict({1.05 * motion.x, 0.002, motion.heading + 0.003});
    tracker.update(scan_at(map, truth));
    const Pose error = between(truth, tracker.estimate().pose);
    ASSERT_LT(length(error.position()), 0.04) << i;
    ASSERT_LT(std::fabs(error.heading), 0.02) << i;
  }
  EXPECT_GT(tracker.explained(), 0.9);
}

TEST(Tracker, IsLostWhenTheMapDoesNotExplainItsScans) {
  const OccupancyGrid map = floor_of(hall), elsewhere = floor_of({"####", "#..#", "#.##", "####"}, 13);
  const MapSurfaces surfaces(map);
  const TrackingParameters parameters;
  Tracker tracker(surfaces.fine, parameters, {{3, 2, 0}, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}});
  for (std::uint32_t i = 0; i < parameters.lost_scans; ++i) {
    EXPECT_FALSE(tracker.lost());
    tracker.predict({0.05, 0, 0});
    EXPECT_FALSE(tracker.update(scan_at(elsewhere, {2, 3, 0.4 * i})));
  }
  EXPECT_TRUE(tracker.lost());
}

TEST(MapSurface, FitsTheLineOfASlantingWall) {
  OccupancyGrid map(120, 120, 0.05, {1, 2, 0.3}, Cell::free);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x)
      if (x + 2 * y < 120) map[{x, y}] = Cell::occupied;
  std::size_t inner = 0;
  for (const matching::SurfacePoint& point : surface_of(map)) {
    const Point at = between(map.origin(), {point.position.x, point.position.y, 0}).position();
    if (at.x < 0.5 || at.x > 5.5 || at.y < 0.5) continue;
    ++inner;
    const Pose normal = between({0, 0, map.origin().heading}, {point.normal.x, point.normal.y, 0});
    EXPECT_NEAR(normal.x, 1 / std::sqrt(5.0), 0.08);
    EXPECT_NEAR(normal.y, 2 / std::sqrt(5.0), 0.04);
    EXPECT_NEAR((at.x + 2 * at.y - 6) / std::sqrt(5.0), 0, 0.03);
  }
  EXPECT_GT(inner, 100u);
}

}  // namespace
}  // namespace waitpoint::locate
