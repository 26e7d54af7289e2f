// SPDX-License-Identifier: BSD-3-Clause
// Who scans: we in two ways, and the peers, each as its own users would have it scan.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "tests/bench/world/places.hpp"

namespace waitpoint::bench {

/// The fan that is measured: a SICK LMS at half a degree.
inline constexpr std::size_t beams = 361;
inline constexpr double range_max_m = 30, height_m = 0.4;

class Contender {
 public:
  virtual ~Contender() = default;
  /// The robots stand there now.
  virtual void place(std::span<const world::Shape> robots) = 0;
  /// A scan of half a turn about the heading of `at`, which may be the middle of robot `own`, without that.
  virtual void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) = 0;
};

/// Unit vectors of the fan in the device's frame, counter-clockwise.
const std::vector<Point>& directions();
/// Nearer than this to its own middle nothing stands that is not the robot itself.
inline constexpr double own_radius_m = 0.2501;

/// Who says whether a robot's disc would collide with what stands there.
class Collider {
 public:
  virtual ~Collider() = default;
  virtual bool collides(Point centre) = 0;
};
inline constexpr double robot_radius_m = 0.25;

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
