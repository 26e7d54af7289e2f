// SPDX-License-Identifier: BSD-3-Clause
// Rendezvous in the plans of a scenario's robots: each is in two plans.
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// Throws BadInput at a rendezvous whose other robot does not exist or has no rendezvous of that name with this one, or
/// without a medium.
void check_rendezvous(const scenario::Scenario& scenario);

}  // namespace waitpoint::run
