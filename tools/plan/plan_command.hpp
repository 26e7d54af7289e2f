// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint plan FILE`: what is known of a temporal plan before it is executed.
#pragma once

#include <filesystem>
#include <string>

#include "modules/plan/plan.hpp"
#include "tools/command/options/results.hpp"

namespace waitpoint::tools {

struct PlanOptions {
  std::filesystem::path file;
  OptionalFile picture;
  bool json = false;  ///< the result as JSON to standard output
};

/// The command with its options.
void declare(Command& command, PlanOptions& options);

/// Prints the verdict and the windows of the actions of the first branches; returns the exit status. Throws BadInput
/// for a plan that is not consistent.
int show_plan(const PlanOptions& options);

/// A row for each action: the times in which it can be, and within them its least duration from its earliest start.
std::string plan_picture(const plan::TemporalPlan& plan);

}  // namespace waitpoint::tools
