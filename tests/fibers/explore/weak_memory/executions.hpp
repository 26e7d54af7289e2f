// SPDX-License-Identifier: BSD-3-Clause
// The outcomes of a litmus test by the axioms.
#pragma once

#include "tests/fibers/explore/weak_memory/litmus.hpp"

namespace waitpoint::weak_memory {

/// All that the standard allows.
Outcomes allowed(const Litmus& litmus);

/// Of these, those of executions with an order of execution: all loads read stores before them, and the modification
/// orders and S follow it.
Outcomes executable(const Litmus& litmus);

}  // namespace waitpoint::weak_memory
