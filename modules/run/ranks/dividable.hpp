// SPDX-License-Identifier: BSD-3-Clause
// Features that a scenario of several ranks must not have.
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// BadInput for clocks that are measured, with which no run is equal to another, and for programs that are shared
/// objects, whose library takes the place of the system's threads in the whole process, of those of MPI, too; and for a
/// log in place of a world.
void check_dividable(const scenario::Scenario& scenario);

}  // namespace waitpoint::run
