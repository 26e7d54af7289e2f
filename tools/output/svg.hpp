// SPDX-License-Identifier: BSD-3-Clause
// Scalable vector graphics as text: shapes in pixels, y downwards, drawn in order of addition. Numbers have two
// decimals, so equal pictures are equal texts everywhere.
//
// `style` is a list of attributes: `fill="none" stroke="#000"`.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint::tools {

class Svg {
 public:
  Svg(double width, double height);

  void rectangle(Point corner, double width, double height, std::string_view style);
  void circle(Point centre, double radius, std::string_view style);
  void line(Point a, Point b, std::string_view style);
  /// Draws nothing for fewer than two points.
  void polyline(std::span<const Point> points, std::string_view style);
  /// `data` is an SVG path, such as svg_polygon makes.
  void path(std::string_view data, std::string_view style);
  /// `at` is the left end of the base line, unless the style has a text-anchor. Any characters are allowed.
  void text(Point at, std::string_view text, std::string_view style);
  /// A definition, such as a pattern, verbatim.
  void define(std::string_view xml);
  void begin_group(std::string_view style);
  void end_group();

  /// The whole document.
  std::string finish() const;

 private:
  std::string head_, body_;
};

/// "12.35"; without trailing zeros.
std::string svg_number(double value);
/// The closed polygon through the points, as path data.
std::string svg_polygon(std::span<const Point> points);

}  // namespace waitpoint::tools
