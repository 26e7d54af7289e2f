// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/explore/throughput.hpp"

#include "core/error.hpp"
#include "fibers/explore/body.hpp"
#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "tests/bench/explore/body.hpp"

namespace waitpoint::bench {

Speed by_strategy(const std::string& name, double seconds) {
  exploration::Body body(contend, nullptr, Time::max(), 100'000);
  exploration::Profile profile;
  (void)exploration::take_profile(body, profile);
  const auto strategy = exploration::make_strategy(name);
  return carry_on(seconds, Clock::processor, [&](std::uint64_t number) -> Done {
    strategy->begin(number, exploration::Draws(1, name, number), profile);
    const exploration::RunVerdict verdict = body.run(*strategy);
    WAITPOINT_CHECK(verdict.passed(), "a body without bugs fails");
    (void)strategy->end();
    return {body.explorer().steps(), verdict.digest};
  });
}

}  // namespace waitpoint::bench
