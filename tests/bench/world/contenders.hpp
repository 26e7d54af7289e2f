// SPDX-License-Identifier: BSD-3-Clause
// The contenders of the scan benchmark: waitpoint in two ways, and the peers, each used as by its own users.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "tests/bench/world/places.hpp"

namespace waitpoint::bench {

/// The measured fan: a SICK LMS at half a degree.
inline constexpr std::size_t beams = 361;
inline constexpr double range_max_m = 30, height_m = 0.4;

class Contender {
 public:
  virtual ~Contender() = default;
  /// Sets the robots' places.
  virtual void place(std::span<const world::Shape> robots) = 0;
  /// A scan of half a turn about the heading of `at`, which may be the centre of robot `own`; that robot is ignored.
  virtual void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) = 0;
};

/// Unit vectors of the fan in the device's frame, counter-clockwise.
const std::vector<Point>& directions();
/// Closer to a robot's centre than this there is only the robot itself.
inline constexpr double own_radius_m = 0.2501;

/// Tests a robot's disc for collisions with its surroundings.
class Collider {
 public:
  virtual ~Collider() = default;
  virtual bool collides(Point centre) = 0;
};
inline constexpr double robot_radius_m = 0.25, robot_low_m = 0, robot_high_m = 1;

std::unique_ptr<Collider> our_footprints(const Place& place);
std::unique_ptr<Collider> fcl_collide(const Place& place);

std::unique_ptr<Contender> our_slice(const Place& place);
std::unique_ptr<Contender> our_fcl_trees(const Place& place);
std::unique_ptr<Contender> grid_of_5_cm(const Place& place);
std::unique_ptr<Contender> embree(const Place& place);
std::unique_ptr<Contender> box2d(const Place& place);
std::unique_ptr<Contender> bullet(const Place& place);
std::unique_ptr<Contender> ode(const Place& place);
std::unique_ptr<Contender> cgal(const Place& place);

}  // namespace waitpoint::bench
