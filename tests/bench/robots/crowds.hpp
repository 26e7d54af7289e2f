// SPDX-License-Identifier: BSD-3-Clause
// Scenarios of many robots with all modules of the paper and goals, generated: the same in every run.
#pragma once

#include "modules/scenario/scenario.hpp"

namespace waitpoint::bench {

/// `robots`, a multiple of ten, on floors of the shipped office-10 side by side: they meet those of their own floor
/// only.
scenario::Scenario office_floors(int robots);

/// `robots` on one floor without walls inside, between pillars, about 36 m2 for each: rounds of neighbours overlap.
scenario::Scenario hall(int robots);

/// `robots` in the warehouse of the scan benchmark, 200 x 200 m with 5 000 obstacles, each between the places nearest
/// to its start.
scenario::Scenario warehouse_with(int robots);

}  // namespace waitpoint::bench
