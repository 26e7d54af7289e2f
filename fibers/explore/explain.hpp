// SPDX-License-Identifier: BSD-3-Clause
// Why a schedule failed: the last choice from which it could still have passed, and the two events whose order that
// was, with the call stacks of both; and what each task did.
#pragma once

#include <string>

#include "fibers/explore/minimize.hpp"

namespace waitpoint::exploration {

/// In words, some lines; empty where no single choice decides. At most `runs_max` runs of `body`.
std::string explain(Body& body, const Failure& failure, std::uint64_t runs_max);

}  // namespace waitpoint::exploration
