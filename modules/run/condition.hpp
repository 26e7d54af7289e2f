// SPDX-License-Identifier: BSD-3-Clause
// Breakpoints of a run: comparisons of a robot's figure with a number.
//
//   rackham.goals >= 2      figures: goals (reached), collisions, travelled_m, x_m, y_m, stalled (0 or 1)
//   rackham.x_m < 12.5      comparisons: < <= == >= >
#pragma once

#include <functional>
#include <string_view>

#include "modules/run/experiment.hpp"
#include "modules/scenario/location.hpp"

namespace waitpoint::run {

/// True if the condition holds now. Evaluation changes nothing and may follow every event.
using Condition = std::function<bool()>;

/// Throws BadInput at `written` for a malformed condition or an unknown robot or figure. The experiment must outlive
/// the condition.
Condition parse_condition(std::string_view text, const Experiment& experiment, const scenario::Location& written);

}  // namespace waitpoint::run
