// SPDX-License-Identifier: BSD-3-Clause
// A receiver of positions in the world's frame, such as GPS.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

struct Gps {
  static constexpr std::string_view key = "gps", noun = "the gps";
  static constexpr bool in_world_frame = true;

  struct Description {
    Point antenna = {};  ///< in the body's frame
    double bias_x_m = 0, bias_y_m = 0;
    double drift_m = 0,
           drift_s = 300;        ///< Gauss-Markov error about 0: standard deviation per axis, correlation time
    double noise_m = 0;          ///< standard deviation per axis, drawn per fix
    double height_factor = 1.5;  ///< errors of the height / errors of an axis
    double resolution_m = 0.01;  ///< quantisation
    double dropout = 0;          ///< probability that there is no fix
    Duration period = std::chrono::seconds(1);

    static void fields(auto field) {
      using D = Description;
      field("antenna_m", &D::antenna,
            "position of the antenna on the robot; a fix is the antenna's position, in the world's frame");
      field("bias_x_m", &D::bias_x_m, ranges::coordinate, "systematic error");
      field("bias_y_m", &D::bias_y_m, ranges::coordinate, "systematic error");
      field("drift_m", &D::drift_m, ranges::length_error,
            "D: standard deviation of a first-order Gauss-Markov error on each axis");
      field("drift_s", &D::drift_s, ranges::time_constant, "tau: its time constant");
      field("noise_m", &D::noise_m, ranges::length_error,
            "s: standard deviation on each axis, independent in every fix");
      field("height_factor", &D::height_factor, ranges::rate_error,
            "errors of the height, relative to those of an axis");
      field("resolution_m", &D::resolution_m, ranges::resolution, "steps");
      field("dropout", &D::dropout, ranges::probability, "probability that there is no fix");
      field("period_ms", &D::period, "of fixes");
    }
  };

  /// The position of the antenna in the world's frame.
  struct Reading {
    Time date;
    std::uint64_t number = 0;  ///< of fixes so far; 0: none yet
    Point position;
    double height_m = 0;

    static void fields(auto field) {
      field("date", &Reading::date);
      field("number", &Reading::number);
      field("position", &Reading::position);
      field("height_m", &Reading::height_m);
    }
  };

  class Model;
};

}  // namespace waitpoint::world
