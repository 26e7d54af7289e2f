// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint replay LOG ...` as values. Opens and runs nothing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/playback/playback.hpp"
#include "tools/command/command_line.hpp"

namespace waitpoint::tools {

struct ReplayOptions {
  std::filesystem::path log;
  logs::LogChoice choice;
  std::optional<std::filesystem::path> scenario;  ///< whose first robot has the modules; none: the default ones
  std::vector<std::string> modules;               ///< by name; empty: those that localise
  std::vector<std::string> assignments;           ///< of --set, in their order: "segloc.chi2_match=6"
  std::optional<Duration> until;                  ///< none: the end of the log
  std::optional<playback::PoseSource> pose;       ///< of the trajectory; none: the first that there is
  std::optional<std::filesystem::path> trajectory, relations, summary, picture, digests, events;
};

class ReplayArguments {
 public:
  explicit ReplayArguments(CommandLine& line);
  bool parsed() const { return command_.parsed(); }
  /// Throws BadInput for invalid values.
  ReplayOptions options() const;

 private:
  Command command_;
  std::string log_, scan_, odometry_, robot_, scenario_, modules_, until_, pose_;
  std::string trajectory_, relations_, summary_, picture_, digests_, events_;
  std::vector<std::string> assignments_;
};

}  // namespace waitpoint::tools
