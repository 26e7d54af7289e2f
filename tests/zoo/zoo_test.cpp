// SPDX-License-Identifier: BSD-3-Clause
// Each specimen has its stated properties, and exploration finds, minimises and repeats its failure.
#include "tests/zoo/zoo.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "fibers/explore/analysis/fewer_switches.hpp"
#include "fibers/explore/campaign.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "tests/zoo/search.hpp"

namespace waitpoint::zoo {
namespace {

using exploration::Campaign;
using exploration::RunVerdict;

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
    EXPECT_TRUE(Search(specimen.buggy).usual().passed()) << specimen.name;
    EXPECT_TRUE(Search(specimen.correct).usual().passed()) << specimen.name;
  }
}

TEST(Zoo, NoCorrectTwinIsReported) {
  for (const Specimen& specimen : specimens()) {
    const auto found = Search(specimen.correct).find("portfolio", seeds[0], 2'000);
    EXPECT_FALSE(found) << specimen.name << ": " << found->failure.words;
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
      exploration::BodyTarget target(search.body(), "", runs_to_minimize, 0);
      exploration::Trials trials(target, nullptr, target.traits().to_minimize);
      exploration::FewerSwitches fewer(trials, 0, found->failure);
      fewer.run();
      EXPECT_TRUE(exploration::is_same_failure(fewer.least(), found->failure)) << specimen.name;
      const std::size_t switches = fewer.least().switches.size();
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
    const RunVerdict again = search.body().run(rest, {.deviations = found->failure.deviations});
    EXPECT_EQ(again.digest, found->failure.digest) << specimen.name;
    EXPECT_EQ(search.body().failure(), found->failure.words) << specimen.name;
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
    const std::uint32_t digest = exploration::token_digest(found->failure.digest);
    ExploreOptions options;
    options.minimize = false;
    Campaign campaign(nullptr, specimen.buggy, options, 1);
    const ExploreReport report = campaign.replay({1, digest, "portfolio", seeds[0], found->schedules - 1, {}});
    EXPECT_FALSE(report.passed) << specimen.name;
    EXPECT_EQ(report.text.find("belongs to another run"), std::string::npos) << specimen.name << ": " << report.text;
    const std::string& failure = found->failure.words;
    EXPECT_NE(report.text.find(failure.substr(0, failure.find('\n'))), std::string::npos) << specimen.name;
  }
}

}  // namespace
}  // namespace waitpoint::zoo
