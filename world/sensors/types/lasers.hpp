// SPDX-License-Identifier: BSD-3-Clause
// Planar laser range finders, each with a name.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.hpp"

namespace waitpoint::world {

/// A planar fan of beams about the device's x axis, from a mirror that turns counter-clockwise.
struct LaserDescription {
  Pose mount;             ///< in the body's frame
  double height_m = 0.4;  ///< with the body on the floor
  std::uint32_t beams = 361;
  double field_of_view_rad = exact::pi;
  double range_max_m = 32;
  double range_noise_m = 0.005;  ///< standard deviation, to 8 m; grows linearly to that at 20 m
  double noise_growth = 2;       ///< the standard deviation from 20 m on, in those to 8 m
  double range_bias_m = 0;       ///< systematic, the same for every beam
  double warm_up_bias_m = 0;     ///< added at the start; decays by 1/e per warm_up_s
  double warm_up_s = 1800;
  double angle_noise_rad = 0;  ///< standard deviation of a beam's direction, drawn per scan
  double resolution_m = 0.01;  ///< quantisation
  Duration period = std::chrono::milliseconds(100);

  Duration mirror_turn;                ///< time of one turn; 0: all beams at one instant
  std::uint32_t interlaced_turns = 1;  ///< beam i is measured in turn i modulo this

  double spot_m = 0, spot_divergence_rad = 0;  ///< the beam's diameter: spot_m + spot_divergence_rad x range; 0: a line
  double mixed_jump_m = 0.3;                   ///< a spot on two surfaces farther apart reads a range between them
  double dropout = 0;                          ///< probability that a beam's echo is lost
  double incidence_max_rad = 0.5 * exact::pi;  ///< from the surface's normal; flatter incidence gives no echo

  std::uint32_t line_bit_s = 0;  ///< rate of the serial line that carries the scans; 0: no delay

  static void fields(auto field) {
    using D = LaserDescription;
    constexpr NumberRange fan{least_nonzero, 360, "degrees above 0, at most 360"};
    constexpr NumberRange growth{1, 1e3, "a number from 1 to 1000"};
    constexpr NumberRange jitter{0, 10, "degrees from 0 to 10"};
    constexpr NumberRange width{0, 0.1, "a width from 0 to 0.1 m"};
    constexpr NumberRange divergence{0, 0.1, "an angle from 0 to 0.1 rad"};
    constexpr NumberRange incidence{least_nonzero, 90, "degrees above 0, at most 90"};
    field("mount", &D::mount, "pose on the robot");
    field("height_m", &D::height_m, ranges::height, "with the robot on the floor");
    field("beams", &D::beams, CountRange{2, 721}, "of a scan");
    field("field_of_view_deg", &D::field_of_view_rad, degrees, fan, "from the first beam to the last");
    field("range_max_m", &D::range_max_m, ranges::length, "reading without an echo; an LMS has 8191 values");
    field("range_noise_m", &D::range_noise_m, ranges::length_error, "standard deviation up to 8 m");
    field("noise_growth", &D::noise_growth, growth, "factor on it beyond 20 m, linear in between");
    field("range_bias_m", &D::range_bias_m, ranges::coordinate, "added to every range");
    field("warm_up_bias_m", &D::warm_up_bias_m, ranges::coordinate, "b: added at the start, b e^(-t/T)");
    field("warm_up_s", &D::warm_up_s, ranges::time_constant, "T");
    field("angle_noise_deg", &D::angle_noise_rad, degrees, jitter, "standard deviation of a beam's direction");
    field("resolution_m", &D::resolution_m, ranges::resolution_step, "ranges are multiples of it");
    field("period_ms", &D::period, "of scans; at least the time for mirror and line");
    field("mirror_turn_ms", &D::mirror_turn, "time of a whole turn; without it: all beams at one instant");
    field("interlaced_turns", &D::interlaced_turns, CountRange{1, 16},
          "beam i is measured in turn i modulo this; of an LMS it follows from the beams");
    field("spot_m", &D::spot_m, width, "diameter of the beam at the device");
    field("spot_divergence_rad", &D::spot_divergence_rad, divergence, "its growth: the diameter for a range");
    field("mixed_jump_m", &D::mixed_jump_m, ranges::length,
          "a spot on surfaces farther apart than this gives a range between them, uniformly distributed");
    field("dropout", &D::dropout, ranges::probability, "probability that an echo is lost");
    field("incidence_max_deg", &D::incidence_max_rad, degrees, incidence,
          "no echo at greater angles from the surface's normal");
    field("line_bit_s", &D::line_bit_s, CountRange{300, 1'000'000'000},
          "speed of the serial line; without it: no delay");
  }
  friend bool operator==(const LaserDescription&, const LaserDescription&) = default;
};

struct Lasers {
  static constexpr std::string_view key = "lasers", noun = "a laser";
  static constexpr bool several = true;
  static constexpr std::uint32_t count_max = 721;  ///< beams

  static constexpr bool named = true;
  using Description = LaserDescription;

  /// Off until a command; each scan is numbered.
  struct Command {
    bool on = false;

    static void fields(auto field) { field("on", &Command::on); }
  };

  /// One scan, counter-clockwise, in the device's own frame.
  struct Reading {
    Time date;                 ///< of the scan's last beam
    std::uint32_t number = 0;  ///< counts the scans, from 1
    double first_angle_rad = 0, angle_step_rad = 0;
    double range_max_m = 0;             ///< the reading of a beam without echo
    Bounded<float, count_max> range_m;  ///< quantised by the device

    static void fields(auto field) {
      field("date", &Reading::date);
      field("number", &Reading::number);
      field("first_angle_rad", &Reading::first_angle_rad);
      field("angle_step_rad", &Reading::angle_step_rad);
      field("range_max_m", &Reading::range_max_m);
      field("range_m", &Reading::range_m);
    }
  };

  static constexpr Duration period(const Description& of) { return of.period; }
  /// Of a scan on the serial line; 0 without a line.
  static Duration transmission(const Description& of);
};

}  // namespace waitpoint::world
