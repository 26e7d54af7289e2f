// SPDX-License-Identifier: BSD-3-Clause
// A ROS 1 bag with ROS's own messages, written by rosbag_storage in a library of its own, which is loaded by the first
// bag: programs that write none do not need ROS. Debian's headers of these messages do not compile beyond C++17, so
// this interface uses no types of waitpoint: times in nanoseconds from 0, lengths in metres, angles in radians.
// Failures to write are std::runtime_error.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace waitpoint::tools {

class RosBagFile {
 public:
  /// A position in `frame`; turned about z by 2 atan2(sin_half, cos_half).
  struct Place {
    std::int64_t time_ns;
    std::string frame;
    double x, y, z, sin_half, cos_half;
  };
  struct Scan {
    std::int64_t time_ns;
    std::string frame;
    double first_angle, angle_step, range_max;
    std::vector<float> ranges;
  };
  /// A grey box of the given sizes, or an upright cylinder whose diameter is the first of them.
  struct Solid {
    bool is_box;
    Place place;
    std::array<double, 3> size;
  };
  /// Row by row from the origin, the outer corner of the first cell: 0 free, 100 occupied, -1 unknown.
  struct Grid {
    Place origin;
    int width, height;
    double resolution;
    std::vector<std::int8_t> cells;
  };
  /// Of x, y and the angle, row-major.
  using Covariance = std::array<double, 9>;

  virtual ~RosBagFile() = default;

  /// The time of receipt of the following messages.
  virtual void set_time(std::int64_t now_ns) = 0;
  virtual void write_clock() = 0;
  virtual void write_transform(const Place& child, const std::string& child_frame) = 0;
  virtual void write_pose(const std::string& topic, const Place& place) = 0;
  virtual void write_pose(const std::string& topic, const Place& place, const Covariance& covariance) = 0;
  /// Of the frame `child`, with its velocities.
  virtual void write_odometry(const std::string& topic, const Place& place, const Covariance& covariance,
                              const std::string& child, double v, double w) = 0;
  virtual void write_scan(const std::string& topic, const Scan& scan) = 0;
  virtual void write_solids(const std::string& topic, const std::vector<Solid>& solids) = 0;
  virtual void write_path(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                          const std::vector<Place>& places) = 0;
  virtual void write_poses(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                           const std::vector<Place>& places) = 0;
  virtual void write_grid(const std::string& topic, const Grid& grid) = 0;
  virtual void write_log(const std::string& topic, std::int64_t time_ns, const std::string& who,
                         const std::string& text, bool is_warning) = 0;
  virtual void close() = 0;
};

/// The library, loaded.
struct BagLibrary {
  static constexpr const char* file = "libwaitpoint-bags.so";
  static constexpr const char* symbol = "waitpoint_bag_library_1";  ///< with the version of this file

  /// Opens a bag to be written; std::runtime_error if that fails.
  std::unique_ptr<RosBagFile> (*make)(const std::string& path);
};

/// Loads the library; BadInput if it is not there, about the file `bag` that needs it.
const BagLibrary& bag_library(const std::string& bag);

}  // namespace waitpoint::tools
