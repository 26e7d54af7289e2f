// SPDX-License-Identifier: BSD-3-Clause
// Another seed from an instant on: the run is the same up to there, and from there on draws as a run with that seed.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "modules/run/experiment.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/papers_modules.hpp"
#include "world/bullet/bullet_world.hpp"

namespace waitpoint::runs {
namespace {

constexpr Duration until = std::chrono::seconds(6);
const Time instant = Time::from_ns(2'000'000'000);

struct Digests {
  Digest run;
  std::vector<Digest> robots;
};

/// With another seed from `date` on, if given.
Digests digests(const scenario::Scenario& scenario, std::uint64_t seed, std::optional<std::uint64_t> other = {},
                Time date = instant, kernel::Order order = kernel::Order::fifo, Time end = Time() + until) {
  const std::vector<genom::ModuleType> types = tools::papers_modules();
  run::Experiment experiment(scenario, types, {seed, order, ""});
  if (other) experiment.intervene(run::parse_intervention("seed " + std::to_string(*other), {"test", 0}), date);
  experiment.run_before(end);
  const bridge::RunResult result = experiment.result();
  Digests all{result.digest, {}};
  for (const bridge::RobotResult& robot : result.robots) all.robots.push_back(robot.digest);
  return all;
}

TEST(Reseeding, ChangesTheRunFromItsInstantOn) {
  const scenario::Scenario scenario = shipped("office.yaml");
  for (const kernel::Order order : {kernel::Order::fifo, kernel::Order::seeded}) {
    EXPECT_EQ(digests(scenario, 1, 7, instant, order, instant).run,
              digests(scenario, 1, {}, instant, order, instant).run);
    const Digests changed = digests(scenario, 1, 7, instant, order);
    EXPECT_NE(changed.robots, digests(scenario, 1, {}, instant, order).robots);
    EXPECT_EQ(changed.run, digests(scenario, 1, 7, instant, order).run);
    EXPECT_NE(changed.robots, digests(scenario, 1, 8, instant, order).robots);
  }
}

TEST(Reseeding, PresentSeedChangesNothing) {
  const scenario::Scenario scenario = shipped("office.yaml");
  for (const kernel::Order order : {kernel::Order::fifo, kernel::Order::seeded}) {
    const Digests same = digests(scenario, 1, 1, instant, order), plain = digests(scenario, 1, {}, instant, order);
    EXPECT_EQ(same.robots, plain.robots);
    EXPECT_NE(same.run, plain.run) << "the intervention is part of the run";
  }
}

// Nothing has been drawn before the first step but the drift of the receiver in the yard, so that no stream may be left
// out.
TEST(Reseeding, AtTheFirstStepEqualsTheOtherSeed) {
  for (const std::string name : {"office.yaml", "office-air.yaml", "office-dynamic.yaml", "yard.yaml"}) {
    if (name == "office-dynamic.yaml" && world::make_bullet_world({}, 1) == nullptr) continue;  // built without Bullet
    const bool is_yard = name == "yard.yaml";
    const scenario::Scenario scenario = shipped(
        name, is_yard ? std::vector<std::string>{"robot_types.rackham.gps.drift_m=0"} : std::vector<std::string>());
    const Digests changed = digests(scenario, 1, 2, Time() + scenario.step);
    EXPECT_EQ(changed.robots, digests(scenario, 2).robots) << name;
    EXPECT_NE(changed.robots, digests(scenario, 1).robots) << name;
  }
}

}  // namespace
}  // namespace waitpoint::runs
