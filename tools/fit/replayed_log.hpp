// SPDX-License-Identifier: BSD-3-Clause
// A log after its replay: the odometry, and the poses that localisation found, at the same scans.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "modules/genom/module_type.hpp"
#include "modules/logs/playing_order.hpp"
#include "modules/logs/sensor_log.hpp"
#include "tools/command/options/log_source.hpp"

namespace waitpoint::tools {

struct ReplayedLog {
  logs::SensorLog log;
  logs::PlayingOrder order;
  // Of the scans that have both poses, in the order of play.
  std::vector<Pose> measured, localised;
  std::vector<std::size_t> scans = {};  ///< their indices in the log
};

/// Nothing after a signal. BadInput as of a replay, and without a module that localises.
std::optional<ReplayedLog> replayed_log(const LogOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
