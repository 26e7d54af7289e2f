// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/play.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

RunVerdict play(Body& body, const Token& token, const Profile& profile) {
  if (token.strategy.empty()) {
    Fifo rest;
    return body.run(rest, {.deviations = token.deviations});
  }
  const std::unique_ptr<Strategy> strategy = make_strategy(token.strategy);
  const auto from = [&](std::uint64_t number) { return std::min(strategy->first_learned(number), token.number); };
  for (std::uint64_t number = from(0);; number = from(number + 1)) {
    strategy->begin(number, Draws(token.seed, token.strategy, number), profile);
    const RunVerdict verdict = body.run(*strategy);
    if (number == token.number) return verdict;
    if (!strategy->end())
      throw BadInput("replay", "expected schedule " + std::to_string(token.number) + ", but there are only " +
                                   std::to_string(number + 1));
  }
}

}  // namespace waitpoint::exploration
