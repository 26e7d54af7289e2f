// SPDX-License-Identifier: BSD-3-Clause
// Strategies that learn from earlier schedules: what they find by it, and that their schedules repeat.
#include <gtest/gtest.h>

#include <string>

#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/explore.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "tests/fibers/explore/alternation.hpp"

namespace waitpoint {
namespace {

struct Found {
  std::uint64_t number;
  std::uint64_t digest;
};

// The first schedule of this strategy that fails. No enumeration comes to its help.
Found first_failure(const std::string& name, std::uint64_t seed) {
  exploration::Body body(alternate, nullptr, Time() + std::chrono::hours(1), 100'000);
  exploration::Profile profile;
  (void)exploration::take_profile(body, profile);
  const auto strategy = exploration::make_strategy(name);
  for (std::uint64_t number = 0; number < 10'000; ++number) {
    strategy->begin(number, exploration::Draws(seed, name, number), profile);
    const exploration::RunVerdict outcome = body.run(*strategy);
    if (!outcome.passed()) return {number, outcome.digest};
    (void)strategy->end();
  }
  return {10'000, 0};
}

TEST(Feedback, LeadsStepByStepToARareOrder) {
  std::uint64_t by_pairs = 0, by_states = 0, without = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    by_pairs += first_failure("rff", seed).number;
    by_states += first_failure("goexplore", seed).number;
    without += first_failure("pos", seed).number;
  }
  EXPECT_LT(by_pairs * 2, without);
  EXPECT_LT(by_states * 8, without);
}

TEST(Feedback, ATokenByNumberRepeatsTheSchedulesBefore) {
  std::uint32_t call = 0;
  for (const std::string strategy : {"rff", "goexplore", "portfolio"}) {
    const Found found = first_failure(strategy, 3);
    const exploration::Token token{++call, exploration::token_digest(found.digest), strategy, 3, found.number, {}};
    const ExploreReport again = explore(alternate, {.replay = to_text(token), .minimize = false});
    EXPECT_EQ(again.schedules, 1U);
    EXPECT_NE(again.text.find("they have alternated"), std::string::npos) << again.text;
    EXPECT_EQ(again.text.find("belongs to another run"), std::string::npos) << again.text;
  }
}

}  // namespace
}  // namespace waitpoint
