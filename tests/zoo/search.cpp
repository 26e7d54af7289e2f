// SPDX-License-Identifier: BSD-3-Clause
#include "tests/zoo/search.hpp"

#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::zoo {

Search::Search(void (*function)())
    : body_(function, nullptr, ExploreOptions().until, ExploreOptions().steps_max),
      usual_(exploration::take_profile(body_, profile_)) {}

std::optional<Found> Search::find(const std::string& strategy, std::uint64_t seed, std::uint64_t most) {
  const auto tried = exploration::make_strategy(strategy);
  for (std::uint64_t number = 0; number < most; ++number) {
    tried->begin(number, exploration::Draws(seed, strategy, number), profile_);
    const exploration::Outcome outcome = body_.run(*tried);
    if (!outcome.passed()) return Found{number + 1, {body_.explorer().schedule(), outcome}};
    if (!tried->end()) return std::nullopt;
  }
  return std::nullopt;
}

exploration::Outcome Search::play(const exploration::Token& token) {
  if (token.strategy.empty()) {
    exploration::Fifo rest;
    return body_.run(rest, {.deviations = token.deviations});
  }
  const auto strategy = exploration::make_strategy(token.strategy);
  strategy->begin(token.number, exploration::Draws(token.seed, token.strategy, token.number), profile_);
  return body_.run(*strategy);
}

}  // namespace waitpoint::zoo
