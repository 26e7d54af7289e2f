// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/expectation.hpp"

#include <gtest/gtest.h>

namespace waitpoint::run {
namespace {

using Lines = std::vector<std::string>;

bridge::RunResult result_with(std::size_t reached, std::size_t goals, std::uint64_t collisions) {
  bridge::RunResult result;
  result.robots.resize(2);
  result.robots[0].goals.resize(goals);
  for (std::size_t i = 0; i < reached; ++i) result.robots[0].goals[i].times_reached = 1;
  result.robots[1].collisions = collisions;
  return result;
}

TEST(Expectation, EmptyIsAlwaysMet) { EXPECT_EQ(unmet({}, result_with(0, 3, 9)), Lines{}); }

TEST(Expectation, ChecksGoalsAndCollisions) {
  scenario::Expectation expect;
  expect.all_goals_reached = true;
  expect.collisions = 0;
  EXPECT_EQ(unmet(expect, result_with(3, 3, 0)), Lines{});
  EXPECT_EQ(unmet(expect, result_with(2, 3, 0)), Lines{"2 of 3 goals reached, expected all"});
  EXPECT_EQ(unmet(expect, result_with(3, 3, 1)), Lines{"1 collision, expected 0"});
  EXPECT_EQ(unmet(expect, result_with(2, 3, 1)).size(), 2u);
}

TEST(Expectation, RequiresAnExactNumberOfGoals) {
  scenario::Expectation expect;
  expect.goals_reached = 2;
  EXPECT_EQ(unmet(expect, result_with(2, 3, 5)), Lines{});
  EXPECT_EQ(unmet(expect, result_with(3, 3, 5)), Lines{"3 of 3 goals reached, expected 2"});
}

TEST(Expectation, PrintsDigitsUpToTheDifference) {
  scenario::Expectation expect;
  expect.position_error_max_m = 0.025;
  bridge::RunResult result = result_with(0, 0, 0);
  for (const auto& [error_m, text] : {std::pair{0.0250004, "0.0250004"}, std::pair{0.5, "0.5"}}) {
    result.robots[0].position_error_max_m = error_m;
    EXPECT_EQ(unmet(expect, result), Lines{std::string("position error of ") + text + " m, expected at most 0.025 m"});
  }
}

TEST(Expectation, NeverAllowsARunWithoutProgress) {
  bridge::RunResult result = result_with(0, 0, 0);
  result.outcome = bridge::Outcome::no_progress;
  EXPECT_EQ(unmet({}, result), Lines{"the run made no progress"});
}

TEST(Expectation, NeverAllowsADeadlock) {
  bridge::RunResult result = result_with(0, 0, 0);
  result.outcome = bridge::Outcome::deadlock;
  EXPECT_EQ(unmet({}, result), Lines{"the run ended in a deadlock"});
}

TEST(RunTotals, SumCountsAndKeepTheGreatestErrors) {
  bridge::RunResult result = result_with(1, 2, 3);
  result.robots[0].position_error_mean_m = 0.25;
  result.robots[0].position_error_max_m = 0.5;
  result.robots[1].position_error_mean_m = 0.75;
  result.robots[1].position_error_max_m = 0.125;
  result.robots[1].distance_m = 7;
  const bridge::RunTotals sum = bridge::totals(result);
  EXPECT_EQ(sum.goals, 2u);
  EXPECT_EQ(sum.goals_reached, 1u);
  EXPECT_EQ(sum.collisions, 3u);
  EXPECT_EQ(sum.distance_m, 7);
  EXPECT_EQ(sum.position_error_mean_m, 0.5);
  EXPECT_EQ(sum.position_error_max_m, 0.5);
}

}  // namespace
}  // namespace waitpoint::run
