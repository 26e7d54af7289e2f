// SPDX-License-Identifier: BSD-3-Clause
// Reads a scenario file. docs/scenario.md describes the format, scenarios/ has examples.
//
//   format: 1
//   name: office
//   expect: {goals_reached: all, collisions: 0}
//   until_s: 900
//   world: {step_ms: 10, include: office-floor.yaml, shapes: [...], map: {file: x.yaml, height_m: 2}}
//   robot_types: {rackham: {shape: ..., base: ..., lasers: [...], modules: [...], bridge: [...]}}
//   robots: [{name: rackham, type: rackham, start: [x, y, heading_deg], goals: [[x, y], ...]}]
//
// or with `log: FILE` in place of the world (log_reader.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/scenario/scenario.hpp"

namespace waitpoint::scenario {

/// Reads the file with the options `--set key=value` (given without "--set ") applied. Throws BadInput with file and
/// line, or with the option if the value comes from one. Scripts read and write files below the scenario's folder, and
/// below the folders of `--allow` in `allowed`.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& assignments = {},
                       const std::vector<std::string>& allowed = {});

}  // namespace waitpoint::scenario
