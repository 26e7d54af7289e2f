// SPDX-License-Identifier: BSD-3-Clause
// The log of a scenario that has one in place of a world:
//
//   log: intel_lab.clf.gz
//   log: {file: run.bag, scan: /scan, odometry: /odom, field_of_view_deg: 180, mount: [0.1, 0, 0], range_max_m: 30}
#pragma once

#include "modules/scenario/keys.hpp"
#include "modules/scenario/scenario.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

/// What the log's map has beside its choice of records.
const Keys<logs::GivenLaser>& log_keys();
/// Does not open the log. Throws BadInput with the line for values out of range.
LogFile read_log(const YamlNode& node);

/// Throws BadInput if a scenario without a world has the key `log` with nothing behind it.
void check_log_is_named(const YamlMap& scenario);

/// Throws BadInput for the first key of a scenario with a log that needs a world.
void check_beside_log(const YamlMap& scenario);

/// Reads `robots`: the one whose modules the log drives. It has no start and no body but that of its type.
RobotScenario read_robot_of_log(const YamlNode& list, const YamlNode* types);

}  // namespace waitpoint::scenario
