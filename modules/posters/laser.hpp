// SPDX-License-Identifier: BSD-3-Clause
// The planar laser: commands and readings of the device (the hardware side of `sick`), and the outputs of `sick`.
#pragma once

#include "core/fields.hpp"
#include "world/sensors/types/lasers.hpp"

namespace waitpoint::posters {

inline constexpr std::size_t segment_count_max = 64;

/// To the device.
using LaserCommand = world::Lasers::Command;

/// From the device: one scan.
using LaserReading = world::Lasers::Reading;

/// From `sick`: the last scan and the device's pose on the robot.
struct Echoes {
  LaserReading scan;
  Pose mount;

  static void fields(auto field) {
    field("scan", &Echoes::scan);
    field("mount", &Echoes::mount);
  }
};

/// A straight run of echoes in the robot's frame, from `start` to `end`, counter-clockwise as seen from the device. Its
/// line is x cos(normal) + y sin(normal) = distance >= 0, with the covariance of (normal, distance).
struct Segment {
  Point start, end;
  double normal_rad = 0, distance_m = 0;
  std::array<double, 3>
      covariance{};  ///< rad^2, rad m, m^2: (normal, normal), (normal, distance), (distance, distance)
  std::uint32_t points = 0;

  static void fields(auto field) {
    field("start", &Segment::start);
    field("end", &Segment::end);
    field("normal_rad", &Segment::normal_rad);
    field("distance_m", &Segment::distance_m);
    field("covariance", &Segment::covariance);
    field("points", &Segment::points);
  }
};

/// From `sick`: the segments of the scan taken at `date`; the longest first if there are more than the poster holds.
struct Segments {
  Time date;
  std::uint32_t number = 0;  ///< of the scan
  Bounded<Segment, segment_count_max> items;

  static void fields(auto field) {
    field("date", &Segments::date);
    field("number", &Segments::number);
    field("items", &Segments::items);
  }
};

/// From `segloc`: its map, as segments in the map frame.
struct MapSegment {
  Point start, end;

  static void fields(auto field) {
    field("start", &MapSegment::start);
    field("end", &MapSegment::end);
  }
};

inline constexpr std::size_t map_segment_count_max = 512;

struct SegmentMap {
  Time date;
  Bounded<MapSegment, map_segment_count_max> items;

  static void fields(auto field) {
    field("date", &SegmentMap::date);
    field("items", &SegmentMap::items);
  }
};

}  // namespace waitpoint::posters
