// SPDX-License-Identifier: BSD-3-Clause
// The mapping of world metres to pixels: the visible part of the world, and its scale.
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

class PictureFrame {
 public:
  /// Shows all obstacles and true paths, with a margin. The longer side of the map is about 1400 pixels.
  PictureFrame(std::span<const world::Obstacle> obstacles, const bridge::RunResult& result);

  Point pixel(Point p) const { return {left + (p.x - low_.x) * scale_, top + (high_.y - p.y) * scale_}; }
  double pixels(double length_m) const { return length_m * scale_; }

  double map_width() const { return pixels(high_.x - low_.x); }
  double map_height() const { return pixels(high_.y - low_.y); }
  /// The whole picture, including the title above and the legend below.
  double width() const { return map_width() + 2 * left; }
  double height() const { return top + map_height() + bottom; }

  static constexpr double left = 24, top = 78, bottom = 74;

 private:
  void show(Point p, double radius_m);

  Point low_, high_;
  bool empty_ = true;
  double scale_ = 1;
};

/// The corners of a box or a prism at its pose.
std::vector<Point> corners(const world::Shape& shape);

}  // namespace waitpoint::tools
