// SPDX-License-Identifier: BSD-3-Clause
// A map of surface points to match scans with: a grid whose cells know the nearest point within reach, and a score for
// it that falls with its distance, as in a likelihood field (Thrun, Burgard, Fox, "Probabilistic Robotics", 2005, 6.4).
//
// The grid grows to the points added to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/matching/surface.hpp"

namespace waitpoint::matching {

class SurfaceMap {
 public:
  /// `reach_m`: the greatest distance of a cell's centre from its nearest point; `deviation_m`: that of the score,
  /// which is 255 exp(-d^2 / 2 deviation^2).
  SurfaceMap(double cell_m, double reach_m, double deviation_m);

  /// Adds points given in the frame of `frame`. Of two points equally near to a cell the earlier one stays.
  void add(const Pose& frame, std::span<const SurfacePoint> points);

  /// The point nearest to the centre of the cell that contains `p`; null: none within reach.
  const SurfacePoint* nearest(Point p) const {
    const int x = column(p.x), y = column(p.y);
    return contains(x, y) ? point_at(nearest_[index(x, y)]) : nullptr;
  }
  /// The same among the points whose surface faces as `normal` does, as far as they have one: a thin wall has two
  /// sides.
  const SurfacePoint* nearest(Point p, Point normal) const {
    const int x = column(p.x), y = column(p.y);
    if (!contains(x, y)) return nullptr;
    const SurfacePoint* const first = point_at(nearest_[index(x, y)]);
    if (first == nullptr || dot(first->normal, normal) >= 0) return first;
    const SurfacePoint* const behind = point_at(behind_[index(x, y)]);
    return behind != nullptr ? behind : first;
  }

  double cell_m() const { return cell_m_; }
  /// The grid's cells are x() <= column < x() + width(), and likewise its rows.
  int x() const { return x_; }
  int y() const { return y_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Row by row.
  std::span<const std::uint8_t> scores() const { return scores_; }
  std::span<const SurfacePoint> points() const { return points_; }
  /// The column, or the row, of a coordinate.
  int column(double coordinate_m) const;

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  bool contains(int x, int y) const { return x >= x_ && y >= y_ && x < x_ + width_ && y < y_ + height_; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x - x_);
  }
  void grow(int x_low, int y_low, int x_high, int y_high);
  const SurfacePoint* point_at(std::uint32_t index) const { return index == none ? nullptr : &points_[index]; }
  void stamp(std::uint32_t point);

  double cell_m_, per_cell_, reach_m_;
  int reach_cells_;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;
  std::vector<SurfacePoint> points_;
  std::vector<std::uint32_t> nearest_, behind_;  // by cell; behind: the nearest that faces the other way
  std::vector<std::uint8_t> scores_;
  std::array<std::uint8_t, 257> score_of_square_{};  // by the squared distance over that of the reach, times 256
};

}  // namespace waitpoint::matching
