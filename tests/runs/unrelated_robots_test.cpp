// SPDX-License-Identifier: BSD-3-Clause
// Robots affect only those that see or touch them: in the office of ten, adding, removing, renaming or reordering a
// robot leaves the digest of every unrelated robot unchanged.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/runs/interactions.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

// Shorter for the seeded order: it is the same world.
constexpr Duration watched(kernel::Order order) { return std::chrono::seconds(order == kernel::Order::fifo ? 20 : 8); }

struct Watched {
  std::map<std::string, std::string> digests;  // by robot
  Pairs pairs;
};

Watched watch(const scenario::Scenario& scenario, kernel::Order order) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {usual_seed, order, ""});
  Interactions interactions(experiment);
  for (Time now; now <= Time() + watched(order); now += scenario.step) {
    experiment.run_before(now + std::chrono::nanoseconds(1));  // all events at `now`
    interactions.observe();
  }
  Watched result;
  result.pairs = interactions.pairs();
  for (const bridge::RobotResult& robot : experiment.result().robots)
    result.digests[robot.name] = to_string(robot.digest);
  return result;
}

scenario::Scenario ten() { return shipped("office-10.yaml"); }

scenario::RobotScenario& robot_of(scenario::Scenario& scenario, const std::string& name) {
  return *std::find_if(scenario.robots.begin(), scenario.robots.end(), [&](const auto& r) { return r.name == name; });
}

scenario::Scenario without(const std::string& name) {
  scenario::Scenario scenario = ten();
  std::erase_if(scenario.robots, [&](const scenario::RobotScenario& robot) { return robot.name == name; });
  return scenario;
}

void rename(scenario::RobotScenario& robot, const std::string& name) { robot.name = robot.body.name = name; }

/// A robot like ada, with goals of its own.
scenario::RobotScenario newcomer(const std::string& name, Pose start, std::vector<Point> goals) {
  scenario::Scenario scenario = ten();
  scenario::RobotScenario robot = robot_of(scenario, "ada");
  rename(robot, name);
  robot.body.start = start;
  robot.goals.resize(goals.size());
  for (std::size_t i = 0; i < goals.size(); ++i) robot.goals[i].position = goals[i];
  return robot;
}

class UnrelatedRobots : public ::testing::TestWithParam<kernel::Order> {
 protected:
  /// Compares the digests of all robots that are unrelated to `changed` in both runs; returns their number.
  static std::size_t expect_unrelated_unchanged(const Watched& a, const Watched& b, const std::string& changed) {
    Pairs pairs = a.pairs;
    pairs.insert(b.pairs.begin(), b.pairs.end());
    const std::set<std::string> touched = related(changed, pairs);
    std::size_t compared = 0;
    for (const auto& [name, digest] : a.digests) {
      if (touched.contains(name) || !b.digests.contains(name)) continue;
      EXPECT_EQ(b.digests.at(name), digest) << name << " when " << changed << " changes";
      ++compared;
    }
    return compared;
  }
};

TEST_P(UnrelatedRobots, KeepTheirDigestsWhenOneIsRemoved) {
  const Watched all = watch(ten(), GetParam());
  ASSERT_EQ(all.digests.size(), 10u);
  EXPECT_GE(all.pairs.size(), 3u) << "nobody meets: nothing is shown";
  std::size_t moved = 0;
  for (const auto& [name, digest] : all.digests) {
    const Watched rest = watch(without(name), GetParam());
    ASSERT_EQ(rest.digests.size(), 9u);
    // The closed rooms guarantee robots that are unrelated to all others.
    const bool closed_in = name == "hugo" || name == "ines" || name == "jan";
    EXPECT_GE(expect_unrelated_unchanged(all, rest, name), closed_in ? 9u : 3u) << name;
    for (const auto& [other, was] : rest.digests) moved += was != all.digests.at(other) ? 1 : 0;
  }
  EXPECT_GT(moved, 0u) << "not even related robots notice each other: nothing is shown";
}

TEST_P(UnrelatedRobots, KeepTheirDigestsWhenAnEleventhComes) {
  const Watched all = watch(ten(), GetParam());
  const std::vector<scenario::RobotScenario> newcomers = {
      newcomer("aaron", {20, 9.4, 0}, {{30, 9.5}, {20, 9.4}}),        // in the south corridor
      newcomer("ilse", {36.5, 24.6, 180}, {{33, 23.2}, {36, 28.4}}),  // with ines
      newcomer("zoe", {12.9, 12.4, 0}, {{13.2, 18}, {17, 17.6}}),     // with hugo
  };
  for (std::size_t i = 0; i < newcomers.size(); ++i) {
    scenario::Scenario scenario = ten();
    scenario.robots.insert(scenario.robots.begin() + static_cast<std::ptrdiff_t>(5 * i), newcomers[i]);
    const Watched eleven = watch(scenario, GetParam());
    ASSERT_EQ(eleven.digests.size(), 11u);
    EXPECT_GE(expect_unrelated_unchanged(all, eleven, newcomers[i].name), i == 0 ? 3u : 9u) << newcomers[i].name;
  }
}

TEST_P(UnrelatedRobots, KeepTheirDigestsInAnotherOrderOfTheFile) {
  const Watched all = watch(ten(), GetParam());
  scenario::Scenario reversed = ten();
  std::reverse(reversed.robots.begin(), reversed.robots.end());
  // Related robots do not notice either.
  EXPECT_EQ(watch(reversed, GetParam()).digests, all.digests);
}

TEST_P(UnrelatedRobots, KeepTheirDigestsWhenOneIsRenamed) {
  const Watched all = watch(ten(), GetParam());
  scenario::Scenario scenario = ten();
  rename(robot_of(scenario, "emil"), "zacharias");
  Watched renamed = watch(scenario, GetParam());
  ASSERT_TRUE(renamed.digests.contains("zacharias"));
  // A robot's name selects its noise: for the others, emil left and another robot came.
  Pairs joined = renamed.pairs;
  joined.insert({"emil", "zacharias"});
  renamed.pairs = joined;
  EXPECT_GE(expect_unrelated_unchanged(all, renamed, "emil"), 3u);
}

INSTANTIATE_TEST_SUITE_P(Order, UnrelatedRobots, ::testing::Values(kernel::Order::fifo, kernel::Order::seeded),
                         [](const auto& info) { return info.param == kernel::Order::fifo ? "fifo" : "seeded"; });

}  // namespace
}  // namespace waitpoint::runs
