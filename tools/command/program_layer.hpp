// SPDX-License-Identifier: BSD-3-Clause
// Loading of the library in front of the C library that robots' programs need (fibers/posix/in_process/layer.hpp).
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// If the scenario's robots have programs and the library is not loaded, restarts this process with it: the same
/// program and arguments. Must be called first. BadInput if the library cannot be loaded.
void begin_with_program_layer(const scenario::Scenario& scenario);

}  // namespace waitpoint::tools
