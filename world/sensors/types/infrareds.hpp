// SPDX-License-Identifier: BSD-3-Clause
// A ring of infrared range finders, the first straight ahead, counter-clockwise. Each gives a voltage V; the range in
// metres is (gain_per_v V)^exponent.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

struct Infrareds {
  static constexpr std::string_view key = "infrareds", noun = "the infrared range finders";
  static constexpr std::uint32_t count_max = 48;

  struct Description {
    std::uint32_t count = 24;
    double ring_radius_m = 0.25, height_m = 0.5;
    double range_min_m = 0.1, range_max_m = 0.8;
    double gain_per_v = 3.7, exponent = -1;
    double noise_v = 0.01;        ///< standard deviation
    double resolution_v = 0.005;  ///< quantisation
    Duration period = std::chrono::milliseconds(100);

    static void fields(auto field) {
      using D = Description;
      constexpr NumberRange falling{-10, -0.1, "a number from -10 to -0.1"};
      field("count", &D::count, CountRange{1, count_max}, "the first points straight ahead; counter-clockwise");
      field("ring_radius_m", &D::ring_radius_m, ranges::length_error, "of the ring");
      field("height_m", &D::height_m, ranges::height, "with the robot on the floor");
      field("range_min_m", &D::range_min_m, ranges::length, "the least range");
      field("range_max_m", &D::range_max_m, ranges::length, "the greatest range, also without an echo");
      field("gain_per_v", &D::gain_per_v, ranges::factor, "the range is (gain_per_v V)^exponent, V the voltage");
      field("exponent", &D::exponent, falling, "see gain_per_v");
      field("noise_v", &D::noise_v, ranges::rate_error, "standard deviation of the voltage");
      field("resolution_v", &D::resolution_v, ranges::resolution_step, "steps of the converter");
      field("period_ms", &D::period, "of readings");
    }
  };

  struct Reading {
    Time date;
    Bounded<double, count_max> volts;

    static void fields(auto field) {
      field("date", &Reading::date);
      field("volts", &Reading::volts);
    }
  };

  static constexpr Duration period(const Description& description) { return description.period; }

  static std::optional<std::string> contradiction(const Description& of) {
    return of.range_max_m <= of.range_min_m ? std::optional("expected range_max_m to be above range_min_m")
                                            : std::nullopt;
  }

  class Model;
};

}  // namespace waitpoint::world
