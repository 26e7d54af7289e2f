// SPDX-License-Identifier: BSD-3-Clause
// Reads a plan's file. docs/laas-plans.md describes the format, scenarios/office-plan.yaml has an example.
//
//   format: 1
//   name: office round
//   actions:
//     - {name: visit, kind: contingent, duration_s: [5, 40], request: ndd.GoTo, input: {via: [{x: 20, y: 9}]}}
//     - {name: look around, kind: contingent, duration_s: [5, 40], tcl: look_around 20 9, after: visit}
//     - {name: picture, duration_s: [2, 3], request: sick.SegmentsOn, after: visit}
//   constraints:
//     - {name: the light, from: start, to: picture.start, most_s: 60}
#pragma once

#include "modules/plan/plan.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::plan {

/// Throws BadInput with file and line for anything but a plan. Modules, requests and posters are not looked up.
TemporalPlan read_plan(const scenario::YamlNode& document);

/// Seconds as a decimal with at most nine places, exactly. False for anything else, or more than bound_max.
bool parse_seconds(std::string_view text, Duration& duration);

}  // namespace waitpoint::plan
