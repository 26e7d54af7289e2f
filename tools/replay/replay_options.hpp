// SPDX-License-Identifier: BSD-3-Clause
// The options of `waitpoint play LOG ...` as values. Opens and runs nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/kernel/chooser.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/playback/playback.hpp"
#include "tools/command/options/log_source.hpp"
#include "tools/command/options/results.hpp"

namespace waitpoint::tools {

/// How a log is played, and what is written.
struct PlayOptions {
  std::uint64_t seed = 1;
  kernel::Order order = kernel::Order::fifo;
  std::optional<Duration> until;             ///< none: as of the log's source
  bool json = false;                         ///< the result as JSON to standard output
  const char* command = "play";              ///< of waitpoint, for it
  std::string replay;                        ///< the command line that repeats it, for a shell
  std::optional<playback::PoseSource> pose;  ///< of the trajectory; none: the first that there is
  std::optional<std::filesystem::path> trajectory, relations, summary, picture, map, digests, events;

  SimulationOptions simulation() const;
};

struct ReplayOptions {
  LogOptions source;
  PlayOptions play;
  bool verify = false;  ///< compare runs instead of reporting a result
  std::string command;  ///< as given, for a shell
};

/// The command with its options.
void declare(Command& command, ReplayOptions& options);

}  // namespace waitpoint::tools
