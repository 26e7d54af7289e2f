// SPDX-License-Identifier: BSD-3-Clause
// Positions exchanged between modules: poses of the robot's centre, each in the frame named with its type.
#pragma once

#include <array>

#include "core/fields.hpp"

namespace waitpoint::posters {

/// A pose with its uncertainty: a 3 x 3 covariance of (x, y, heading) in row order; m^2, m rad, rad^2.
struct PositionEstimate {
  Time date;  ///< of the pose, not of its computation
  Pose pose;
  std::array<double, 9> covariance{};

  static void fields(auto field) {
    field("date", &PositionEstimate::date);
    field("pose", &PositionEstimate::pose);
    field("covariance", &PositionEstimate::covariance);
  }
};

/// From `rflex`: dead reckoning since the start, in the frame of the last SetPos. The covariance grows without bound.
struct Odometry {
  PositionEstimate position;
  double v_m_s = 0, w_rad_s = 0;  ///< measured speeds
  bool stalled = false;           ///< the base reports that it cannot move as commanded
  double height_m = 0;            ///< flying bases: measured height

  static void fields(auto field) {
    field("position", &Odometry::position);
    field("v_m_s", &Odometry::v_m_s);
    field("w_rad_s", &Odometry::w_rad_s);
    field("stalled", &Odometry::stalled);
    field("height_m", &Odometry::height_m, added);
  }
};

/// From `segloc` and `locate`: the pose in the map frame, matched against the map, at the date of the scan used.
struct Localisation {
  PositionEstimate position;
  std::uint32_t matched = 0;   ///< segments, or points, of the scan matched to the map
  std::uint32_t observed = 0;  ///< segments, or points, of the scan
  bool lost = false;           ///< the pose is not known: not to be used
  std::uint32_t jumps = 0;     ///< how often the robot was found elsewhere than where it was thought to be

  static void fields(auto field) {
    field("position", &Localisation::position);
    field("matched", &Localisation::matched);
    field("observed", &Localisation::observed);
    field("lost", &Localisation::lost, added);
    field("jumps", &Localisation::jumps, added);
  }
};

/// The self-assessment of `pom`.
enum class FusionState : std::uint8_t {
  good,       ///< all sources agree
  uncertain,  ///< the uncertainty exceeds the bound
  disagree,   ///< a source contradicts the others and is excluded
};

/// From `pom`: the robot's reference position, predicted to `date` (the present).
struct FusedPosition {
  PositionEstimate position;
  FusionState state = FusionState::good;
  Duration correction_age;  ///< age of the newest absolute position used; Duration::max(): none

  static void fields(auto field) {
    field("position", &FusedPosition::position);
    field("state", &FusedPosition::state);
    field("correction_age", &FusedPosition::correction_age);
  }
};

}  // namespace waitpoint::posters
