// SPDX-License-Identifier: BSD-3-Clause
// Why a schedule failed: the last choice from which it could still have passed, and the two events whose order that
// was, with the call stacks of both; and what each task did.
#pragma once

#include <string>

#include "fibers/explore/minimize.hpp"

namespace waitpoint::exploration {

/// In words, some lines; empty where no single choice decides, or none was found with that effort.
std::string explain(Body& body, const Failure& failure, Effort effort);

}  // namespace waitpoint::exploration
