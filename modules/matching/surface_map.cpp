// SPDX-License-Identifier: BSD-3-Clause
#include "modules/matching/surface_map.hpp"

#include <algorithm>
#include <cmath>

#include "modules/matching/cell_of.hpp"

namespace waitpoint::matching {

SurfaceMap::SurfaceMap(double cell_m, double reach_m, double deviation_m)
    : cell_m_(cell_m),
      per_cell_(1 / cell_m),
      reach_m_(reach_m),
      reach_cells_(static_cast<int>(std::ceil(reach_m / cell_m))) {
  for (std::size_t i = 0; i < score_of_square_.size(); ++i) {
    const double square = reach_m * reach_m * static_cast<double>(i) / 256;
    score_of_square_[i] =
        static_cast<std::uint8_t>(std::max(1.0, 255 * exact::exp(-0.5 * square / (deviation_m * deviation_m))));
  }
}

int SurfaceMap::column(double coordinate_m) const { return cell_of(coordinate_m * per_cell_); }

void SurfaceMap::add(const Pose& frame, std::span<const SurfacePoint> points) {
  if (points.empty()) return;
  const auto [sine, cosine] = exact::sincos(frame.heading);
  const auto first = static_cast<std::uint32_t>(points_.size());
  int x_low = 0, y_low = 0, x_high = 0, y_high = 0;
  for (const SurfacePoint& p : points) {
    const Point at{frame.x + (cosine * p.position.x - sine * p.position.y),
                   frame.y + (sine * p.position.x + cosine * p.position.y)};
    points_.push_back({at, {cosine * p.normal.x - sine * p.normal.y, sine * p.normal.x + cosine * p.normal.y}});
    const int x = column(at.x), y = column(at.y);
    const bool one = points_.size() == first + 1;
    x_low = one ? x : std::min(x_low, x);
    y_low = one ? y : std::min(y_low, y);
    x_high = one ? x : std::max(x_high, x);
    y_high = one ? y : std::max(y_high, y);
  }
  grow(x_low - reach_cells_, y_low - reach_cells_, x_high + reach_cells_ + 1, y_high + reach_cells_ + 1);
  for (auto i = first; i < points_.size(); ++i) stamp(i);
}

// Grows with a margin, so that the grid is rarely copied.
void SurfaceMap::grow(int x_low, int y_low, int x_high, int y_high) {
  if (width_ > 0) {
    if (x_low >= x_ && y_low >= y_ && x_high <= x_ + width_ && y_high <= y_ + height_) return;
    constexpr int margin = 32;
    x_low = x_low < x_ ? x_low - margin : x_;
    y_low = y_low < y_ ? y_low - margin : y_;
    x_high = x_high > x_ + width_ ? x_high + margin : x_ + width_;
    y_high = y_high > y_ + height_ ? y_high + margin : y_ + height_;
  }
  const int width = x_high - x_low, height = y_high - y_low;
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint32_t> nearest(cells, none), behind(cells, none);
  std::vector<std::uint8_t> scores(cells, 0);
  for (int y = 0; y < height_; ++y) {
    const auto from = static_cast<std::ptrdiff_t>(y) * width_;
    const auto to = static_cast<std::ptrdiff_t>(y + y_ - y_low) * width + (x_ - x_low);
    std::copy_n(nearest_.begin() + from, width_, nearest.begin() + to);
    std::copy_n(behind_.begin() + from, width_, behind.begin() + to);
    std::copy_n(scores_.begin() + from, width_, scores.begin() + to);
  }
  nearest_ = std::move(nearest);
  behind_ = std::move(behind);
  scores_ = std::move(scores);
  x_ = x_low;
  y_ = y_low;
  width_ = width;
  height_ = height;
}

void SurfaceMap::stamp(std::uint32_t point) {
  const Point p = points_[point].position;
  const int column_of_p = column(p.x), row_of_p = column(p.y);
  const double scale = 256 / (reach_m_ * reach_m_);
  for (int y = row_of_p - reach_cells_; y <= row_of_p + reach_cells_; ++y) {
    const double dy = (y + 0.5) * cell_m_ - p.y;
    const std::size_t row = index(0, y);
    for (int x = column_of_p - reach_cells_; x <= column_of_p + reach_cells_; ++x) {
      const double dx = (x + 0.5) * cell_m_ - p.x;
      const double square = (dx * dx + dy * dy) * scale;
      if (square > 256) continue;
      const std::uint8_t score = score_of_square_[static_cast<std::size_t>(square)];
      const std::size_t cell = row + static_cast<std::size_t>(x);
      if (score > scores_[cell]) {
        const SurfacePoint* const before = point_at(nearest_[cell]);
        if (before != nullptr && dot(before->normal, points_[point].normal) < 0) behind_[cell] = nearest_[cell];
        scores_[cell] = score;
        nearest_[cell] = point;
      } else if (dot(points_[nearest_[cell]].normal, points_[point].normal) < 0) {
        const SurfacePoint* const other = point_at(behind_[cell]);
        const Point centre{(x + 0.5) * cell_m_, (y + 0.5) * cell_m_};
        const Point gap = other != nullptr ? other->position - centre : Point{reach_m_, reach_m_};
        if (dx * dx + dy * dy < dot(gap, gap)) behind_[cell] = point;
      }
    }
  }
}

}  // namespace waitpoint::matching
