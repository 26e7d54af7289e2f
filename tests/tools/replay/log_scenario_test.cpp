// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint run` of a scenario with a log in place of a world.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"
#include "tests/tools/folder.hpp"

namespace waitpoint::tools {
namespace {

using nlohmann::json;

/// A folder with the recording of a simulated run, and scenarios on it.
class LogScenario : public testing::Test {
 protected:
  void SetUp() override {
    const auto recorded =
        runs::outcome_of(runs::run_command("office.yaml", "10", {"--record", (folder_ / "run.log").string()}));
    ASSERT_EQ(recorded.status, 1) << recorded.errors;  // goals left
  }

  runs::Outcome waitpoint(std::vector<std::string> words) {
    words.insert(words.begin(), runs::program().string());
    return runs::outcome_of({.words = words, .folder = folder_ / ""});
  }
  void write(const std::string& log, const std::string& robot = "name: r") {
    folder_.write("s.yaml", "format: 1\nlog: " + log + "\nrobots:\n  - {" + robot + "}\n");
  }
  json summary(std::vector<std::string> words) {
    words.insert(words.end(), {"--summary", "-"});
    const runs::Outcome outcome = waitpoint(words);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    json read = json::parse(outcome.output, nullptr, false);
    read.erase("wall_s");
    return read;
  }

  const Folder folder_;
};

TEST_F(LogScenario, ARunIsTheReplayOfTheLogWithTheScenariosParameters) {
  write("run.log", "name: r, modules: [{name: rflex}, {name: sick}, {name: segloc, length_m_min: 0.8}]");
  const json run = summary({"run", "s.yaml"});
  EXPECT_EQ(run["scans"], run["scans_of_log"]);
  EXPECT_EQ(run["pose"], "segloc");
  EXPECT_EQ(run, summary({"play", "run.log", "--scenario", "s.yaml"}));
  EXPECT_NE(run["digest"],
            summary({"run", "s.yaml", "--set", "robots.r.modules.segloc.points.key_travel_m=0.2"})["digest"]);
  write("run.log");
  EXPECT_EQ(summary({"run", "s.yaml"})["digest"], summary({"play", "run.log", "--scenario", "s.yaml"})["digest"]);
}

TEST_F(LogScenario, TheScenarioSaysWhichModulesRun) {
  write("run.log", "name: r, modules: [{name: rflex}, {name: sick}]");
  EXPECT_EQ(summary({"run", "s.yaml"})["pose"], "odometry");
  EXPECT_EQ(waitpoint({"check", "s.yaml"}).output, "s.yaml: good: 2 modules, 99 scans of run.log\n");
}

TEST_F(LogScenario, KeysOfTheScenarioOverrideTheLog) {
  write("run.log");
  const json as_logged = summary({"run", "s.yaml"});
  for (const std::string given : {"mount: [0.2, 0, 5]", "field_of_view_deg: 90", "range_max_m: 3"}) {
    write("{file: run.log, " + given + "}");
    const json run = summary({"run", "s.yaml"});
    EXPECT_NE(run["digest"], as_logged["digest"]) << given;
    EXPECT_EQ(run, summary({"play", "run.log", "--scenario", "s.yaml"})) << given;
  }
}

TEST_F(LogScenario, ARunWritesWhatAReplayWrites) {
  write("run.log");
  const auto written = [&](const std::vector<std::string>& command) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--until", "5", "--trajectory", "a.tum", "--picture", "a.svg", "--digests", "a.digests",
                               "--events", "a.events"});
    EXPECT_EQ(waitpoint(words).status, 0);
    std::vector<std::string> texts;
    for (const char* name : {"a.tum", "a.svg", "a.digests", "a.events"}) {
      texts.push_back(folder_.read(name));
      EXPECT_FALSE(texts.back().empty()) << name;
    }
    return texts;
  };
  EXPECT_EQ(written({"run", "s.yaml"}), written({"play", "run.log", "--scenario", "s.yaml"}));
}

