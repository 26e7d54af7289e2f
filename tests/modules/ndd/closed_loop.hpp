// SPDX-License-Identifier: BSD-3-Clause
// A small world for tests of navigation: discs that drive among boxes and discs, each controlled by a Navigator.
//
// The truth steps at 10 ms under acceleration limits. Each robot has a laser (361 beams over 180 degrees, 10 Hz, 5 mm
// noise, mounted ahead of the centre) whose scans arrive late, odometry at 50 Hz, and decisions at 10 Hz; its position
// estimate is the truth plus an optional constant error. Collisions do not stop a robot: clearances become negative,
// and the test sees it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "modules/ndd/navigator.hpp"

namespace waitpoint::test {

struct Box {
  Pose pose;
  double length_m = 0, width_m = 0;
};
struct Disc {
  Point centre;
  double radius_m = 0;
};

/// The fixed obstacles.
class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// The distance along a ray to the first surface, at most `range_m`.
  virtual double range(Point from, double angle_rad, double range_m) const = 0;
  /// The distance from a point to the nearest surface; at most `limit_m`, 0 or negative inside.
  virtual double clearance(Point point, double limit_m) const = 0;
};

class Shapes : public Surroundings {
 public:
  std::vector<Box> boxes;
  std::vector<Disc> discs;

  void wall(double x0, double y0, double x1, double y1);  ///< an upright box by two opposite corners
  double range(Point from, double angle_rad, double range_m) const override;
  double clearance(Point point, double limit_m) const override;
};

/// The distance along a ray to a disc, `range_m` if it misses.
double range_to_disc(Point from, Point direction, const Disc& disc, double range_m);

struct DrivenRobot {
  DrivenRobot(std::string robot_name, const ndd::Parameters& parameters, const Pose& start);

  std::string name;
  ndd::Navigator navigator;
  Pose pose, start;
  double v_m_s = 0, w_rad_s = 0;
  ndd::Speeds command, command_to_be;  // the latter takes effect after a delay
  posters::Echoes echoes, echoes_to_be;
  ndd::Decision decision;
  Pose position_error;
  RandomStream noise;
  std::int64_t phase = 0;  // of its periods, in steps

  double driven_m = 0, turned_rad = 0, least_clearance_m = 100;
  int turn_changes = 0;  // sign changes of the measured turning speed beyond 0.1 rad/s while driving
  double last_turn = 0;
  std::vector<Pose> path;  // ten a second
};

class ClosedLoop {
 public:
  ClosedLoop(const Surroundings& surroundings, std::uint64_t seed) : surroundings_(surroundings), seed_(seed) {}

  DrivenRobot& add(const ndd::Parameters& parameters, const Pose& start);
  /// Gives a robot via points.
  void go(DrivenRobot& robot, const std::vector<Point>& via_points);
  /// One step of 10 ms.
  void step();
  /// Steps until each robot has arrived or is blocked, or the time is over; true if all arrived.
  bool run(double seconds_max);

  Time now() const { return now_; }
  posters::PositionEstimate position(const DrivenRobot& robot) const;
  std::vector<std::unique_ptr<DrivenRobot>> robots;

 private:
  void move(DrivenRobot& robot);
  void scan(DrivenRobot& robot);
  void decide(DrivenRobot& robot);
  void measure_clearance(DrivenRobot& robot);

  const Surroundings& surroundings_;
  std::uint64_t seed_;
  std::int64_t steps_ = 0;
  Time now_;
};

}  // namespace waitpoint::test
