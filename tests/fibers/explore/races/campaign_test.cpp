// SPDX-License-Identifier: BSD-3-Clause
// Races beside other failures in a campaign: they do not end it, and rank below. This file is not instrumented; the
// programs beside it are.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "fibers/explore/explore.hpp"
#include "tests/fibers/explore/races/programs.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint::races {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(RacesInACampaign, DoNotHideARarerFailureAndAreReportedOnceEach) {
  testing::internal::CaptureStderr();
  const ExploreReport report = explore(race_and_lose);
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "failed: a check failed in task main")) << report;
  EXPECT_TRUE(contains(report.text, ": an update is lost\n")) << report;
  EXPECT_TRUE(contains(report.text, "1 switch away from the default order fails")) << report;
  EXPECT_TRUE(contains(report.text, "the last choice from which it could still have passed")) << report;
  EXPECT_EQ(report.races.size(), 2U);
  EXPECT_EQ(count(report.text, "also found, by the default order: data race at "), 2U) << report;
  EXPECT_EQ(count(report.text, "\nreplay: WAITPOINT_REPLAY="), 3U) << report;
  EXPECT_EQ(count(lines, "waitpoint: the default order: data race of the write at "), 2U) << lines;
  EXPECT_EQ(count(lines, "\n"), 2U) << lines;
}

TEST(RacesInACampaign, AloneAreAFailureOfTheWholeCampaign) {
  testing::internal::CaptureStderr();
  const ExploreReport report = explore(write_planted, {.iterations = 50});
  EXPECT_TRUE(contains(testing::internal::GetCapturedStderr(), " (waitpoint::races::planted)\n"));
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.schedules, 51U);
  EXPECT_TRUE(contains(report.text, "the default order failed: a data race\ndata race at ")) << report;
  EXPECT_EQ(report.races.size(), 1U);
  EXPECT_FALSE(contains(report.text, "also found")) << report;
}

TEST(RacesInACampaign, EndItIfTheyAreToFail) {
  const ExploreReport report = explore(race_and_lose, {.races = Races::fail});
  EXPECT_EQ(report.schedules, 1U);
  EXPECT_TRUE(contains(report.text, "the default order failed: 2 data races\n")) << report;
  EXPECT_TRUE(report.races.empty());
}

TEST(RacesInACampaign, AreNoFailureIfTheyAreToBeIgnored) {
  EXPECT_TRUE(explore(write_planted, {.iterations = 50, .races = Races::ignore}).passed);
  const ExploreReport report = explore(race_and_lose, {.races = Races::ignore});
  EXPECT_TRUE(contains(report.text, ": an update is lost\n")) << report;
  EXPECT_FALSE(contains(report.text, "data race")) << report;
}

TEST(RacesInACampaign, RankBelowAnExpectationOfTheSameRun) {
  const auto body = [] {
    write_planted();
    EXPECT_EQ(planted, 1) << "bob was last";
  };
  EXPECT_TRUE(contains(explore(body, {.races = Races::fail}).text, "bob was last"));
}

TEST(RacesInACampaign, AreReplayed) {
  testing::internal::CaptureStderr();
  const ExploreReport found = explore(write_planted, {.iterations = 10});
  EXPECT_FALSE(testing::internal::GetCapturedStderr().empty());
  std::string token = found.replay;
  token.replace(0, token.find('.', 4), "wx1.2");  // the next call of this test
  const ExploreReport again = explore(write_planted, {.replay = token});
  EXPECT_TRUE(contains(again.text, "the replayed schedule failed: a data race\n")) << again;
}

TEST(RacesInACampaign, AreGivenByTheEnvironmentToo) {
  setenv("WAITPOINT_RACES", "ignore", 1);
  EXPECT_TRUE(explore(write_planted, {.iterations = 10}).passed);
  setenv("WAITPOINT_RACES", "some", 1);
  EXPECT_EXIT((void)explore(write_planted), testing::ExitedWithCode(2),
              "waitpoint: WAITPOINT_RACES: expected report, fail or ignore, found 'some'");
  unsetenv("WAITPOINT_RACES");
}

}  // namespace
}  // namespace waitpoint::races
