// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/play.hpp"

#include "core/error.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

Outcome play(Body& body, const Token& token, const Profile& profile) {
  if (token.strategy.empty()) {
    Fifo rest;
    return body.run(rest, {.deviations = token.deviations});
  }
  const std::unique_ptr<Strategy> strategy = make_strategy(token.strategy);
  // An exhaustive strategy reaches a schedule only through those before it.
  for (std::uint64_t number = strategy->is_exhaustive() ? 0 : token.number;; ++number) {
    strategy->begin(number, Draws(token.seed, token.strategy, number), profile);
    const Outcome outcome = body.run(*strategy);
    if (number == token.number) return outcome;
    if (!strategy->end())
      throw BadInput("replay", "expected schedule " + std::to_string(token.number) + ", but there are only " +
                                   std::to_string(number + 1));
  }
}

}  // namespace waitpoint::exploration
