// SPDX-License-Identifier: BSD-3-Clause
// What a self-check runs several times: a scenario in its world, or a log.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/time.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/genom/module_type.hpp"
#include "modules/scenario/scenario.hpp"
#include "tools/replay/log_source.hpp"
#include "tools/replay/replay_options.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

class CheckedRun {
 public:
  virtual ~CheckedRun() = default;
  virtual Simulation& simulation() = 0;
  /// As of Simulation.
  virtual RunEnd run_before(Time until) = 0;
};

struct CheckSubject {
  std::string name;  ///< of the scenario or log
  std::uint64_t seed = 1;
  Time until;
  std::string command;             ///< the check again, for a shell
  const char* of = "run";          ///< the command of waitpoint
  bool json = false;               ///< the verdict as JSON
  bool replays_durations = false;  ///< its runs replay a given record of durations
  std::function<std::unique_ptr<CheckedRun>()> make;
};

/// The arguments must outlive the subject. BadInput for options that a scenario's log does not allow.
CheckSubject subject_of(const RunOptions& options, const scenario::Scenario& scenario,
                        std::span<const genom::ModuleType> types);

/// `command` as of the subject.
CheckSubject subject_of(LogSource source, const PlayOptions& options, const std::string& command,
                        std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
