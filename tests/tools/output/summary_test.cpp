// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/sample_result.hpp"

namespace waitpoint::tools {
namespace {

using Json = nlohmann::json;

TEST(SummaryJson, HasEveryDocumentedKey) {
  const Json json = Json::parse(summary_json(sample_result(2)));
  EXPECT_EQ(json.at("digest"), to_string(Digest(1)));
  EXPECT_EQ(json.at("goals"), 4);
  EXPECT_EQ(json.at("goals_reached"), 2);
  EXPECT_EQ(json.at("collisions"), 0);
  EXPECT_EQ(json.at("distance_m"), 21.0);
  EXPECT_EQ(json.at("position_error_mean_m"), 0.03);
  EXPECT_EQ(json.at("position_error_max_m"), 0.125);
  EXPECT_EQ(json.at("odometry_error_max_m"), 1.5);
  EXPECT_EQ(json.at("odometry_error_end_m"), 1.25);
  EXPECT_EQ(json.at("events"), 12345);
  EXPECT_EQ(json.at("simulated_s"), 40.0);
  EXPECT_EQ(json.at("wall_s"), 0.5);
  EXPECT_EQ(json.at("real_time_factor"), 80.0);
  EXPECT_EQ(json.at("seed"), 7);
  EXPECT_EQ(json.at("outcome"), "time limit");
  EXPECT_FALSE(json.contains("deadlock"));
}

TEST(SummaryJson, HasTheSameFiguresForEachRobot) {
  const Json robots = Json::parse(summary_json(sample_result(2))).at("robots");
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots[1].at("name"), "second");
  EXPECT_EQ(robots[1].at("digest"), to_string(Digest(6)));
  for (const char* key : {"goals", "goals_reached", "collisions", "distance_m", "position_error_mean_m",
                          "position_error_max_m", "odometry_error_max_m"}) {
    EXPECT_TRUE(robots[0].at(key).is_number()) << key;
  }
  EXPECT_EQ(robots[0].at("goal_reports").at(0).at("time_s"), 12.5);
  EXPECT_EQ(robots[0].at("goal_reports").at(1).at("report"), "no way");
}

TEST(SummaryJson, HasSimulatedBatteriesOnly) {
  bridge::RunResult result = sample_result(2);
  result.robots[0].battery = {.charge = 0.25, .volts = 23.5};
  result.robots[1].battery = {.charge = 0, .volts = 22, .empty_at = Time::from_ns(7'200'000'000)};
  const Json robots = Json::parse(summary_json(result)).at("robots");
  EXPECT_EQ(robots[0].at("battery_charge"), 0.25);
  EXPECT_EQ(robots[0].at("battery_volts"), 23.5);
  EXPECT_FALSE(robots[0].contains("battery_empty_at_s"));
  EXPECT_EQ(robots[1].at("battery_empty_at_s"), 7.2);
  EXPECT_FALSE(Json::parse(summary_json(sample_result())).at("robots")[0].contains("battery_charge"));
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("one: battery 25.0 % full, 23.50 V\n"), std::string::npos) << text;
  EXPECT_NE(text.find("second: battery empty at 7.2 s, off since then\n"), std::string::npos) << text;
}

TEST(Summary, OmitsFiguresThatNoRobotHas) {
  bridge::RunResult result = sample_result(1);
  result.robots[0].goals.clear();
  result.robots[0].present = {.motion = false, .position = false, .odometry = false};
  const std::string text = summary_text(result);
  for (const char* title : {"goals", "distance", "collisions", "position", "odometry"})
    EXPECT_EQ(text.find(title), std::string::npos) << text;
  EXPECT_NE(text.find("events            12345\n"), std::string::npos) << text;
  const Json json = Json::parse(summary_json(result));
  for (const char* key : {"distance_m", "collisions", "position_error_mean_m", "position_error_max_m",
                          "odometry_error_max_m", "odometry_error_end_m"}) {
    EXPECT_FALSE(json.contains(key)) << key;
    EXPECT_FALSE(json.at("robots").at(0).contains(key)) << key;
  }
  EXPECT_EQ(seeds_row(result),
            "         7   time limit        -          -           -             -             -"
            "      80.0  " +
                to_string(Digest(1)) + "\n");
}

TEST(Summary, ExcludesRobotsWithoutPositionFromMeans) {
  bridge::RunResult result = sample_result(2);
  bridge::RobotResult bystander;
  bystander.name = "second";
  bystander.present = {.motion = false, .position = false, .odometry = false};
  result.robots[1] = bystander;
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("distance driven   10.5 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("mean 0.030 m, greatest 0.125 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  second        -          -           -                     -                   -  wp1:"),
            std::string::npos)
      << text;
  EXPECT_EQ(Json::parse(summary_json(result)).at("position_error_mean_m"), 0.03);
}

TEST(Summary, CountsTheVisitsOfAllRounds) {
  bridge::RunResult result = sample_result(1);
  result.robots[0].goals = {{{3, 1}, "shelf", 50, 50, Time::from_ns(90'000'000'000), "reached"},
                            {{5, 4}, "", 50, 49, Time::from_ns(40'000'000'000), "no way"}};
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("99 of 100"), std::string::npos) << text;
  EXPECT_NE(text.find("one: goal 2 at (5.00, 4.00): reached 49 of 50 times; no way at 40.0 s"), std::string::npos);
  EXPECT_EQ(text.find("shelf"), std::string::npos) << "reached at every visit";
  const Json goal = Json::parse(summary_json(result)).at("robots").at(0).at("goal_reports").at(1);
  EXPECT_EQ(goal.at("visits"), 50);
  EXPECT_EQ(goal.at("times_reached"), 49);
  EXPECT_EQ(goal.at("reached"), false);
}

TEST(SummaryJson, SeveralRunsGiveAList) {
  const std::vector<bridge::RunResult> results = {sample_result(1), sample_result(2)};
  const Json json = Json::parse(summary_json(std::span<const bridge::RunResult>(results)));
  EXPECT_EQ(json.at("runs").size(), 2u);
  EXPECT_EQ(json.at("runs").at(1).at("robots").size(), 2u);
}

TEST(SummaryJson, ReplacesInvalidUtf8) {
  bridge::RunResult result = sample_result(1);
  result.scenario = "caf\xe9";
  EXPECT_TRUE(Json::accept(summary_json(result)));
}

TEST(Summary, PacedRunReportsItsLag) {
  bridge::RunResult result = sample_result(1);
  EXPECT_FALSE(Json::parse(summary_json(result)).contains("lag_max_s"));
  EXPECT_EQ(summary_text(result).find("lag"), std::string::npos);
  result.lag = {0.125, 2.5};
  EXPECT_EQ(Json::parse(summary_json(result)).at("lag_mean_s"), 0.125);
  EXPECT_EQ(Json::parse(summary_json(result)).at("lag_max_s"), 2.5);
  EXPECT_NE(summary_text(result).find("mean 125.0 ms, greatest 2500.0 ms behind the wall clock"), std::string::npos);
}

TEST(SummaryText, PrintsFiguresAndEndsWithTheDigest) {
  const std::string text = summary_text(sample_result(1));
  for (const char* part : {"seed 7: time limit after 40.0 s", "1 of 2", "10.5 m", "mean 0.030 m, greatest 0.125 m",
                           "greatest 1.50 m, at the end 1.25 m", "12345", "80.0 times real time",
                           "one: goal 2 at (5.00, 4.00): no way at 40.0 s"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_TRUE(text.ends_with(to_string(Digest(1)) + "\n"));
  EXPECT_EQ(text.find("collisions  "), text.rfind("collisions  ")) << "no table for one robot";
}

TEST(SummaryText, HasARowPerRobot) {
  const std::string text = summary_text(sample_result(2));
  EXPECT_NE(text.find("second      1/2     10.5 m"), std::string::npos) << text;
}

TEST(SummaryText, PrintsWarningsAndTheDeadlock) {
  bridge::RunResult result = sample_result(1);
  result.warnings = {"the step is coarse"};
  result.trouble = "a waits for b";
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("\nwarning: the step is coarse\n"), std::string::npos);
  EXPECT_NE(text.find("\na waits for b\n"), std::string::npos);
}

TEST(Summary, NoProgressIsDistinctFromDeadlock) {
  bridge::RunResult result = sample_result(1);
  result.outcome = bridge::Outcome::no_progress;
  result.trouble = "no progress: a spins";
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("seed 7: no progress after 40.0 s"), std::string::npos) << text;
  EXPECT_NE(text.find("\nno progress: a spins\n"), std::string::npos) << text;
  const Json json = Json::parse(summary_json(result));
  EXPECT_EQ(json.at("outcome"), "no progress");
  EXPECT_EQ(json.at("no_progress"), "no progress: a spins");
  EXPECT_FALSE(json.contains("deadlock"));
  result.outcome = bridge::Outcome::deadlock;
  EXPECT_EQ(Json::parse(summary_json(result)).at("deadlock"), "no progress: a spins");
}

TEST(Summary, ListsOnlyTasksThatMissedDeadlines) {
  bridge::RunResult result = sample_result(2);
  EXPECT_EQ(summary_text(result).find("deadline"), std::string::npos);
  EXPECT_FALSE(Json::parse(summary_json(result)).at("robots").at(0).contains("late_tasks"));
  result.robots[1].late_tasks = {{"segloc.slam", std::chrono::milliseconds(20), 12, 3, Duration::from_ns(1'500'000)}};
  const std::string text = summary_text(result);
  EXPECT_NE(text.find("second: task segloc.slam missed 12 deadlines and 3 periods of 20 ms; at most 1.5 ms late\n"),
            std::string::npos)
      << text;
  const Json task = Json::parse(summary_json(result)).at("robots").at(1).at("late_tasks").at(0);
  EXPECT_EQ(task.at("name"), "segloc.slam");
  EXPECT_EQ(task.at("period_ms"), 20);
  EXPECT_EQ(task.at("missed_deadlines"), 12);
  EXPECT_EQ(task.at("missed_periods"), 3);
  EXPECT_EQ(task.at("greatest_lateness_ms"), 1.5);
}

TEST(SeedsTable, HeadAndRowsHaveTheSameColumns) {
  const std::string head = seeds_head(), row = seeds_row(sample_result(1));
  EXPECT_EQ(head.find("outcome") + 7, row.find("time limit") + 10);
  EXPECT_EQ(head.find("digest"), row.find("wp1:"));
}

}  // namespace
}  // namespace waitpoint::tools
