// SPDX-License-Identifier: BSD-3-Clause
// What robots' programs stand on in this process: a library in front of the C library (fibers/posix/guests/guests.hpp).
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::tools {

/// If robots of the scenario have programs, and the library is not here, this process begins anew with it: the same
/// program, with the same arguments. To be called before anything else is done. BadInput where that cannot be.
void begin_with_program_layer(const bridge::Scenario& scenario);

}  // namespace waitpoint::tools
