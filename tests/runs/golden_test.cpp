// SPDX-License-Identifier: BSD-3-Clause
// Runs have the golden digests of tests/golden/digests.txt, on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/project.hpp"
#include "tests/runs/shipped.hpp"

namespace waitpoint::runs {
namespace {

std::map<std::string, std::string> golden_digests() {
  std::ifstream file(test::project_root() / "tests/golden/digests.txt");
  std::map<std::string, std::string> digests;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string scenario, digest;
    if (line.starts_with('#') || !(words >> scenario >> digest)) continue;
    digests[scenario] = digest;
  }
  return digests;
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, FirstSecondsHaveTheGoldenDigest) {
  const std::map<std::string, std::string> golden = golden_digests();
  ASSERT_TRUE(golden.contains(GetParam()));
  EXPECT_EQ(to_string(run(shipped(GetParam())).digest), golden.at(GetParam()))
      << "if the run was meant to change, write its new digest into tests/golden/digests.txt";
}

TEST_P(Golden, SliceEngineGivesTheSameRun) {
  const std::map<std::string, std::string> golden = golden_digests();
  ASSERT_TRUE(golden.contains(GetParam()));
  EXPECT_EQ(to_string(run(shipped(GetParam(), {"world.engine=slice"})).digest), golden.at(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Scenario, Golden,
                         ::testing::Values("office.yaml", "office-10.yaml", "office-one-processor.yaml"),
                         [](const auto& info) {
                           std::string name = info.param.substr(0, info.param.find('.'));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace waitpoint::runs
