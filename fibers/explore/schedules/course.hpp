// SPDX-License-Identifier: BSD-3-Clause
// The strategy of one run after the played part: the default order, a drawing strategy, or the default order up to some
// decision and then random.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

struct Course {
  std::string strategy = {};  ///< empty: the default order
  std::uint64_t seed = 0;
  std::uint64_t number = 0;                        ///< of the schedule, or of the random continuation
  std::optional<std::size_t> at_random_from = {};  ///< without a strategy: after this decision the choices are random
  std::span<const Constraint> constraints = {};    ///< see Strategy::hold()
  std::span<const std::uint64_t> progress = {};    ///< Dpor::progress() of the search so far; empty at its beginning
};

/// Its strategy, begun. `explorer`, the run's, and `profile` must outlive it.
std::unique_ptr<Strategy> begin_course(const Course& course, const Explorer& explorer, const Profile& profile);

}  // namespace waitpoint::exploration
