// SPDX-License-Identifier: BSD-3-Clause
// A recording of a run for viewers: `--record FILE.mcap` for Foxglove, `--record FILE.bag` for ROS 1,
// `--record FILE.log` for CARMEN's tools.
//
// A recording reads the world and the robots' posters after each step of the world. Reading is not an event: a run is
// the same with and without recording, and equal runs give equal bytes.
#pragma once

#include <exception>
#include <filesystem>

#include "modules/run/experiment.hpp"

namespace waitpoint::tools {

class Recording {
 public:
  virtual ~Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  /// Call before the run; the recording must outlive it. The scenario is the experiment's.
  virtual void begin(run::Experiment& experiment) = 0;
  /// Call after a step of the world, at `now`. Does not throw, as exceptions would pass through the world's task:
  /// finish() reports failures.
  void observe(const run::Experiment& experiment, Time now);
  /// Call after the run: renames the file into place. Throws BadInput if it could not be written.
  void finish(const bridge::RunResult& result);

 protected:
  explicit Recording(std::filesystem::path path) : path_(std::move(path)) {}

 private:
  virtual void record(const run::Experiment& experiment, Time now) = 0;
  virtual void commit(const bridge::RunResult& result) = 0;

  std::filesystem::path path_;  ///< for messages
  std::exception_ptr failure_;
};

}  // namespace waitpoint::tools
