// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/explore.hpp"

#include <mutex>

#include "core/error.hpp"
#include "fibers/explore/campaign.hpp"
#include "fibers/explore/environment.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint {
namespace {

// Numbers the calls within a test, or a program without tests: a token stores this number.
std::uint32_t count_call(const std::string& test) {
  static std::string last;
  static std::uint32_t calls = 0;
  if (test != last) calls = 0;
  last = test;
  return ++calls;
}

void check_can_be_meant(const ExploreOptions& options) {
  (void)exploration::make_strategy(options.strategy);
  if (options.iterations == 0) throw BadInput("iterations", "expected a positive whole number, found 0");
  if (!(options.time_limit_s >= 0))
    throw BadInput("time_limit_s", "expected seconds, or 0 for none, found " + std::to_string(options.time_limit_s));
  if (options.memory == Memory::weak && !races::present())
    throw BadInput("memory",
                   "expected a program linked with waitpoint-races, for code compiled with -fsanitize=thread");
}

ExploreReport explore_call(exploration::ExternalChecks* checks, std::function<void()> body, ExploreOptions options) {
  const std::uint32_t call = count_call(checks != nullptr ? checks->name() : "");
  exploration::Token token;
  if (!options.replay.empty()) {
    token = exploration::read_token(options.replay);
    options.memory = token.memory;
  }
  check_can_be_meant(options);  // before the first run
  if (options.replay.empty()) return exploration::Campaign(checks, std::move(body), options, call).run();
  if (token.call == 0)
    throw BadInput("replay", "expected a test's token, found a scenario's: '" + options.replay + "'");
  if (token.call == call) {
    exploration::mark_replay_reached();
    return exploration::Campaign(checks, std::move(body), options, call).replay(token);
  }
  options.iterations = 0;  // the token is for a later call: this one runs nothing
  return exploration::Campaign(checks, std::move(body), options, call).run();
}

}  // namespace

ExploreReport explore_with(exploration::ExternalChecks* checks, std::function<void()> body,
                           const ExploreOptions& asked) {
  WAITPOINT_REQUIRE(kernel::running == nullptr, "explore() is called from within a simulated run");
  // The supervisor, the race detector and the numbers of the calls are the process's.
  static std::recursive_mutex one_thread_explores;
  const std::lock_guard turn(one_thread_explores);
  try {
    return explore_call(checks, std::move(body), exploration::with_environment(asked));
  } catch (const BadInput& input) {
    exploration::refuse_environment(input);
    throw;
  }
}

}  // namespace waitpoint
