// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/exact_math.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t kinds = 3;

/// out.tum with "NAME" -> out.NAME.tum; "" leaves it unchanged.
std::filesystem::path with_part(const std::filesystem::path& path, const std::string& part) {
  if (part.empty()) return path;
  return path.parent_path() / (path.stem().string() + "." + part + path.extension().string());
}

}  // namespace

std::string tum_line(const bridge::DatedPose& at) {
  const auto [sin, cos] = exact::sincos(at.pose.heading / 2);
  return fmt::format("{} {} {} 0 0 0 {} {}\n", to_string(at.date), at.pose.x, at.pose.y, sin, cos);
}

std::vector<std::filesystem::path> trajectory_names(const std::filesystem::path& path,
                                                    std::span<const std::string> robots) {
  std::vector<std::filesystem::path> names;
  for (std::size_t i = 0; i < std::max<std::size_t>(robots.size(), 1); ++i) {
    const std::filesystem::path own = with_part(path, robots.size() > 1 ? robots[i] : "");
    for (const char* const part : {"", "estimated", "odometry"}) names.push_back(with_part(own, part));
  }
  return names;
}

TrajectoryFiles::TrajectoryFiles(const std::filesystem::path& path, std::span<const std::string> robots) {
  const std::vector<std::filesystem::path> names = trajectory_names(path, robots);
  for (std::size_t i = 0; i < robots.size(); ++i) robots_.emplace_back(std::span(names).subspan(i * kinds, kinds));
}

void TrajectoryFiles::finish() {
  for (OfRobot& robot : robots_) robot.finish("");
}

void TrajectoryFiles::cut_off(const std::string& reason) {
  for (OfRobot& robot : robots_) robot.finish("# cut off: " + reason + "\n");
}

TrajectoryFiles::OfRobot::OfRobot(std::span<const std::filesystem::path> names) {
  for (const std::filesystem::path& name : names) files_.emplace_back(name);
}

// An exception here would end a task of the run: a failure is reported at the end.
void TrajectoryFiles::OfRobot::add(bridge::PathKind kind, const bridge::DatedPose& sample) {
  if (failure_ != nullptr) return;
  try {
    file(kind).write(tum_line(sample));
  } catch (...) {
    failure_ = std::current_exception();
  }
}

void TrajectoryFiles::OfRobot::finish(const std::string& end) {
  if (failure_ != nullptr) std::rethrow_exception(failure_);
  for (OutputFile& file : files_) {
    file.write(end);
    file.commit();
  }
}

}  // namespace waitpoint::tools
