// SPDX-License-Identifier: BSD-3-Clause
// A plan from text, whose lines count from 3: format and name come before.
#pragma once

#include <string>

#include "modules/plan/plan_reader.hpp"

namespace waitpoint::plan::test {

inline TemporalPlan plan_of(const std::string& text) {
  const bool begins_with_a_line = text.starts_with('\n');
  return read_plan(
      scenario::parse_yaml("format: 1\nname: test" + (begins_with_a_line ? text : "\n" + text), "plan.yaml"));
}

}  // namespace waitpoint::plan::test
