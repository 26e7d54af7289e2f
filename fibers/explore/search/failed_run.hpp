// SPDX-License-Identifier: BSD-3-Clause
// A run of a search that failed, or raced, and how to repeat it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/schedules/token.hpp"
#include "fibers/explore/target/explore_options.hpp"
#include "fibers/explore/target/finding.hpp"
#include "fibers/explore/target/plan.hpp"

namespace waitpoint::exploration {

struct FailedRun {
  std::optional<std::uint64_t> number;  ///< of its schedule; none: the default order
  Finding finding;
  Constraints constraints = {};       ///< those of its plan
  const char* enumeration = nullptr;  ///< the exhaustive strategy, a literal, that has tried it after draws; null: none
  bool is_of_analysis = false;        ///< of another failure: its schedule has no number

  /// The name of the strategy that has drawn it or tried it.
  std::string strategy(const ExploreOptions& options) const {
    return enumeration == nullptr ? options.strategy : enumeration;
  }
};

/// "schedule 2 of strategy portfolio, seed 1"; "the default order".
std::string name_of(const FailedRun& run, const ExploreOptions& options);
Plan plan_of(const FailedRun& run, const ExploreOptions& options);
/// `call`: of a body, the number of the call of explore().
Token token_of(const FailedRun& run, const ExploreOptions& options, std::uint32_t call = 0);
/// The token of a run by its deviations from the default order.
Token token_by_deviations(const Finding& finding, const ExploreOptions& options, std::uint32_t call = 0);

/// True if a search goes on after such a failure, to one of a graver kind. `reports_races`: by Races::report.
inline bool goes_on_after(RunVerdict::Kind kind, bool reports_races) {
  return kind == RunVerdict::Kind::misuse || (kind == RunVerdict::Kind::race && reports_races);
}

}  // namespace waitpoint::exploration
