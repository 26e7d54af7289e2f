// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/trajectory.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint::tools {
namespace {

/// out.tum with "NAME" -> out.NAME.tum; "" leaves it unchanged.
std::filesystem::path with_part(const std::filesystem::path& path, const std::string& part) {
  if (part.empty()) return path;
  return path.parent_path() / (path.stem().string() + "." + part + path.extension().string());
}

void write_whole(OutputFile& file, std::span<const bridge::DatedPose> path, const std::string& end) {
  file.write(tum_text(path));
  file.write(end);
  file.commit();
}

}  // namespace

std::string tum_text(std::span<const bridge::DatedPose> path) {
  std::string text;
  for (const bridge::DatedPose& at : path) {
    const auto [sin, cos] = exact::sincos(at.pose.heading / 2);
    text += fmt::format("{} {} {} 0 0 0 {} {}\n", to_string(at.date), at.pose.x, at.pose.y, sin, cos);
  }
  return text;
}

TrajectoryFiles::TrajectoryFiles(const std::filesystem::path& path, std::span<const std::string> robots) {
  for (const std::string& robot : robots) {
    const std::filesystem::path own = with_part(path, robots.size() > 1 ? robot : "");
    robots_.push_back(
        {OutputFile(own), OutputFile(with_part(own, "estimated")), OutputFile(with_part(own, "odometry"))});
  }
}

void TrajectoryFiles::write(const bridge::RunResult& result) {
  WAITPOINT_CHECK(result.robots.size() == robots_.size(), "a run ended with other robots than it began with");
  const std::string end = result.outcome == bridge::Outcome::crashed ? "# cut off: " + result.trouble + "\n" : "";
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    write_whole(robots_[i].truth, result.robots[i].true_path, end);
    write_whole(robots_[i].estimate, result.robots[i].estimated_path, end);
    write_whole(robots_[i].odometry, result.robots[i].odometry_path, end);
  }
}

}  // namespace waitpoint::tools
