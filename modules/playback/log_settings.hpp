// SPDX-License-Identifier: BSD-3-Clause
// Settings of modules that follow from a log: the laser's pose, and the units of the base's reports, which are made of
// it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "modules/logs/sensor_log.hpp"

namespace waitpoint::playback {

/// The resolution of the base's reports, per metre and per radian.
inline constexpr double units_per_metre = 1e7, units_per_radian = 1e7;

/// Empty unless this setting of modules of that type follows from a log; else the alternative: "the
/// laser's mount is the log's, or `log: {mount: [x, y, degrees]}` of a scenario".
std::string said_by_log(std::string_view module_type, std::string_view key);

/// Replaces those of the settings of a module that follow from the log.
void set_by_log(std::string_view module_type, const logs::SensorLog& log, std::vector<Setting>& settings);

}  // namespace waitpoint::playback
