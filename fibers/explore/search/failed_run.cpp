// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/search/failed_run.hpp"

#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::exploration {
namespace {

// The default order has no number, and exhaustive strategies draw nothing.
bool is_drawn(const FailedRun& run, const ExploreOptions& options) {
  return run.number && !make_strategy(run.strategy(options))->is_exhaustive();
}

}  // namespace

std::string name_of(const FailedRun& run, const ExploreOptions& options) {
  if (run.is_of_analysis) return "a run of the analysis";
  if (!run.number) return "the default order";
  return "schedule " + std::to_string(*run.number) + " of strategy " + run.strategy(options) + ", seed " +
         std::to_string(options.seed);
}

Plan plan_of(const FailedRun& run, const ExploreOptions& options) {
  if (is_drawn(run, options)) return {.number = *run.number, .constraints = run.constraints};
  return {.drawn = false, .switches = {}, .deviations = run.finding.deviations};
}

Token token_of(const FailedRun& run, const ExploreOptions& options, std::uint32_t call) {
  if (!is_drawn(run, options)) return token_by_deviations(run.finding, options, call);
  const std::uint32_t digest = token_digest(run.finding.digest);
  return {call, digest, options.strategy, options.seed, *run.number, {}, {}, options.memory};
}

Token token_by_deviations(const Finding& finding, const ExploreOptions& options, std::uint32_t call) {
  return {call, token_digest(finding.digest), "", 0, 0, finding.deviations, {}, options.memory};
}

}  // namespace waitpoint::exploration
