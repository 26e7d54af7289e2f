// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/recording.hpp"

#include <utility>

#include "core/error.hpp"

namespace waitpoint::tools {

void Recording::add(StepNews step) {
  if (failure_ != nullptr) return;
  try {
    for (RobotNews& robot : step.robots)
      if (const auto held = held_.find(robot.robot); held != held_.end())
        robot.lines.insert(robot.lines.begin(), held->second.begin(), held->second.end());
    held_.clear();
    record(step);
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void Recording::hold(const std::vector<RobotLines>& lines) {
  for (const RobotLines& of_robot : lines) {
    std::vector<ModuleLog::Line>& held = held_[of_robot.robot];
    held.insert(held.end(), of_robot.lines.begin(), of_robot.lines.end());
  }
}

void Recording::finish(const bridge::RunResult& result) {
  StepNews last{.now = Time() + result.simulated};
  for (auto& [robot, lines] : held_) last.robots.push_back({.robot = robot, .lines = std::move(lines)});
  // A library's own exceptions, too, mean that the file cannot be written.
  try {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
    commit(last, result);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& failure) {
    throw BadInput(path_.string(), std::string("cannot be written: ") + failure.what());
  }
}

}  // namespace waitpoint::tools
