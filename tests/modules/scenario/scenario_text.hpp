// SPDX-License-Identifier: BSD-3-Clause
// A small valid scenario for tests to change, and temporary folders.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace waitpoint::scenario {

inline constexpr std::string_view valid_scenario = R"(format: 1
name: small
expect: {goals_reached: all, collisions: 0}
until_s: 30
world:
  step_ms: 5
  shapes:
    - {name: wall, corners_m: [0, 0, 4, 0.2], height_m: 3}
    - {centre_m: [2, 3], radius_m: 0.3}
    - {name: desk, centre_m: [1, 2], size_m: [1.6, 0.8], heading_deg: 90, known: false}
robot_types:
  scout:
    shape: {radius_m: 0.26, height_m: 1.2}
    base:
      kind: differential
      v_max_m_s: 0.7
      odometry: {travel_scale: 1.01}
    lasers:
      - {name: laser, mount: [0.1, 0, 0], beams: 181}
    sonars:
      - {count: 24}
    modules:
      - name: rflex
        tasks: {motion: {period_ms: 20, cost_us: 300}}
      - {name: front, type: sick, gains: [1, 2.5]}
    bridge:
      - {poster: rflex.command, device: base.command}
      - {poster: front.reading, device: laser.reading}
    executive: {patience_s: 3}
robots:
  - name: one
    type: scout
    start: [1, 1, 90]
    goals:
      - [3, 1]
      - {x_m: 1, y_m: 4, name: shelf}
  - name: two
    type: scout
    start: {x_m: 3, y_m: 2}
    base: {v_max_m_s: 0.5}
    modules:
      - {name: front, enabled: false}
)";

/// The valid scenario with the first occurrence of `from` replaced.
inline std::string changed(std::string_view from, std::string_view to) {
  std::string text(valid_scenario);
  return text.replace(text.find(from), from.size(), to);
}

/// An empty folder that is removed by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "waitpoint-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file; returns its path.
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The text of the BadInput that `action` throws; "" if it throws nothing.
template <class Error, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace waitpoint::scenario
