// SPDX-License-Identifier: BSD-3-Clause
// A recording of a run for viewers: `--record FILE.mcap` for Foxglove, `--record FILE.bag` for ROS 1,
// `--record FILE.log` for CARMEN's tools.
//
// A recording is made from what is read after each step of the world (news_reader.hpp). Equal runs give equal bytes.
#pragma once

#include <exception>
#include <filesystem>
#include <map>

#include "modules/bridge/run_result.hpp"
#include "tools/record/step_news.hpp"

namespace waitpoint::tools {

class Recording {
 public:
  virtual ~Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  /// True if it wants StepNews::obstacles.
  virtual bool shows_obstacles() const = 0;
  /// The next step, with the news of all robots in the scenario's order. Does not throw, as exceptions would pass
  /// through the world's task: finish() reports failures.
  void add(StepNews step);
  /// Lines since the last step, which are recorded with the next one, or at the end.
  void hold(const std::vector<RobotLines>& lines);
  /// Call after the run: renames the file into place. Throws BadInput if it could not be written.
  void finish(const bridge::RunResult& result);

 protected:
  explicit Recording(std::filesystem::path path) : path_(std::move(path)) {}

 private:
  virtual void record(const StepNews& step) = 0;
  /// `last` is a step with nothing but lines.
  virtual void commit(const StepNews& last, const bridge::RunResult& result) = 0;

  std::filesystem::path path_;  ///< for messages
  std::exception_ptr failure_;
  std::map<std::uint32_t, std::vector<ModuleLog::Line>> held_;  // by robot
};

}  // namespace waitpoint::tools
