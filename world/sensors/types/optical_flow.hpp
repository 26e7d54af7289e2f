// SPDX-License-Identifier: BSD-3-Clause
// An optical flow sensor that looks down at the floor, such as the PixArt PMW3901MB: it counts how far the floor's
// image moves. The defaults are its figures: works from 80 mm on, 16-bit counters of motion (PMW3901MB-TXQT product
// data sheet, version 1.10, June 2017), loses the image beyond 7.4 rad/s, 121 frames a second; drivers take 385 counts
// for a radian (PX4's).
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

struct OpticalFlow {
  static constexpr std::string_view key = "optical_flow", noun = "the optical flow sensor";

  struct Description {
    Pose mount;             ///< in the body's frame: counts are along its axes
    double height_m = 0.1;  ///< of the lens, with the body on the floor
    double counts_per_rad = 385;
    double scale = 1;             ///< measured / true
    double noise_counts = 0;      ///< standard deviation of each axis, drawn per reading
    double range_min_m = 0.08;    ///< nearer to the floor it sees no motion
    double flow_max_rad_s = 7.4;  ///< faster flow is lost
    double dropout = 0;           ///< probability that a frame shows too little texture
    Duration period = std::chrono::milliseconds(10);

    static void fields(auto field) {
      using D = Description;
      field("mount", &D::mount, "pose of the lens on the robot; counts are along its axes");
      field("height_m", &D::height_m, ranges::height, "of the lens, with the robot on the floor");
      field("counts_per_rad", &D::counts_per_rad, ranges::units, "counts for a radian of flow");
      field("scale", &D::scale, ranges::factor, "measured / true");
      field("noise_counts", &D::noise_counts, ranges::rate_error, "standard deviation on each axis");
      field("range_min_m", &D::range_min_m, ranges::length_error, "nearer to the floor the sensor sees no motion");
      field("flow_max_rad_s", &D::flow_max_rad_s, ranges::rate, "faster flow is lost");
      field("dropout", &D::dropout, ranges::probability, "probability that a reading is lost for want of texture");
      field("period_ms", &D::period, "of readings");
    }
  };

  /// The motion since the previous reading: the lens's way over the floor by its height above it.
  struct Reading {
    Time date;
    std::uint64_t number = 0;                        ///< of readings so far; 0: none yet
    std::int32_t ahead_counts = 0, left_counts = 0;  ///< of 16 bits
    bool tracked = false;                            ///< false: lost, the counts are 0

    static void fields(auto field) {
      field("date", &Reading::date);
      field("number", &Reading::number);
      field("ahead_counts", &Reading::ahead_counts);
      field("left_counts", &Reading::left_counts);
      field("tracked", &Reading::tracked);
    }
  };

  class Model;
};

}  // namespace waitpoint::world
