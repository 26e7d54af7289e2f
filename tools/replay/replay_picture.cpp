// SPDX-License-Identifier: BSD-3-Clause
#include "tools/replay/replay_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/polyline.hpp"
#include "tools/output/svg.hpp"
#include "tools/replay/spread_scans.hpp"

namespace waitpoint::tools {
namespace {

using playback::StampedPose;

constexpr double cell_m = 0.1;
constexpr std::uint32_t echoes_least = 2;  // of a cell that is drawn: single ones are of people and edges
constexpr double drawn_apart = 0.1;        // metres, or radians, between scans
constexpr double side_pixels = 1400, margin = 24, top = 78, bottom = 44;
constexpr double path_tolerance_pixels = 0.25;

/// The number of echoes by cell, rows from below.
class EchoMap {
 public:
  void add(const logs::LoggedScan& scan, const Pose& laser) {
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      const double range_m = scan.range_m[i];
      if (!(range_m > 0 && range_m < scan.range_max_m)) continue;
      const auto [s, c] =
          exact::sincos(laser.heading + scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad);
      ++rows_[cell(laser.y + range_m * s)][cell(laser.x + range_m * c)];
    }
  }
  /// Calls `draw(corner, cells)` for each run of cells beside one another; `corner` is the lower left one.
  template <class Draw>
  void for_each_run(Draw draw) const {
    for (const auto& [y, row] : rows_) {
      std::int64_t begin = 0, count = 0;
      for (const auto& [x, echoes] : row) {
        if (echoes < echoes_least) continue;
        if (count > 0 && x == begin + count) {
          ++count;
          continue;
        }
        if (count > 0) draw(corner(begin, y), count);
        begin = x;
        count = 1;
      }
      if (count > 0) draw(corner(begin, y), count);
    }
  }

 private:
  static std::int64_t cell(double coordinate_m) { return std::llround(std::floor(coordinate_m / cell_m)); }
  static Point corner(std::int64_t x, std::int64_t y) {
    return {static_cast<double>(x) * cell_m, static_cast<double>(y) * cell_m};
  }

  std::map<std::int64_t, std::map<std::int64_t, std::uint32_t>> rows_;
};

EchoMap echo_map(const logs::SensorLog& log, std::span<const StampedPose> trajectory) {
  EchoMap map;
  for (const StampedPose& at : spread_scans(trajectory, drawn_apart))
    map.add(log.scans[at.scan], compose(at.pose, log.mount));
  return map;
}

class Frame {
 public:
  void show(Point p) {
    low_ = is_empty_ ? p : Point{std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = is_empty_ ? p : Point{std::max(high_.x, p.x), std::max(high_.y, p.y)};
    is_empty_ = false;
  }
  void fit() { scale_ = side_pixels / std::max({high_.x - low_.x, high_.y - low_.y, 1.0}); }
  Point pixel(Point p) const { return {margin + (p.x - low_.x) * scale_, top + (high_.y - p.y) * scale_}; }
  double pixels(double length_m) const { return length_m * scale_; }
  double width() const { return pixels(high_.x - low_.x) + 2 * margin; }
  double height() const { return top + pixels(high_.y - low_.y) + bottom; }

 private:
  Point low_, high_;
  bool is_empty_ = true;
  double scale_ = 1;
};

void draw_path(Svg& svg, const Frame& frame, std::span<const StampedPose> path, const char* style) {
  std::vector<Point> points, drawn;
  for (const StampedPose& at : path) points.push_back(frame.pixel(at.pose.position()));
  for (const std::size_t i : simplified(points, path_tolerance_pixels)) drawn.push_back(points[i]);
  svg.polyline(drawn, style);
}

}  // namespace

std::string replay_picture_svg(const std::string& title, const std::string& line, const logs::SensorLog& log,
                               std::span<const StampedPose> trajectory, std::span<const StampedPose> odometry,
                               std::span<const bridge::Line> segments) {
  const EchoMap map = echo_map(log, trajectory);
  Frame frame;
  for (const StampedPose& at : trajectory) frame.show(at.pose.position());
  map.for_each_run([&](Point corner, std::int64_t cells) {
    frame.show(corner);
    frame.show(corner + Point{static_cast<double>(cells) * cell_m, cell_m});
  });
  frame.fit();
  Svg svg(frame.width(), frame.height());
  svg.rectangle({0, 0}, frame.width(), frame.height(), "fill=\"#ffffff\"");
  svg.text({margin, 36}, title, "font-size=\"24\" font-weight=\"bold\" fill=\"#212529\"");
  svg.text({margin, 60}, line, "font-size=\"14\" fill=\"#495057\"");
  std::string cells_path;
  map.for_each_run([&](Point corner, std::int64_t cells) {
    const Point at = frame.pixel(corner + Point{0, cell_m / 2});
    cells_path += fmt::format("M{},{}h{}", svg_number(at.x), svg_number(at.y),
                              svg_number(frame.pixels(static_cast<double>(cells) * cell_m)));
  });
  svg.path(cells_path,
           fmt::format("fill=\"none\" stroke=\"#495057\" stroke-width=\"{}\"", svg_number(frame.pixels(cell_m))));
  for (const bridge::Line& segment : segments)
    svg.line(frame.pixel(segment.start), frame.pixel(segment.end), "stroke=\"#2f9e44\" stroke-width=\"1.6\"");
  constexpr const char* odometry_style =
      "fill=\"none\" stroke=\"#c2255c\" stroke-width=\"1\" stroke-dasharray=\"1.5 4\"";
  constexpr const char* path_style = "fill=\"none\" stroke=\"#1c7ed6\" stroke-width=\"1.6\"";
  svg.begin_group("opacity=\"0.85\"");
  draw_path(svg, frame, odometry, odometry_style);
  draw_path(svg, frame, trajectory, path_style);
  svg.end_group();
  const double y = frame.height() - 16;
  double x = margin;
  for (const auto& [style, label] : {std::pair{path_style, "path"}, std::pair{odometry_style, "odometry alone"},
                                     std::pair{"stroke=\"#2f9e44\" stroke-width=\"1.6\"", "mapped segments"},
                                     std::pair{"stroke=\"#495057\" stroke-width=\"6\"", "echoes"}}) {
    svg.line({x, y}, {x + 34, y}, style);
    svg.text({x + 42, y + 5}, label, "font-size=\"14\" fill=\"#212529\"");
    x += 190;
  }
  return svg.finish();
}

}  // namespace waitpoint::tools
