// SPDX-License-Identifier: BSD-3-Clause
// The key `control`: of a robot, and of the scenario for all robots.
#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

class ControlReader : public ::testing::Test {
 protected:
  Scenario read(const std::vector<std::string>& assignments) const {
    return read_scenario(folder_.write("s.yaml", valid_scenario), assignments);
  }
  TemporaryFolder folder_;
};

TEST_F(ControlReader, RulesOfARobotPrecedeThoseOfTheScenario) {
  const std::string all = folder_.write("all.ctl", "# all").string(), own = folder_.write("own.ctl", "# own").string();
  EXPECT_FALSE(read({}).robots[0].control);
  const Scenario scenario =
      read({"control=" + all, "robots.two.control={rules: " + own + ", priority: 7, clock: {kind: fixed}}"});
  ASSERT_TRUE(scenario.robots[0].control && scenario.robots[1].control);
  EXPECT_EQ(scenario.robots[0].control->rules, "# all");
  EXPECT_EQ(scenario.robots[0].control->file, all);
  EXPECT_EQ(scenario.robots[1].control->rules, "# own");
  ASSERT_EQ(scenario.robots[1].control->settings.size(), 2U);
  EXPECT_EQ(scenario.robots[1].control->settings[1].key, "clock.kind");
}

TEST_F(ControlReader, RulesArePartOfTheFingerprint) {
  const auto fingerprint = [this](const std::string& rules) {
    return read({"control=" + folder_.write("r.ctl", rules).string()}).fingerprint;
  };
  EXPECT_EQ(fingerprint("# one"), fingerprint("# one"));
  EXPECT_NE(fingerprint("# one"), fingerprint("# two"));
}

TEST_F(ControlReader, RefusesAMapWithoutRulesAndAMissingFile) {
  EXPECT_EQ(message_of<BadInput>([&] { read({"control={priority: 1}"}); }),
            "--set control={priority: 1}: expected key 'rules' in control");
  EXPECT_NE(message_of<BadInput>([&] { read({"control=no.ctl"}); }).find("no.ctl"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::scenario
