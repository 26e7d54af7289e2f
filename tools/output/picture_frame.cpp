// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/picture_frame.hpp"

#include <algorithm>

namespace waitpoint::tools {
namespace {

constexpr double long_side_pixels = 1400;
constexpr double margin_m = 0.4;
// Minimum width: the legend needs it even under a narrow map.
constexpr double width_least = 1000;

}  // namespace

PictureFrame::PictureFrame(std::span<const world::Obstacle> obstacles, const bridge::RunResult& result) {
  for (const world::Obstacle& obstacle : obstacles) {
    if (obstacle.shape.kind == world::Shape::Kind::cylinder) {
      show(obstacle.shape.pose.position(), obstacle.shape.radius_m);
    } else {
      for (const Point corner : corners(obstacle.shape)) show(corner, 0);
    }
  }
  for (const bridge::RobotResult& robot : result.robots) {
    for (const bridge::DatedPose& at : robot.true_path) show(at.pose.position(), 0.5);
    for (const bridge::GoalResult& goal : robot.goals) show(goal.position, 0.5);
  }
  low_ = low_ - Point{margin_m, margin_m};
  high_ = high_ + Point{margin_m, margin_m};
  const double width_m = high_.x - low_.x, height_m = high_.y - low_.y;
  scale_ = long_side_pixels / std::max(width_m, height_m);
  const double missing_m = width_least / scale_ - width_m;
  if (missing_m > 0) {
    low_.x -= missing_m / 2;
    high_.x += missing_m / 2;
  }
}

void PictureFrame::show(Point p, double radius_m) {
  if (empty_) low_ = high_ = p;
  empty_ = false;
  low_ = {std::min(low_.x, p.x - radius_m), std::min(low_.y, p.y - radius_m)};
  high_ = {std::max(high_.x, p.x + radius_m), std::max(high_.y, p.y + radius_m)};
}

std::vector<Point> corners(const world::Shape& shape) {
  if (shape.kind == world::Shape::Kind::prism) {
    std::vector<Point> points;
    for (const auto& side : shape.polygon->sides()) points.push_back(transform(shape.pose, side.start));
    return points;
  }
  const double x = shape.length_m / 2, y = shape.width_m / 2;
  return {transform(shape.pose, {x, y}), transform(shape.pose, {-x, y}), transform(shape.pose, {-x, -y}),
          transform(shape.pose, {x, -y})};
}

}  // namespace waitpoint::tools
