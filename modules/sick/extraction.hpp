// SPDX-License-Identifier: BSD-3-Clause
// The work of an extraction of segments, and its memory: 90 KB, one per thread of the system. All robots' scans pass
// through it, one after the other, and it stays in the cache.
#pragma once

#include <array>
#include <cstdint>

#include "modules/sick/segment_extraction.hpp"

namespace waitpoint::sick {

class Extraction {
 public:
  /// As SegmentExtraction::extract. The result depends on the arguments only.
  void extract(const SegmentExtractionParameters& parameters, const posters::Echoes& echoes,
               posters::Segments& segments);

 private:
  /// Echoes first..last, inclusive, that may lie on one line.
  struct Run {
    std::uint32_t first = 0, last = 0;
    std::uint32_t points() const { return last - first + 1; }
  };
  /// The line normal . p = distance through `centre`, in the device's frame.
  struct Line {
    Point centre, normal;
    double distance_m;
  };

  void prepare_beams(const posters::LaserReading& scan);
  void take_echoes(const posters::LaserReading& scan);
  bool breaks_after(std::uint32_t i) const;
  void split(Run region);
  void merge();
  bool straight(Run run) const;
  Line fit(Run run) const;
  double variance_across(std::uint32_t i, double projection_m) const;
  bool finish(Run run, posters::Segment& segment) const;

  SegmentExtractionParameters parameters_;

  // Directions of the beams, kept while the device's settings do not change: robots of one type share them.
  std::uint32_t beams_ = 0;
  double first_angle_rad_ = 0, angle_step_rad_ = 0;
  std::array<Point, world::Lasers::count_max> direction_{};

  // The echoes of the present scan, in the device's frame.
  std::uint32_t echoes_ = 0;
  std::array<Point, world::Lasers::count_max> point_{};
  std::array<double, world::Lasers::count_max> range_m_{}, range_variance_{}, per_square_range_{};
  std::array<std::uint32_t, world::Lasers::count_max> beam_{};
  /// Sums over the first i echoes: the line through any run has constant cost.
  struct Moments {
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  std::array<Moments, world::Lasers::count_max + 1> sum_{};

  std::uint32_t runs_ = 0;
  std::array<Run, world::Lasers::count_max> run_{}, stack_{};
};

}  // namespace waitpoint::sick
