// SPDX-License-Identifier: BSD-3-Clause
// A room made of walls, discs and raster cells, and its scans by a laser with the errors of a SICK LMS.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::synthetic {

struct Wall {
  Point from, to;
};

struct Disc {
  Point centre;
  double radius_m = 0;
};

/// Square cells, row by row from `origin`; an occupied one is a box.
struct Raster {
  double cell_m = 0.05;
  Point origin;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> occupied;

  Raster() = default;
  Raster(double cell, Point corner, double width_m, double height_m);
  /// Marks every cell that the line touches at a step of a tenth of a cell.
  void draw(Point from, Point to);
};

/// The device: `beams` over `field_of_view_rad` about its x axis.
struct LaserModel {
  std::uint32_t beams = 361;
  double field_of_view_rad = exact::pi;
  double range_m_max = 32;
  double noise_m = 0.005, bias_m = 0, resolution_m = 0.01;
};

class Room {
 public:
  void add_wall(Point from, Point to) { walls_.push_back({from, to}); }
  /// Four walls about `centre`, along its own x and y.
  void add_box(const Pose& centre, double length_m, double width_m);
  void add_disc(Disc disc) { discs_.push_back(disc); }
  void set_raster(Raster raster) { raster_ = std::move(raster); }
  const std::vector<Wall>& walls() const { return walls_; }

  /// The scan of a device at `pose`; `others` are moving discs. Tick `tick` of the stream gives the noise.
  void scan(const Pose& pose, const LaserModel& laser, const RandomStream& noise, std::uint64_t tick,
            std::span<const Disc> others, posters::LaserReading& reading) const;

 private:
  void see_wall(const Pose& pose, const Wall& wall, std::span<double> range_m) const;
  void see_disc(const Pose& pose, const Disc& disc, std::span<double> range_m) const;
  double see_raster(Point from, Point direction, double range_m) const;

  std::vector<Wall> walls_;
  std::vector<Disc> discs_;
  Raster raster_;
  mutable double first_rad_ = 0, step_rad_ = 0;
};

}  // namespace waitpoint::synthetic
