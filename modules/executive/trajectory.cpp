// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::executive {
namespace {

constexpr double metres_max = 1e5, seconds_max = 86400, late_s_max = 1;
constexpr const char* blanks = " \t\r";

/// stamp x y z qx qy qz qw
using Words = std::array<double, 8>;

/// The numbers of a line without its comment; nothing if they are not eight, or of no pose in the plane.
std::optional<Words> numbers_of(std::string_view line) {
  Words words{};
  std::size_t count = 0;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != line.npos; ++count) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    if (count == words.size() || !parse_number(line.substr(begin, end - begin), words[count])) return std::nullopt;
    begin = line.find_first_not_of(blanks, end);
  }
  if (count != words.size()) return std::nullopt;
  constexpr double unit_tolerance = 1e-2;
  double norm = 0;
  for (std::size_t i = 4; i < 8; ++i) norm += words[i] * words[i];
  const bool is_near = std::fabs(words[1]) <= metres_max && std::fabs(words[2]) <= metres_max;
  return is_near && std::fabs(norm - 1) < unit_tolerance ? std::optional(words) : std::nullopt;
}

Pose pose_of(const Words& words) {
  const double qx = words[4], qy = words[5], qz = words[6], qw = words[7];
  return {words[1], words[2], exact::atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))};
}

}  // namespace

Trajectory::Trajectory(std::string_view text, const std::string& file) {
  std::optional<double> first_s;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view whole = text.substr(begin, end - begin), line = whole.substr(0, whole.find('#'));
    begin = end + 1;
    if (line.find_first_not_of(blanks) == line.npos) continue;
    const auto bad = [&](const char* expected) { return BadInput(file, number + 1, expected); };
    const std::optional<Words> words = numbers_of(line);
    if (!words) throw bad("expected stamp x y z qx qy qz qw, with at most 100 km and a unit quaternion");
    if (!first_s) first_s = (*words)[0];
    const double time_s = (*words)[0] - *first_s;
    if (!(std::fabs(time_s) <= seconds_max)) throw bad("expected a stamp within a day of the first");
    const Duration time = Duration::from_seconds(time_s);
    if (!poses_.empty() && time <= poses_.back().time) {
      if ((poses_.back().time - time).seconds() > late_s_max) throw bad("expected a stamp after the one before");
      continue;
    }
    poses_.push_back({time, pose_of(*words)});
  }
  if (poses_.size() < 2) throw BadInput(file, "expected a trajectory of two poses or more");
}

TrajectoryPoint Trajectory::at(Duration time) const {
  constexpr Duration half = std::chrono::milliseconds(500);
  const Duration from = std::max(time - half, Duration()), to = std::min(time + half, duration());
  if (from >= to) return {pose_at(time), 0, 0};
  const Pose pose = pose_at(time), before = between(pose, pose_at(from)), after = between(pose, pose_at(to));
  const double span_s = (to - from).seconds();
  return {pose, (after.x - before.x) / span_s, (after.heading - before.heading) / span_s};
}

Pose Trajectory::pose_at(Duration time) const {
  const auto after = std::upper_bound(poses_.begin(), poses_.end(), time,
                                      [](Duration of, const TimedPose& pose) { return of < pose.time; });
  if (after == poses_.begin()) return poses_.front().pose;
  if (after == poses_.end()) return poses_.back().pose;
  const TimedPose& before = *(after - 1);
  return interpolate(before.pose, after->pose, (time - before.time).seconds() / (after->time - before.time).seconds());
}

}  // namespace waitpoint::executive
