// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/explore_options.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/tools/command_line.hpp"

namespace waitpoint::tools {
namespace {

// The arguments of `waitpoint explore`.
std::vector<const char*> words(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "explore");
  return arguments;
}

ExploreOptions explore(const std::vector<const char*>& arguments) {
  return std::get<ExploreOptions>(read(words(arguments)));
}

std::string refusal(const std::vector<const char*>& arguments) { return message(words(arguments)); }

class ExploreCommandLine : public ::testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  static void clear() {
    for (const char* name : {"WAITPOINT_SEED", "WAITPOINT_STRATEGY", "WAITPOINT_ITERATIONS", "WAITPOINT_TIME_LIMIT",
                             "WAITPOINT_RACES", "WAITPOINT_REPLAY"})
      unsetenv(name);
  }
};

TEST_F(ExploreCommandLine, ScenarioAloneHasDefaults) {
  const ExploreOptions options = explore({"floor.yaml"});
  EXPECT_EQ(options.scenario, "floor.yaml");
  EXPECT_EQ(options.strategy, "portfolio");
  EXPECT_EQ(options.seed, 1u);
  EXPECT_EQ(options.iterations, 1000u);
  EXPECT_EQ(options.jobs, 1u);
  EXPECT_EQ(options.shard.index, 1u);
  EXPECT_EQ(options.shard.count, 1u);
  EXPECT_TRUE(options.minimize);
  EXPECT_TRUE(options.assignments.empty() && options.replay.empty());
  EXPECT_FALSE(options.has_until() || options.from || options.results || options.trace || options.schedule);
}

TEST_F(ExploreCommandLine, ReadsEveryOption) {
  const ExploreOptions options = explore({"--strategy",    "pct:3",
                                          "--iterations",  "7",
                                          "--time-limit",  "1.5",
                                          "--jobs",        "2",
                                          "--seed",        "9",
                                          "--property",    "collisions=0",
                                          "--set",         "world.step_ms=5",
                                          "--until",       "20",
                                          "--from",        "10",
                                          "--shard",       "2/3",
                                          "--results",     "r",
                                          "--schedule",    "s",
                                          "--trace",       "t",
                                          "--no-minimize", "floor.yaml"});
  EXPECT_EQ(options.strategy, "pct:3");
  EXPECT_EQ(options.iterations, 7u);
  EXPECT_EQ(options.time_limit_s, 1.5);
  EXPECT_EQ(options.jobs, 2u);
  EXPECT_EQ(options.seed, 9u);
  EXPECT_EQ(options.assignments, (std::vector<std::string>{"world.step_ms=5", "expect.collisions=0"}));
  EXPECT_EQ(options.until, Time() + std::chrono::seconds(20));
  EXPECT_EQ(options.from, Duration(std::chrono::seconds(10)));
  EXPECT_EQ(options.shard.index, 2u);
  EXPECT_EQ(options.shard.count, 3u);
  EXPECT_EQ(options.results, "r");
  EXPECT_EQ(options.schedule, "s");
  EXPECT_EQ(options.trace, "t");
  EXPECT_FALSE(options.minimize);
}

TEST_F(ExploreCommandLine, EnvironmentFillsMissingOptions) {
  setenv("WAITPOINT_SEED", "4", 1);
  setenv("WAITPOINT_STRATEGY", "random", 1);
  setenv("WAITPOINT_ITERATIONS", "11", 1);
  setenv("WAITPOINT_REPLAY", "wx1.0.00000000.=1-1", 1);
  const ExploreOptions options = explore({"a", "--seed", "5"});
  EXPECT_EQ(options.seed, 5u);
  EXPECT_EQ(options.strategy, "random");
  EXPECT_EQ(options.iterations, 11u);
  EXPECT_EQ(options.replay, "wx1.0.00000000.=1-1");
  EXPECT_EQ(options.races, Races::report);
  setenv("WAITPOINT_RACES", "fail", 1);
  EXPECT_EQ(explore({"a"}).races, Races::fail);
  setenv("WAITPOINT_ITERATIONS", "many", 1);
  EXPECT_EQ(refusal({"a"}), "WAITPOINT_ITERATIONS: expected a positive whole number, found 'many'");
}

