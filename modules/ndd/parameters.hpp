// SPDX-License-Identifier: BSD-3-Clause
// Parameters of nearness-diagram navigation with one planar laser.
//
// The defaults suit a B21r-like base in an office: 0.9 m/s in the open, through doors of 0.9 m.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::ndd {

struct Parameters {
  double robot_radius_m = 0.26;  ///< of the smallest disc about the robot's centre that holds it
  Bounded<Point, 64> footprint;  ///< corners of its outline, convex, counter-clockwise; none: it is that disc
  double v_m_s_max = 0.9, w_rad_s_max = 1.5;
  double braking_m_s2 = 0.9;           ///< assumed deceleration, slightly less than the base's limit
  double turn_braking_rad_s2 = 2;      ///< the same of turning on the spot, for a robot that is no disc
  double reaction_s = 0.25;            ///< from an obstacle's motion to braking: scan, decision and command periods
  double prediction_s = 0.1;           ///< from a decision to its effect; decisions are for the predicted pose
  double security_distance_m = 0.4;    ///< obstacles nearer than this (from the hull) deflect the motion
  double emergency_distance_m = 0.03;  ///< the hull is never driven nearer to an obstacle than this
  double back_out_m_s = 0.1;           ///< speed backwards of a wedged robot that is no disc
  double creep_m_s = 0.05;             ///< speed at which half the free distance need not be kept
  double bypass_distance_m = 2.0;      ///< obstacles ahead nearer than this are avoided early
  double bypass_clearance_m = 0.12;    ///< between the hull and avoided obstacles, if there is room
  double diagram_range_m = 8.0;        ///< echoes farther away are ignored
  double memory_range_m = 3.0;         ///< remembered echoes farther away are forgotten
  double memory_age_s = 10.0;          ///< older remembered echoes are forgotten
  double foresight_s = 0;              ///< the motion of obstacles is regarded for so long; 0: not at all
  double turning_gain_per_s = 1.5;     ///< turning speed per radian of direction
  double via_tolerance_m = 0.4;        ///< within this, an intermediate via point counts as passed
  double goal_tolerance_m = 0.1;       ///< within this, the goal counts as reached
  double goal_near_m = 0.2;            ///< the same if the robot cannot get closer
  double goal_braking_m_s2 = 0.4;      ///< deceleration towards the goal
  double progress_m = 0.2;             ///< the remaining route must shrink by this
  double patience_s = 8.0;             ///< within this time, or it is reported as blocked

  static void fields(auto field) {
    field("robot_radius_m", &Parameters::robot_radius_m);
    field("footprint", &Parameters::footprint);
    field("v_m_s_max", &Parameters::v_m_s_max);
    field("w_rad_s_max", &Parameters::w_rad_s_max);
    field("braking_m_s2", &Parameters::braking_m_s2);
    field("turn_braking_rad_s2", &Parameters::turn_braking_rad_s2);
    field("reaction_s", &Parameters::reaction_s);
    field("prediction_s", &Parameters::prediction_s);
    field("security_distance_m", &Parameters::security_distance_m);
    field("emergency_distance_m", &Parameters::emergency_distance_m);
    field("back_out_m_s", &Parameters::back_out_m_s);
    field("creep_m_s", &Parameters::creep_m_s);
    field("bypass_distance_m", &Parameters::bypass_distance_m);
    field("bypass_clearance_m", &Parameters::bypass_clearance_m);
    field("diagram_range_m", &Parameters::diagram_range_m);
    field("memory_range_m", &Parameters::memory_range_m);
    field("memory_age_s", &Parameters::memory_age_s);
    field("foresight_s", &Parameters::foresight_s);
    field("turning_gain_per_s", &Parameters::turning_gain_per_s);
    field("via_tolerance_m", &Parameters::via_tolerance_m);
    field("goal_tolerance_m", &Parameters::goal_tolerance_m);
    field("goal_near_m", &Parameters::goal_near_m);
    field("goal_braking_m_s2", &Parameters::goal_braking_m_s2);
    field("progress_m", &Parameters::progress_m);
    field("patience_s", &Parameters::patience_s);
  }
};

}  // namespace waitpoint::ndd
