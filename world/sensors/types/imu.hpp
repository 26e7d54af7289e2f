// SPDX-License-Identifier: BSD-3-Clause
// An inertial measurement unit at the body's centre: a gyro about the vertical, accelerometers ahead, to the left and
// up.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

/// Errors of one axis of an inertial sensor, in the unit of its quantity.
struct InertialErrors {
  double noise_per_sqrt_hz = 0;     ///< white: the standard deviation of a mean over one second
  double bias = 0;                  ///< turn-on bias: its standard deviation
  double walk_per_sqrt_s = 0;       ///< random walk of the bias: standard deviation after one second
  double drift = 0, drift_s = 100;  ///< Gauss-Markov bias about 0: standard deviation, correlation time
  double scale = 1;                 ///< measured / true
  double resolution = 0;            ///< quantisation; 0: continuous
  double max = 0;                   ///< saturation; 0: none

  static void fields(auto field) {
    using Errors = InertialErrors;
    field("noise_per_sqrt_hz", &Errors::noise_per_sqrt_hz, ranges::rate_error,
          "N: white noise with the standard deviation N / sqrt(T)");
    field("bias", &Errors::bias, ranges::rate_error, "B: standard deviation of the bias at the start");
    field("walk_per_sqrt_s", &Errors::walk_per_sqrt_s, ranges::rate_error,
          "K: random walk of that bias, by K sqrt(t) in the time t");
    field("drift", &Errors::drift, ranges::rate_error, "D: standard deviation of a first-order Gauss-Markov bias");
    field("drift_s", &Errors::drift_s, ranges::time_constant, "tau: its time constant");
    field("scale", &Errors::scale, ranges::factor, "measured / true");
    field("resolution", &Errors::resolution, ranges::resolution, "steps; 0: none");
    field("max", &Errors::max, ranges::positive_number, "greatest reading; without it any");
  }
};

struct Imu {
  static constexpr std::string_view key = "imu", noun = "the imu";

  struct Description {
    InertialErrors gyro;           ///< rad/s
    InertialErrors accelerometer;  ///< m/s2, each of the three
    Duration period = std::chrono::milliseconds(10);

    static void fields(auto field) {
      field("gyro_rad_s", &Description::gyro, "errors of the gyro");
      field("accelerometer_m_s2", &Description::accelerometer, "errors of each accelerometer, independent");
      field("period_ms", &Description::period, "of samples");
    }
  };

  /// Means over the time since the previous sample, in the body's frame.
  struct Reading {
    Time date;
    std::uint64_t number = 0;                           ///< of samples so far; 0: none yet
    double turn_rad_s = 0;                              ///< of the gyro
    double ahead_m_s2 = 0, left_m_s2 = 0, up_m_s2 = 0;  ///< at rest, up is gravity
    double turned_rad = 0;                              ///< integral of the gyro's samples since the start

    static void fields(auto field) {
      field("date", &Reading::date);
      field("number", &Reading::number);
      field("turn_rad_s", &Reading::turn_rad_s);
      field("ahead_m_s2", &Reading::ahead_m_s2);
      field("left_m_s2", &Reading::left_m_s2);
      field("up_m_s2", &Reading::up_m_s2);
      field("turned_rad", &Reading::turned_rad);
    }
  };

  class Model;
};

}  // namespace waitpoint::world
