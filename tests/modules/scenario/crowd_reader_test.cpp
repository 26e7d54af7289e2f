// SPDX-License-Identifier: BSD-3-Clause
// Scenarios of as many robots as a simulation can have.
#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

TEST(CrowdReader, ReadsAHundredThousandRobots) {
  constexpr int robots = 100'000;
  std::string text = "format: 1\nrobot_types: {kind: &kind {shape: {radius_m: 0.2, height_m: 1}}}\nrobots:\n";
  for (int i = 0; i < robots; ++i) {
    text +=
        i % 2 == 0
            ? "  - {<<: *kind, name: r" + std::to_string(i) + ", start: [" + std::to_string(i) + ".5, 2.5, 90]}\n"
            : "  - name: r" + std::to_string(i) + "\n    type: kind\n    start: [" + std::to_string(i) + ".5, 2.5]\n";
  }
  const TemporaryFolder folder;
  const Scenario scenario = read_scenario(folder.write("crowd.yaml", text));
  ASSERT_EQ(scenario.robots.size(), std::size_t{robots});
  EXPECT_EQ(scenario.robots[99'998].name, "r99998");
  EXPECT_EQ(scenario.robots[99'998].body.shape.radius_m, 0.2);
  EXPECT_EQ(scenario.robots[99'999].body.start, (Pose{99'999.5, 2.5, 0}));
}

TEST(CrowdReader, AppliesManyChangesToAFloorOfManyShapes) {
  constexpr int shapes = 20'000;
  std::string floor = "format: 1\nshape_height_m: 2\nshapes:\n",
              own = "format: 1\nworld:\n  include: floor.yaml\n  shapes:\n";
  for (int i = 0; i < shapes; ++i) {
    const std::string name = "  - {name: s" + std::to_string(i) + ", ";
    floor += name + "centre_m: [" + std::to_string(i) + ", 5], radius_m: 0.2}\n";
    own += "  " + name + "known: false}\n";
  }
  const TemporaryFolder folder;
  folder.write("floor.yaml", floor);
  const Scenario scenario = read_scenario(
      folder.write("s.yaml", own + "robots: [{name: a, shape: {radius_m: 0.1, height_m: 1}, start: [0, 0]}]\n"));
  ASSERT_EQ(scenario.shapes.size(), std::size_t{shapes});
  EXPECT_FALSE(scenario.shapes.back().known);
}

}  // namespace
}  // namespace waitpoint::scenario