TEST_F(ExploreCommandLine, TimeLimitAloneIsTheOnlyLimit) {
  EXPECT_EQ(explore({"a", "--time-limit", "1"}).iterations, ~std::uint64_t{0});
  EXPECT_EQ(explore({"a", "--time-limit", "1", "--iterations", "3"}).iterations, 3u);
}

TEST_F(ExploreCommandLine, ContradictionsAreReportedInOneLine) {
  EXPECT_EQ(refusal({"a", "--property", "colisions=0"}),
            "--property colisions=0: unknown key 'colisions', did you mean 'collisions'?; there are goals_reached, "
            "collisions, position_error_max_m, plans, node_failures, service_call_max_s, topics, tests");
  EXPECT_EQ(refusal({"a", "--property", "collisions"}), "--property collisions: expected key=value");
  EXPECT_EQ(refusal({"a", "--property", "collisions=x"}),
            "--property collisions=x: expected a whole number, found 'x'");
  EXPECT_EQ(refusal({"a", "--replay", "wx1.0.00000000.=", "--strategy", "random"}),
            "--replay: cannot be used together with --strategy");
  EXPECT_TRUE(refusal({"a", "--strategy", "pcd"}).starts_with("strategy: unknown strategy 'pcd', did you mean 'pct'?"));
  EXPECT_EQ(
      refusal({"a", "--strategy", "dfs"}),
      "--strategy: expected a strategy that draws its schedules (a scenario has too many for an exhaustive search), "
      "found 'dfs'");
  for (const char* shard : {"0/2", "3/2", "1", "1/0", "a/b", "1/2/3"})
    EXPECT_EQ(refusal({"a", "--shard", shard}),
              std::string("--shard: expected I/N with 1 <= I <= N, found '") + shard + "'");
  EXPECT_EQ(refusal({"a", "--jobs", "0"}), "--jobs: expected a whole number from 1 to 1024, found '0'");
  EXPECT_EQ(refusal({"a", "--from", "20", "--until", "10"}), "--from: expected a time before --until, found '20'");
  EXPECT_EQ(refusal({"a", "--iterations", "-1"}), "--iterations: expected a positive whole number, found '-1'");
  EXPECT_EQ(refusal({"a", "--iterations", "0"}), "--iterations: expected a positive whole number, found '0'");
  EXPECT_EQ(refusal({"a", "--races", "fail"}), "--races: expected a program, not a scenario");
  EXPECT_EQ(explore({"a", "--schedule-limit", "0"}).schedule_limit_s, 0.0);
  EXPECT_EQ(refusal({"a", "--schedule-limit", "-1"}),
            "--schedule-limit: expected a number of seconds, 0 for no limit, found '-1'");
  EXPECT_EQ(refusal({"a", "--time-limit", "0"}),
            "--time-limit: expected a positive number of seconds (omit the option for no limit), found '0'");
  EXPECT_FALSE(refusal({"a", "--strategy", "best"}).find("dpor") != std::string::npos);
  EXPECT_EQ(refusal({"a", "--strategy", "dpro"}).find("dpor"), std::string::npos);
  EXPECT_EQ(refusal({"a", "--replay", "wx1.0.zz"}),
            "replay: expected eight hexadecimal digits of a digest, not 'zz', in the token 'wx1.0.zz'");
  EXPECT_EQ(refusal({"a", "--results", "out", "--trace", "out"}), "--trace: 'out' is the file that --results writes");
  EXPECT_EQ(refusal({"a", "--schedule", "out", "--trace", "./out"}),
            "--trace: './out' is the file that --schedule writes");
  EXPECT_EQ(refusal({"a", "--replay", "f", "--trace", "f"}), "--replay: 'f' is the file that --trace writes");
  EXPECT_EQ(refusal({"a", "--replay", "f", "--results", "r"}), "--replay: cannot be used together with --results");
}

TEST_F(ExploreCommandLine, HelpNamesOptionsStrategiesAndExitStatuses) {
  const std::string help = std::get<ShownText>(read(words({"--help-all"}))).text;
  for (const char* word : {"--strategy", "--iterations", "--time-limit", "--schedule-limit", "--jobs", "--seed",
                           "--property", "--until", "--from", "--set", "--shard", "--results", "--replay", "--schedule",
                           "--trace", "--no-minimize", "pct:D", "Exit status: 0"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace waitpoint::tools
