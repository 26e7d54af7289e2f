// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint explore` finds the planted bugs of a robot, explains them and replays them.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "modules/genom/module.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/folder.hpp"
#include "tools/explore/explore.hpp"
#include "tools/explore/runs/scene.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

using namespace std::chrono_literals;

/// The fault of the module, raised when its second task has come first in `turns` consecutive periods.
struct PairParameters {
  std::uint32_t fault = 0;  ///< 0: nothing, 1: an exception, 2: a loop without end, 3: a crash
  std::uint32_t turns = 2;  ///< consecutive periods in which the second task must come first

  static void fields(auto field) {
    field("fault", &PairParameters::fault);
    field("turns", &PairParameters::turns);
  }
};

/// Two tasks with one period; the default order wakes the first one first.
class Pair : public genom::Module {
 public:
  explicit Pair(genom::ModuleSetup& setup)
      : Module(setup, 50),
        first_(add_task("first", {.period_ms = 10ms, .delay_ms = {}, .cost_us = {}})),
        second_(add_task("second", {.period_ms = 10ms, .delay_ms = {}, .cost_us = {}})) {
    setup.settings.read(parameters_);
    first_.set_permanent([this] { ++firsts_; });
    second_.set_permanent([this] {
      ++seconds_;
      in_turn_ = seconds_ > firsts_ ? in_turn_ + 1 : 0;
      if (in_turn_ >= parameters_.turns) fail();
    });
  }

 private:
  void fail() {
    if (parameters_.fault == 1) throw std::runtime_error("the second task came first");
    while (parameters_.fault == 2) threads::this_thread::yield();
    if (parameters_.fault == 3) std::raise(SIGSEGV);
  }

  PairParameters parameters_;
  genom::ExecutionTask& first_;
  genom::ExecutionTask& second_;
  std::uint32_t firsts_ = 0, seconds_ = 0, in_turn_ = 0;
};

class ExploreScenario : public ::testing::Test {
 protected:
  struct Told {
    int status;
    std::string output, errors;
  };

  void SetUp() override {
    folder_.write(
        "pair.yaml",
        "format: 1\nname: pair\nuntil_s: 0.5\nrobots:\n  - name: r\n    shape: {radius_m: 0.2, height_m: 0.5}\n"
        "    start: [0, 0, 0]\n    modules: [{name: pair}]\n");
  }

  tools::ExploreOptions options(std::uint32_t fault, std::vector<std::string> more = {}) const {
    tools::ExploreOptions options;
    options.scenario = folder_ / "pair.yaml";
    options.assignments = {"robots.0.modules.pair.fault=" + std::to_string(fault)};
    for (std::string& assignment : more) options.assignments.push_back(std::move(assignment));
    options.strategy = "random";
    options.iterations = 300;
    return options;
  }

  static Told explore(const tools::ExploreOptions& options) {
    const std::vector<genom::ModuleType> types = {genom::module_type<Pair>("pair")};
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Told told{-1, "", ""};
    std::string bad;
    try {
      told.status = tools::explore(options, types);
    } catch (const BadInput& error) {
      told.status = 2;
      bad = error.what();
    }
    told.output = testing::internal::GetCapturedStdout();
    told.errors = testing::internal::GetCapturedStderr() + bad;
    return told;
  }

  static std::string found(const std::string& text, const char* pattern) {
    std::smatch match;
    return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
  }

  tools::Folder folder_;
};

TEST_F(ExploreScenario, PassesIfNoScheduleFails) {
  const Told told = explore(options(0));
  EXPECT_EQ(told.status, 0) << told.output << told.errors;
  EXPECT_TRUE(told.output.starts_with("pair: 300 schedules, ")) << told.output;
  EXPECT_GT(std::stoi(found(told.output, "schedules, (\\d+) distinct")), 290);
}

TEST_F(ExploreScenario, AnExceptionIsFoundMinimisedExplainedAndReplayed) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=3"});
  search.schedule = folder_ / "schedule";
  search.trace = folder_ / "trace.json";
  const Told told = explore(search);
  EXPECT_EQ(told.status, 1);
  EXPECT_NE(told.output.find("the second task came first"), std::string::npos) << told.output;
  // Each period has its own order; a period's order may depend on the previous one.
  const std::string found_ones = found(told.output, "fails?, of (\\d+) that were found");
  const std::string left = found(told.output, "\n(\\d+) switch(?:es)? away from the default order fail");
  ASSERT_FALSE(found_ones.empty() || left.empty()) << told.output;
  EXPECT_LE(2 * std::stoi(left), std::stoi(found_ones)) << told.output;
  EXPECT_NE(told.output.find("could still have passed: number "), std::string::npos) << told.output;
  EXPECT_NE(told.output.find("last events of the tasks"), std::string::npos);
  EXPECT_NE(folder_.read("trace.json").find("traceEvents"), std::string::npos);
  const std::string token = found(told.output, "--replay (wx1\\S+)");
  EXPECT_LE(token.size(), 80u);
  ASSERT_NE(token, "") << told.output;
  for (const std::string& record : {token, (folder_ / "schedule").string()}) {
    tools::ExploreOptions again = options(1, {"robots.0.modules.pair.turns=3"});
    again.replay = record;
    const Told replayed = explore(again);
    EXPECT_EQ(replayed.status, 1);
    EXPECT_NE(replayed.output.find("the same run"), std::string::npos) << replayed.errors;
    EXPECT_NE(replayed.errors.find("the second task came first"), std::string::npos) << replayed.errors;
  }
}

