// SPDX-License-Identifier: BSD-3-Clause
// The results that a scenario expects of its run.
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

const Keys<Expectation>& expectation_table();
Expectation read_expectation(const YamlNode& node);

}  // namespace waitpoint::scenario
