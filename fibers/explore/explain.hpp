// SPDX-License-Identifier: BSD-3-Clause
// Why a schedule failed: the last choice from which it could still have passed, and the two events whose order that
// was, with the call stacks of both; and what each task did.
#pragma once

#include <string>

#include "fibers/explore/minimize.hpp"

namespace waitpoint::exploration {

/// The same failure with the places in the source where tasks are, which takes a second.
Failure with_places(Body& body, const Failure& failure);

/// In words, some lines: how many switches it has, and which of them are none between tasks; the last choice from which
/// it could still have passed, where one was found with that effort; and the last events.
std::string explain(Body& body, const Failure& failure, Effort effort);

}  // namespace waitpoint::exploration
