// SPDX-License-Identifier: BSD-3-Clause
// Routes on the maps of the data folder; skipped, with a message, if it is missing.
#include <gtest/gtest.h>

#include "modules/executive/route_planner.hpp"
#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

struct RealMap {
  const char* name;
  double resolution_m, free_below;
};

class RealMaps : public testing::TestWithParam<RealMap> {};

// The cells whose centres have the full radius and clearance, flooded from one of them: each must have a route.
TEST_P(RealMaps, EveryGoalThatIsConnectedWithTheClearanceHasARoute) {
  const auto map = test::real_map(GetParam().name, GetParam().resolution_m, GetParam().free_below);
  if (!map) GTEST_SKIP() << "no data folder (WAITPOINT_DATA or ../shared/data)";
  const PlanningParameters parameters;
  RoutePlanner planner(*map, parameters);
  const FreeSpace& space = planner.space();
  const std::uint16_t full = space.square_of(parameters.robot_radius_m + parameters.clearance_m);
  const auto index = [&](CellIndex c) { return static_cast<std::size_t>(c.y * map->width() + c.x); };
  std::vector<CellIndex> largest;
  std::vector<bool> seen(static_cast<std::size_t>(map->width() * map->height()), false);
  for (std::int32_t i = 0; i < map->width() * map->height(); ++i) {
    std::vector<CellIndex> flood;
    const auto enter = [&](CellIndex c) {
      if (space.clearance_square(c) < full || seen[index(c)]) return;
      seen[index(c)] = true;
      flood.push_back(c);
    };
    enter({i % map->width(), i / map->width()});
    for (std::size_t k = 0; k < flood.size(); ++k) {
      const CellIndex c = flood[k];
      for (const CellIndex next :
           {CellIndex{c.x + 1, c.y}, CellIndex{c.x - 1, c.y}, CellIndex{c.x, c.y + 1}, CellIndex{c.x, c.y - 1}})
        enter(next);
    }
    if (flood.size() > largest.size()) largest = flood;
  }
  ASSERT_GT(largest.size(), 1000u);
  const RandomStream random(1, GetParam().name, "goals");
  RoutePlan plan;
  for (std::uint64_t k = 0; k < 25; ++k) {
    const CellIndex start = largest[random.below(largest.size(), k, 0)],
                    goal = largest[random.below(largest.size(), k, 1)];
    planner.plan(map->centre(start), map->centre(goal), plan);
    ASSERT_EQ(plan.outcome, PlanOutcome::found)
        << "from " << start.x << ", " << start.y << " to " << goal.x << ", " << goal.y;
    EXPECT_LE(plan.via_points.size(), 48u);
    EXPECT_GE(plan.length_m + 1e-9, length(map->centre(goal) - map->centre(start)));
  }
}

INSTANTIATE_TEST_SUITE_P(, RealMaps,
                         testing::Values(RealMap{"depot", 0.05, 0.25}, RealMap{"tb3_sandbox", 0.05, 0.196},
                                         RealMap{"warehouse", 0.03, 0.1}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace waitpoint::executive
