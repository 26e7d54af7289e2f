// SPDX-License-Identifier: BSD-3-Clause
// Runs under measured clocks, replayed from their records to the same digest.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/project.hpp"
#include "tests/runs/program.hpp"

namespace waitpoint::runs {
namespace {

namespace fs = std::filesystem;

class DurationsTest : public testing::Test {
 protected:
  DurationsTest() : folder_(fs::temp_directory_path() / ("waitpoint-durations-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~DurationsTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& file) const { return (folder_ / file).string(); }

  Outcome run(std::vector<std::string> more, const std::string& clock = "cpu", const std::string& until_s = "3") const {
    for (const char* task : {"segloc.tasks.slam", "ndd.tasks.motion", "pom.tasks.fusing", "sick.tasks.scanning"}) {
      more.push_back("--set");
      more.push_back(std::string("robot_types.rackham.modules.") + task + ".clock=" + clock);
    }
    return outcome_of(run_command("office.yaml", until_s, more));
  }
  std::string text(const std::string& file) const {
    std::ifstream in(path(file));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
};

TEST_F(DurationsTest, AMeasuredRunReplaysFromItsRecordToTheSameDigest) {
  const Outcome first = run({"--record-durations", path("a")});
  const Outcome second = run({"--record-durations", path("b")});
  ASSERT_NE(first.digest(), "") << first.errors;
  EXPECT_NE(first.digest(), second.digest());
  EXPECT_NE(text("a"), text("b"));
  for (int repeat = 0; repeat < 2; ++repeat) {
    EXPECT_EQ(run({"--replay-durations", path("a")}).digest(), first.digest());
    EXPECT_EQ(run({"--replay-durations", path("b")}).digest(), second.digest());
  }
}

TEST_F(DurationsTest, TheShippedScenarioOfMeasuredModulesReplaysFromItsRecord) {
  const auto run = [&](const std::vector<std::string>& more) {
    return outcome_of(run_command("office-measured.yaml", "3", more));
  };
  const Outcome first = run({"--record-durations", path("a")});
  ASSERT_NE(first.digest(), "") << first.errors;
  EXPECT_NE(run({}).digest(), first.digest());
  EXPECT_EQ(run({"--replay-durations", path("a")}).digest(), first.digest());
}

TEST_F(DurationsTest, ChosenDurationsAreRecordedToo) {
  const std::string interval = "{kind: interval, cost_us: [100, 900]}";
  const Outcome seeded = run({"--strategy", "random", "--record-durations", path("a")}, interval);
  const Outcome plain = run({"--strategy", "random"}, interval);
  EXPECT_EQ(seeded.digest(), plain.digest());
  EXPECT_EQ(run({"--strategy", "random", "--replay-durations", path("a")}, interval).digest(), plain.digest());
  EXPECT_NE(run({}, interval).digest(), plain.digest());
}

TEST_F(DurationsTest, ASelfCheckReplaysWhatTheFirstRunMeasured) {
  if (test::is_emulated()) GTEST_SKIP() << "a self-check starts its program anew";
  const Outcome own = run({"--verify"});
  EXPECT_EQ(own.status, 0) << own.output << own.errors;
  EXPECT_NE(own.output.find(" of the first run replayed in the others\n"), std::string::npos) << own.output;
  const Outcome first = run({"--record-durations", path("a")});
  const Outcome given = run({"--verify", "--replay-durations", path("a")});
  EXPECT_EQ(given.status, 0) << given.output << given.errors;
  EXPECT_EQ(given.digest(), first.digest());
}

TEST_F(DurationsTest, ARecordThatDoesNotFitIsOneLineAndStatus2) {
  ASSERT_EQ(run({"--record-durations", path("a")}).errors.find("waitpoint: error"), std::string::npos);
  const auto refused = [&](const Outcome& outcome, const std::string& part) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  };
  refused(run({"--replay-durations", path("a"), "--seed", "2"}), path("a") + ":2: the record of durations is of run");
  refused(run({"--replay-durations", path("a"), "--strategy", "random"}), "is of run");
  refused(run({"--replay-durations", path("a")}, "proportional"), "is of run");
  refused(run({"--replay-durations", path("a")}, "cpu", "4"), "ends early: the run continues after its");
  refused(run({"--replay-durations", path("nothing")}), "cannot be read");
  refused(run({"--replay-durations", path("a"), "--record-durations", path("b")}), "cannot be used together");
  std::string cut = text("a");
  cut.resize(cut.size() / 2);
  std::ofstream(path("cut")) << cut;
  refused(run({"--replay-durations", path("cut")}), "expected");
  cut.resize(cut.rfind('\n') + 1);
  std::ofstream(path("cut")) << cut;
  refused(run({"--replay-durations", path("cut")}), "the record of durations ends early");
  refused(run({"--verify", "--replay-durations", path("cut")}), "the record of durations ends early");
  EXPECT_EQ(run({"--replay-durations", path("a")}, "cpu", "2").status, run({}, "cpu", "2").status) << "a shorter run";
}

}  // namespace
}  // namespace waitpoint::runs
