// SPDX-License-Identifier: BSD-3-Clause
#include "tests/zoo/search.hpp"

#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::zoo {

Search::Search(void (*function)())
    : body_(function, nullptr, ExploreOptions().until, ExploreOptions().steps_max),
      usual_(exploration::take_profile(body_, profile_)) {}

std::optional<Found> Search::find(const std::string& strategy, std::uint64_t seed, std::uint64_t most) {
  const auto tried = exploration::make_strategy(strategy);
  for (std::uint64_t number = 0; number < most; ++number) {
    tried->begin(number, exploration::Draws(seed, strategy, number), profile_);
    const exploration::RunVerdict verdict = body_.run(*tried);
    if (!verdict.passed()) return Found{number + 1, body_.finding_of(verdict)};
    if (!tried->end()) return std::nullopt;
  }
  return std::nullopt;
}

std::uint64_t Search::failures(const std::string& strategy, std::uint64_t seed, std::uint64_t count) {
  const auto drawn = exploration::make_strategy(strategy);
  std::uint64_t failed = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    drawn->begin(number, exploration::Draws(seed, strategy, number), profile_);
    failed += !body_.run(*drawn).passed();
  }
  return failed;
}

}  // namespace waitpoint::zoo