TEST_F(ExploreScenario, AFindingHasBothRunsWithTheirFloorAndTheEventsWhoseOrderMatters) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=3"});
  search.finding = folder_ / "finding.json";
  const Told told = explore(search);
  ASSERT_EQ(told.status, 1) << told.errors;
  const auto finding = nlohmann::json::parse(folder_.read("finding.json"));
  EXPECT_EQ(finding["header"]["robots"][0]["name"], "r");
  ASSERT_EQ(finding["others"].size(), 1u) << told.output;
  for (const auto& schedule : {finding, finding["others"][0]}) {
    EXPECT_FALSE(schedule["frames"].empty());
    EXPECT_EQ(schedule["frames"][0]["time"], 0);
    EXPECT_GT(schedule["events"]["t"].size(), 10u);
    EXPECT_EQ(schedule["events"]["marked"].size(), 2u);
  }
  // Up to where they part, both runs are the same.
  const auto &fails = finding["events"]["k"], &passes = finding["others"][0]["events"]["k"];
  const std::size_t parting = finding["events"]["marked"][0].get<std::size_t>() - 1;
  EXPECT_TRUE(std::equal(fails.begin(), fails.begin() + static_cast<std::ptrdiff_t>(parting / 2), passes.begin()));
  EXPECT_NE(told.output.find(finding["finding"]["report"].get<std::string>()), std::string::npos);
  EXPECT_NE(found(told.output, "first in the failing run: +(at .*)"), "");
  EXPECT_EQ(finding["marks"][0]["words"], found(told.output, "first in the failing run: +(at .*)"));
}

TEST_F(ExploreScenario, FindsALackOfProgressAndNamesTheSpinningTask) {
  const Told told = explore(options(2));
  EXPECT_EQ(told.status, 1);
  EXPECT_NE(told.output.find("no progress"), std::string::npos) << told.output;
  EXPECT_NE(told.output.find("pair.second"), std::string::npos) << told.output;
}

TEST_F(ExploreScenario, ACrashIsAFailureOfItsScheduleAndTheOthersGoOn) {
  tools::ExploreOptions search = options(3);
  search.jobs = 2;
  search.iterations = 20;
  search.results = folder_ / "results";
  const Told told = explore(search);
  EXPECT_EQ(told.status, 1);
  EXPECT_NE(told.output.find("killed by signal 11"), std::string::npos) << told.output;
  const std::string results = folder_.read("results");
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), 21) << results;
  EXPECT_NE(told.output.find("--replay wx1.0.00000000.random.1."), std::string::npos) << told.output;
}

TEST_F(ExploreScenario, TheFirstFailureIsTheSameWithAnyNumberOfJobs) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=6"});
  search.minimize = false;
  const std::string one = found(explore(search).output, "(schedule \\d+ of strategy random.*\n)");
  EXPECT_NE(one, "");
  search.jobs = 3;
  EXPECT_EQ(found(explore(search).output, "(schedule \\d+ of strategy random.*\n)"), one);
}

TEST_F(ExploreScenario, ShardsDoWhatOneMachineDoes) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=5"});
  search.minimize = false;
  search.iterations = 30;
  search.results = folder_ / "one";
  explore(search);
  std::set<std::string> merged;
  for (std::uint64_t index = 1; index <= 3; ++index) {
    search.shard = {index, 3};
    search.results = folder_ / "part";
    explore(search);
    std::istringstream lines(folder_.read("part"));
    for (std::string line; std::getline(lines, line);) merged.insert(line);
  }
  std::string text;
  for (const std::string& line : merged) text += line + "\n";
  EXPECT_EQ(text, folder_.read("one"));
  EXPECT_EQ(merged.size(), 31u);
}

TEST_F(ExploreScenario, FromMidRunSchedulesPartThereAndReplay) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=3"});
  search.from = Duration(200ms);
  const Told told = explore(search);
  EXPECT_EQ(told.status, 1) << told.output << told.errors;
  const std::string failed_at = found(told.output, "failed at (\\S+) s");
  EXPECT_GT(std::stod(failed_at), 0.2) << told.output;
  tools::ExploreOptions again = search;
  again.replay = found(told.output, "--replay (wx1\\S+)");
  const Told replayed = explore(again);
  EXPECT_EQ(replayed.status, 1);
  EXPECT_NE(replayed.output.find("the same run"), std::string::npos) << replayed.errors;
}

