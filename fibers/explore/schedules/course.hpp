// SPDX-License-Identifier: BSD-3-Clause
// By which strategy one run goes on where nothing is played: the default order, one that draws the schedule, or the
// default order up to some decision and then any.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

struct Course {
  std::string strategy = {};  ///< empty: the default order
  std::uint64_t seed = 0;
  std::uint64_t number = 0;  ///< of the schedule, or of the random continuation
  std::optional<std::size_t> at_random_from =
      {};  ///< without a strategy: behind this decision any alternative is taken
};

/// Its strategy, begun. `explorer` is the run's, and must outlive it, as must the profile.
std::unique_ptr<Strategy> begin_course(const Course& course, const Explorer& explorer, const Profile& profile);

}  // namespace waitpoint::exploration
