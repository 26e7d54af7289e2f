// SPDX-License-Identifier: BSD-3-Clause
// What can be set of the nearness-diagram navigation of a round robot with one planar laser.
//
// The defaults are those of a B21r-like base in an office: it drives 0.9 m/s in the open and passes doors of 0.9 m.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::ndd {

struct Parameters {
  double robot_radius_m = 0.26;
  double v_m_s_max = 0.9, w_rad_s_max = 1.5;
  double braking_m_s2 = 0.9;  ///< deceleration to count on, a little less than the base's limit
  double reaction_s = 0.25;   ///< from an obstacle's motion to the brakes: scan, decision and command periods
  double prediction_s = 0.1;  ///< from a decision to its effect; the decision is made for where the robot will be
  double security_distance_m = 0.4;    ///< obstacles nearer than this (from the hull) deflect the motion
  double emergency_distance_m = 0.03;  ///< the hull is never driven nearer to an obstacle than this
  double creep_m_s = 0.05;             ///< speed at which half the free distance need not be kept
  double bypass_distance_m = 2.0;      ///< obstacles nearer than this on the way are passed by, not driven at
  double bypass_clearance_m = 0.12;    ///< between the hull and what is passed by, where there is room
  double diagram_range_m = 8.0;        ///< echoes farther away are not looked at
  double memory_range_m = 3.0;         ///< remembered echoes farther away are forgotten
  double memory_age_s = 10.0;          ///< older ones too
  double turning_gain_per_s = 1.5;     ///< turning speed per radian of direction
  double via_tolerance_m = 0.4;        ///< an intermediate via point counts as passed from here
  double goal_tolerance_m = 0.1;       ///< the last one as reached
  double goal_near_m = 0.2;            ///< if it can be got no nearer than this, that is near enough
  double goal_braking_m_s2 = 0.4;      ///< deceleration towards the last one
  double progress_m = 0.2;             ///< the remaining way must shrink by this
  double patience_s = 8.0;             ///< in this time, or the way is reported as blocked

  static constexpr auto fields() {
    return std::tuple(
        field("robot_radius_m", &Parameters::robot_radius_m), field("v_m_s_max", &Parameters::v_m_s_max),
        field("w_rad_s_max", &Parameters::w_rad_s_max), field("braking_m_s2", &Parameters::braking_m_s2),
        field("reaction_s", &Parameters::reaction_s), field("prediction_s", &Parameters::prediction_s),
        field("security_distance_m", &Parameters::security_distance_m),
        field("emergency_distance_m", &Parameters::emergency_distance_m), field("creep_m_s", &Parameters::creep_m_s),
        field("bypass_distance_m", &Parameters::bypass_distance_m),
        field("bypass_clearance_m", &Parameters::bypass_clearance_m),
        field("diagram_range_m", &Parameters::diagram_range_m), field("memory_range_m", &Parameters::memory_range_m),
        field("memory_age_s", &Parameters::memory_age_s), field("turning_gain_per_s", &Parameters::turning_gain_per_s),
        field("via_tolerance_m", &Parameters::via_tolerance_m),
        field("goal_tolerance_m", &Parameters::goal_tolerance_m), field("goal_near_m", &Parameters::goal_near_m),
        field("goal_braking_m_s2", &Parameters::goal_braking_m_s2), field("progress_m", &Parameters::progress_m),
        field("patience_s", &Parameters::patience_s));
  }
};

}  // namespace waitpoint::ndd