TEST_F(ExploreScenario, ARecordOfAnotherRunIsTold) {
  tools::ExploreOptions search = options(1, {"robots.0.modules.pair.turns=3"});
  search.schedule = folder_ / "schedule";
  const Told told = explore(search);
  tools::ExploreOptions again = options(1, {"robots.0.modules.pair.turns=4"});
  again.replay = folder_ / "schedule";
  const Told foreign = explore(again);
  EXPECT_EQ(foreign.status, 2);
  EXPECT_NE(foreign.errors.find("schedule:2: expected a schedule of this scenario"), std::string::npos)
      << foreign.errors;
  again.replay = "wx1.1.00000000.random.1.7";
  EXPECT_EQ(explore(again).status, 2) << "a token of a test";
  again.replay = "wx1.0.00000001.random.1.7";
  const Told other = explore(again);
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.errors.find("this is not the run of the record: it had "), std::string::npos) << other.errors;
  EXPECT_NE(other.errors.find(", the record says 00000001"), std::string::npos) << other.errors;
  // The record asks for a switch at an event that does not exist in the run.
  std::string schedule = folder_.read("schedule");
  schedule = std::regex_replace(schedule, std::regex("\n(task \\S+) \\d+ "), "\n$1 1234567 ");
  folder_.write("schedule", schedule);
  again = search;
  again.schedule.reset();
  again.replay = folder_ / "schedule";
  const Told left = explore(again);
  EXPECT_EQ(left.status, 2);
  EXPECT_NE(left.errors.find("line 6: event 1234567 of task "), std::string::npos) << left.errors;
  EXPECT_NE(left.errors.find("; no switch of the record was reached before"), std::string::npos) << left.errors;
  again.seed = 2;
  again.seed_is_asked = true;
  const Told contradicted = explore(again);
  EXPECT_EQ(contradicted.status, 2);
  EXPECT_NE(contradicted.errors.find("--seed: expected 1, that of "), std::string::npos) << contradicted.errors;
}

TEST_F(ExploreScenario, FailureOfTheDefaultOrderIsReportedAtOnce) {
  const Told told = explore(options(1, {"robots.0.modules.pair.turns=0"}));
  EXPECT_EQ(told.status, 1);
  EXPECT_TRUE(told.output.starts_with("the default order, with the scenario's own noise, failed at ")) << told.output;
  EXPECT_NE(told.output.find(".=\n"), std::string::npos) << "a token without a choice: " << told.output;
}

// Neither the windows between checks of the expectations nor separate processes change the run.
TEST_F(ExploreScenario, ScheduleIsTheSameRunInAnyProcess) {
  const auto digests = [this](std::uint32_t jobs) {
    tools::ExploreOptions search = options(0);
    search.iterations = 5;
    search.jobs = jobs;
    search.results = folder_ / "results";
    explore(search);
    return folder_.read("results");
  };
  const std::string results = digests(1);
  EXPECT_EQ(digests(2), results);
  const scenario::Scenario scenario = scenario::read_scenario(folder_ / "pair.yaml", options(0).assignments);
  const std::vector<genom::ModuleType> types = {genom::module_type<Pair>("pair")};
  const tools::ExploreOptions same = options(0);
  tools::Scene scene(scenario, types, same, "");
  for (std::uint64_t number = 0; number < 5; ++number)
    EXPECT_NE(results.find(tools::digest_text(scene.run({.number = number}).digest)), std::string::npos) << number;
}

TEST(ExploreProgram, OfficeFromMidRunStoppedBySignalTellsWhatWasDone) {
  Command command = run_command("office.yaml", "30", {"--from", "25", "--iterations", "100000"});
  command.words[1] = "explore";
  command.words.insert(command.words.begin(), {"timeout", "--preserve-status", "-s", "INT", "3"});
  const Outcome outcome = outcome_of(command);
  EXPECT_EQ(outcome.status, 130) << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("stopped by a signal"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find(" 0 failed"), std::string::npos) << outcome.output;
}

TEST(ExploreProgram, NoiseIsToldFromOrder) {
  // The default noise stays below the limit, other noise does not.
  Command command =
      run_command("office.yaml", "12", {"--property", "position_error_max_m=0.0075", "--iterations", "30"});
  command.words[1] = "explore";
  const Outcome outcome = outcome_of(command);
  EXPECT_EQ(outcome.status, 1) << outcome.output << outcome.errors;
  EXPECT_NE(outcome.output.find("it is the noise, not the order"), std::string::npos) << outcome.output;
}

TEST(ExploreProgram, BadInputIsOneLineAndStatusTwo) {
  for (const auto& [option, value] : {std::pair("--shard", "3/2"),
                                      {"--strategy", "best"},
                                      {"--property", "speed=1"},
                                      {"--replay", "wx1.0.1.x"},
                                      {"--replay", "no such file"},
                                      {"--from", "400"}}) {
    Command command = run_command("office.yaml", "1", {option, value});
    command.words[1] = "explore";
    const Outcome outcome = outcome_of(command);
    EXPECT_EQ(outcome.status, 2) << option << " " << outcome.output;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }
}

}  // namespace
}  // namespace waitpoint::runs
