// SPDX-License-Identifier: BSD-3-Clause
// Parameters of nearness-diagram navigation with one planar laser.
//
// The defaults suit a B21r-like base in an office: 0.9 m/s in the open, through doors of 0.9 m.
#pragma once

#include "core/fields.hpp"

namespace waitpoint::ndd {

struct Parameters {
  double robot_radius_m = 0.26;
  Bounded<Point, 64> footprint;
  double v_m_s_max = 0.9, w_rad_s_max = 1.5;
  double braking_m_s2 = 0.9;
  double turn_braking_rad_s2 = 2;
  double reaction_s = 0.25;
  double prediction_s = 0.1;
  double security_distance_m = 0.4;
  double emergency_distance_m = 0.03;
  double back_out_m_s = 0.1;
  double creep_m_s = 0.05;
  double bypass_distance_m = 2.0;
  double bypass_clearance_m = 0.12;
  double diagram_range_m = 8.0;
  double memory_range_m = 3.0;
  double memory_age_s = 10.0;
  double foresight_s = 0;
  double turning_gain_per_s = 1.5;
  double via_tolerance_m = 0.4;
  double goal_tolerance_m = 0.1;
  double goal_near_m = 0.2;
  double goal_braking_m_s2 = 0.4;
  double progress_m = 0.2;
  double patience_s = 8.0;

  static void fields(auto field) {
    field("robot_radius_m", &Parameters::robot_radius_m, "of the smallest disc about the robot's centre that holds it");
    field("footprint", &Parameters::footprint,
          "corners of its outline, convex, counter-clockwise; none: it is that disc");
    field("v_m_s_max", &Parameters::v_m_s_max, "greatest speed");
    field("w_rad_s_max", &Parameters::w_rad_s_max, "greatest turning speed");
    field("braking_m_s2", &Parameters::braking_m_s2, "assumed deceleration, slightly less than the base's limit");
    field("turn_braking_rad_s2", &Parameters::turn_braking_rad_s2,
          "the same of turning on the spot, for a robot that is no disc");
    field("reaction_s", &Parameters::reaction_s,
          "from an obstacle's motion to braking: scan, decision and command periods");
    field("prediction_s", &Parameters::prediction_s,
          "from a decision to its effect; decisions are for the predicted pose");
    field("security_distance_m", &Parameters::security_distance_m,
          "obstacles nearer than this (from the hull) deflect the motion");
    field("emergency_distance_m", &Parameters::emergency_distance_m,
          "the hull is never driven nearer to an obstacle than this");
    field("back_out_m_s", &Parameters::back_out_m_s, "speed backwards of a wedged robot that is no disc");
    field("creep_m_s", &Parameters::creep_m_s, "speed at which half the free distance need not be kept");
    field("bypass_distance_m", &Parameters::bypass_distance_m, "obstacles ahead nearer than this are avoided early");
    field("bypass_clearance_m", &Parameters::bypass_clearance_m,
          "between the hull and avoided obstacles, if there is room");
    field("diagram_range_m", &Parameters::diagram_range_m, "echoes farther away are ignored");
    field("memory_range_m", &Parameters::memory_range_m, "remembered echoes farther away are forgotten");
    field("memory_age_s", &Parameters::memory_age_s, "older remembered echoes are forgotten");
    field("foresight_s", &Parameters::foresight_s, "the motion of obstacles is regarded for so long; 0: not at all");
    field("turning_gain_per_s", &Parameters::turning_gain_per_s, "turning speed per radian of direction");
    field("via_tolerance_m", &Parameters::via_tolerance_m, "within this, an intermediate via point counts as passed");
    field("goal_tolerance_m", &Parameters::goal_tolerance_m, "within this, the goal counts as reached");
    field("goal_near_m", &Parameters::goal_near_m, "the same if the robot cannot get closer");
    field("goal_braking_m_s2", &Parameters::goal_braking_m_s2, "deceleration towards the goal");
    field("progress_m", &Parameters::progress_m, "the remaining route must shrink by this");
    field("patience_s", &Parameters::patience_s, "within this time, or it is reported as blocked");
  }
};

}  // namespace waitpoint::ndd
