// SPDX-License-Identifier: BSD-3-Clause
// The code whose accesses to shared memory are switch points: learned in runs before the search, or a replay.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fibers/explore/target/plan.hpp"
#include "tools/exec/program_process.hpp"
#include "tools/explore/runs/finding.hpp"

namespace waitpoint::tools {

/// `learn` executes a run by the plan, with the code known so far, which learns more. Instrumented programs report all
/// accesses, so that one run in the default order is enough; of others only the learned code will be watched: more
/// learning runs follow in random orders, the fewer the longer a run is. Instructions with the same operands are
/// learned with them.
std::vector<std::uint64_t> learn_code(
    const ProgramFiles& files,
    const std::function<Finding(const Plan& plan, const std::vector<std::uint64_t>& known)>& learn);

}  // namespace waitpoint::tools