TEST_F(LogScenario, ACheckComparesReplaysEventByEvent) {
  if (test::is_emulated()) GTEST_SKIP() << "a self-check starts its program anew";
  write("run.log");
  const runs::Outcome run = waitpoint({"run", "s.yaml", "--verify"}),
                      replay = waitpoint({"play", "run.log", "--verify"});
  EXPECT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(replay.status, 0) << replay.errors;
  EXPECT_NE(run.output.find("s, seed 1: the same run, twice in this process and once in a perturbed one"),
            std::string::npos)
      << run.output;
  EXPECT_NE(replay.output.find("run.log, seed 1: the same run"), std::string::npos) << replay.output;
  EXPECT_NE(replay.output.find(summary({"play", "run.log"})["digest"].get<std::string>()), std::string::npos);
  EXPECT_EQ(waitpoint({"play", "run.log", "--verify", "--map", "m.yaml"}).errors,
            "waitpoint: --verify: cannot be used together with --map\n");
}

TEST_F(LogScenario, ALimitOfTheScenarioHolds) {
  write("run.log\nuntil_s: 4");
  const json run = summary({"run", "s.yaml"});
  EXPECT_EQ(run["outcome"], "time limit");
  EXPECT_EQ(run["simulated_s"], 4);
  EXPECT_EQ(run, summary({"play", "run.log", "--scenario", "s.yaml"}));
  EXPECT_EQ(summary({"run", "s.yaml", "--until", "2"})["simulated_s"], 2);
}

TEST_F(LogScenario, RefusesOptionsThatNeedAWorld) {
  write("run.log");
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run", "s.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    const runs::Outcome outcome = waitpoint(words);
    EXPECT_EQ(outcome.status, 2);
    return outcome.errors;
  };
  EXPECT_EQ(refused({"--record", "a.mcap"}),
            "waitpoint: --record: expected a scenario with a world, found the log of s.yaml:2\n");
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--seeds", "1..2"}, {"--speed", "1"}, {"--interactive"}, {"--journal", "a"}, {"--decisions", "a"}})
    EXPECT_EQ(refused(options),
              "waitpoint: " + options[0] + ": expected a scenario with a world, found the log of s.yaml:2\n");
  EXPECT_EQ(refused({"--events", "run.log"}),
            "waitpoint: the scenario's log: 'run.log' is the file that --events writes\n");
  EXPECT_EQ(waitpoint({"explore", "s.yaml"}).errors,
            "waitpoint: s.yaml:2: expected a world: a log is played by 'waitpoint run' and 'waitpoint play' only\n");
  write("{file: run.log, scan: RLASSER}");
  EXPECT_EQ(refused({}),
            "waitpoint: s.yaml:2: scan: expected a type of CARMEN's records with scans, found 'RLASSER', did "
            "you mean 'RLASER'?\n");
  EXPECT_EQ(
      waitpoint({"play", "run.log", "--scenario", "s.yaml", "--scan", "LASSER"}).errors,
      "waitpoint: --scan: expected a type of CARMEN's records with scans, found 'LASSER', did you mean 'LASER'?\n");
  write("");
  EXPECT_EQ(refused({}), "waitpoint: s.yaml:2: expected the name of a log, found nothing\n");
  write("none.log");
  EXPECT_EQ(refused({}), "waitpoint: none.log: cannot be read: No such file or directory\n");
}

TEST_F(LogScenario, ACheckRefusesWhatARunRefuses) {
  const auto refused = [&](const std::string& modules) {
    write("run.log", "name: r, modules: [" + modules + "]");
    const runs::Outcome check = waitpoint({"check", "s.yaml"}), run = waitpoint({"run", "s.yaml"});
    EXPECT_EQ(check.status, 2);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(check.errors, run.errors);
    return check.errors;
  };
  EXPECT_EQ(refused("{name: rflex}"),
            "waitpoint: s.yaml:4: expected a module that reads 'sick.reading', which the log feeds\n");
  EXPECT_EQ(
      refused("{name: rflex}, {name: sick, mount_x_m: 0.2}"),
      "waitpoint: s.yaml:4: expected no mount_x_m of 'sick': the laser's mount is the log's, or 'log: {mount: [x, "
      "y, degrees]}' of a scenario\n");
}

}  // namespace
}  // namespace waitpoint::tools
