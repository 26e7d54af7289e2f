// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/quantiles.hpp"

#include <gtest/gtest.h>

namespace waitpoint::tools {
namespace {

bridge::RunResult run_of(std::int64_t seconds) {
  bridge::RunResult result;
  result.simulated = std::chrono::seconds(seconds);
  return result;
}

TEST(Quantiles, AreValuesOfRuns) {
  std::vector<bridge::RunResult> results;
  for (const std::int64_t seconds : {7, 1, 10, 3, 4, 5, 6, 2, 8, 9}) results.push_back(run_of(seconds));
  const std::vector<Quantiles> all = quantiles_of(results);
  ASSERT_EQ(all.back().figure, "simulated_s");
  EXPECT_DOUBLE_EQ(all.back().least, 1);
  EXPECT_DOUBLE_EQ(all.back().tenth, 1);
  EXPECT_DOUBLE_EQ(all.back().median, 5);
  EXPECT_DOUBLE_EQ(all.back().nine_tenths, 9);
  EXPECT_DOUBLE_EQ(all.back().most, 10);
}

TEST(Quantiles, OneRunGivesItsFigures) {
  const std::vector<bridge::RunResult> one{run_of(3)};
  const Quantiles time = quantiles_of(one).back();
  EXPECT_DOUBLE_EQ(time.least, 3);
  EXPECT_DOUBLE_EQ(time.median, 3);
  EXPECT_DOUBLE_EQ(time.most, 3);
}

}  // namespace
}  // namespace waitpoint::tools
