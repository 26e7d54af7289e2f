// SPDX-License-Identifier: BSD-3-Clause
// A ROS 1 bag with ROS's own messages, written by rosbag_storage. Debian's headers of these messages do not compile
// beyond C++17, so this interface uses no types of waitpoint: times in nanoseconds from 0, lengths in metres, angles in
// radians. Failures to write are std::runtime_error.
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

  explicit RosBagFile(const std::string& path);
  ~RosBagFile();

  /// The time of receipt of the following messages.
  void set_time(std::int64_t now_ns) { now_ns_ = now_ns; }
  void write_clock();
  void write_transform(const Place& child, const std::string& child_frame);
  void write_pose(const std::string& topic, const Place& place);
  void write_pose(const std::string& topic, const Place& place, const Covariance& covariance);
  /// Of the frame `child`, with its velocities.
  void write_odometry(const std::string& topic, const Place& place, const Covariance& covariance,
                      const std::string& child, double v, double w);
  void write_scan(const std::string& topic, const Scan& scan);
  void write_solids(const std::string& topic, const std::vector<Solid>& solids);
  void write_path(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                  const std::vector<Place>& places);
  void write_poses(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                   const std::vector<Place>& places);
  void write_grid(const std::string& topic, const Grid& grid);
  void write_log(const std::string& topic, std::int64_t time_ns, const std::string& who, const std::string& text,
                 bool is_warning);
  void close();

 private:
  struct Bag;
  template <class Message>
  void write(const std::string& topic, const Message& message);

  std::string path_;
  std::unique_ptr<Bag> bag_;
  std::int64_t now_ns_ = 0;
};

}  // namespace waitpoint::tools
