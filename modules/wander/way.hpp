// SPDX-License-Identifier: BSD-3-Clause
// Steering without a goal: ahead if the lane is clear, slower with less room; otherwise turning on the spot, to the
// side that had more room at the start of the turn, until the lane is clear; backwards after a stall.
//
//           |<-- clear_m -->|<--- slow_m --->|
//     +---+ . . . . . . . . . . . . . . . . .      2 half_width_m: the lane ahead
//     | > |   turns here       slows here     v_m_s
//     +---+ . . . . . . . . . . . . . . . . .
#pragma once

#include "core/fields.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::wander {

struct Parameters {
  double v_m_s = 0.4, w_rad_s = 0.8;
  double clear_m = 0.6;
  double slow_m = 0.6;
  double half_width_m = 0.35;
  Duration back_off_ms = std::chrono::seconds(1);
  bool on = true;

  static void fields(auto field) {
    field("v_m_s", &Parameters::v_m_s, "driving speed");
    field("w_rad_s", &Parameters::w_rad_s, "turning speed");
    field("clear_m", &Parameters::clear_m,
          "it turns if an obstacle in the lane ahead is nearer than this to the range finder");
    field("slow_m", &Parameters::slow_m, NumberRange{least_nonzero, 1e5, "a positive length"},
          "it slows down within this distance beyond `clear_m`");
    field("half_width_m", &Parameters::half_width_m, "of the lane: half the robot's width and a margin");
    field("back_off_ms", &Parameters::back_off_ms,
          "duration of reversing after the base reports a stall; without `wander.base_reading` there are no such "
          "reports");
    field("on", &Parameters::on, "active from the start; false: from the request Go");
  }
};

class Way {
 public:
  explicit Way(const Parameters& parameters) : parameters_(parameters) {}

  /// The command to the base at `now`, by the last scan of a range finder whose middle beam points ahead.
  void decide(const posters::LaserReading& scan, bool stalled, Time now, posters::BaseCommand& command);

 private:
  struct Room {
    double ahead_m;          ///< in the lane
    double left_m, right_m;  ///< mean ranges
  };
  Room room(const posters::LaserReading& scan);

  Parameters parameters_;
  // The angles of the last scan, and their sines and cosines: a range finder's stay.
  double first_angle_rad_ = 0, angle_step_rad_ = 0;
  exact::SinCos first_ = {0, 1}, step_ = {0, 1};
  double turning_ = 0;  // left 1, right -1, 0 not turning
  Time back_until_;
};

}  // namespace waitpoint::wander
