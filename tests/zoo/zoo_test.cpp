// SPDX-License-Identifier: BSD-3-Clause
// Each specimen has its stated properties, and exploration finds, minimises and repeats its failure.
#include "tests/zoo/zoo.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "fibers/explore/campaign.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "tests/zoo/search.hpp"

namespace waitpoint::zoo {
namespace {

using exploration::Campaign;
using exploration::Outcome;

constexpr std::uint64_t schedules_max = 10'000;
constexpr std::uint64_t runs_to_minimize = 5'000;
constexpr std::uint64_t seeds[] = {101, 102};

TEST(Zoo, HasAtLeastThirtySpecimensOfManyKinds) {
  std::set<std::string> kinds, names;
  for (const Specimen& specimen : specimens()) {
    kinds.insert(specimen.kind);
    EXPECT_TRUE(names.insert(specimen.name).second) << specimen.name;
  }
  EXPECT_GE(specimens().size(), 30u);
  EXPECT_GE(kinds.size(), 6u);
}

TEST(Zoo, PassesInTheDefaultOrder) {
  for (const Specimen& specimen : specimens()) {
    EXPECT_EQ(Search(specimen.buggy).usual().failure, "") << specimen.name;
    EXPECT_EQ(Search(specimen.correct).usual().failure, "") << specimen.name;
  }
}

TEST(Zoo, NoCorrectTwinIsReported) {
  for (const Specimen& specimen : specimens()) {
    const auto found = Search(specimen.correct).find("portfolio", seeds[0], 2'000);
    EXPECT_FALSE(found) << specimen.name << ": " << found->failure.outcome.failure;
  }
}

// For nine of ten, at most one switch more than the minimum. Most others have many tasks: so few runs do not try all
// single switches. The rest need more than two, which are not searched exhaustively.
TEST(Zoo, ThePortfolioFindsEachAndItIsCutShort) {
  std::uint32_t failures = 0, longer = 0;
  for (const Specimen& specimen : specimens()) {
    if (specimen.is_rare) continue;
    Search search(specimen.buggy);
    for (const std::uint64_t seed : seeds) {
      const auto found = search.find("portfolio", seed, schedules_max);
      EXPECT_TRUE(found) << specimen.name << ", seed " << seed;
      if (!found) continue;
      const auto least = exploration::minimize(search.body(), found->failure, {runs_to_minimize});
      EXPECT_TRUE(exploration::is_same_failure(least.outcome, found->failure.outcome)) << specimen.name;
      const std::size_t switches = least.schedule.switches.size();
      ++failures;
      longer += switches > specimen.switches + 1;
      EXPECT_GE(switches, specimen.switches) << specimen.name << " needs fewer than it says";
    }
  }
  EXPECT_LE(longer * 10, failures);
}

TEST(Zoo, RecordedChoicesRepeatTheFailure) {
  exploration::Fifo rest;
  for (const Specimen& specimen : specimens()) {
    if (specimen.is_rare) continue;
    Search search(specimen.buggy);
    const auto found = search.find("portfolio", seeds[0], schedules_max);
    ASSERT_TRUE(found) << specimen.name;
    const auto deviations = found->failure.schedule.deviations();
    const Outcome again = search.body().run(rest, {.deviations = deviations});
    EXPECT_EQ(again.digest, found->failure.outcome.digest) << specimen.name;
    EXPECT_EQ(again.failure, found->failure.outcome.failure) << specimen.name;
  }
}

// Replays the token in a separate campaign; only for some, as each failure is explained.
TEST(Zoo, ATokenRepeatsTheFailure) {
  constexpr std::size_t every = 6;
  for (std::size_t i = 0; i < specimens().size(); i += every) {
    const Specimen& specimen = specimens()[i];
    if (specimen.is_rare) continue;
    const auto found = Search(specimen.buggy).find("portfolio", seeds[0], schedules_max);
    ASSERT_TRUE(found) << specimen.name;
    const std::uint32_t digest = exploration::token_digest(found->failure.outcome.digest);
    ExploreOptions options;
    options.minimize = false;
    Campaign campaign(nullptr, specimen.buggy, options, 1);
    const ExploreReport report = campaign.replay({1, digest, "portfolio", seeds[0], found->schedules - 1, {}});
    EXPECT_FALSE(report.passed) << specimen.name;
    EXPECT_EQ(report.text.find("belongs to another run"), std::string::npos) << specimen.name << ": " << report.text;
    const std::string& failure = found->failure.outcome.failure;
    EXPECT_NE(report.text.find(failure.substr(0, failure.find('\n'))), std::string::npos) << specimen.name;
  }
}

}  // namespace
}  // namespace waitpoint::zoo
