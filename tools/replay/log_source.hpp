// SPDX-License-Identifier: BSD-3-Clause
// A log, the choice of its records, and the robot whose modules it drives: by options, or by a scenario with a log.
#pragma once

#include <filesystem>
#include <optional>

#include "core/time.hpp"
#include "modules/logs/given_laser.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/command/options/log_source.hpp"

namespace waitpoint::tools {

struct LogSource {
  std::filesystem::path file;
  logs::LogChoice choice;
  logs::GivenLaser laser;
  std::optional<Duration> until;  ///< the scenario's limit; none: the end of the log
  scenario::RobotScenario robot;

  /// The end of a run, for a limit that an option may give.
  Time end(std::optional<Duration> given) const;
  /// BadInput as of logs::read_log().
  logs::SensorLog read() const;
};

/// Of a scenario with a log: the robot has the modules that it lists, or else those that localise.
LogSource log_source(const scenario::Scenario& scenario);

/// The modules that the options name, with the parameters of their scenario and of --set. If that scenario has a log,
/// all but its file applies where the options do not say otherwise. BadInput for names that are not among the modules.
LogSource log_source(const LogOptions& options);

}  // namespace waitpoint::tools
