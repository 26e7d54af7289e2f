// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/comparison_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/output/svg.hpp"

namespace waitpoint::tools {
namespace {

constexpr double plot_width = 360, plot_height = 170, gap = 60, left = 50, top = 84;
constexpr std::size_t columns = 3, points_max = 300;
constexpr double shown_quantile = 0.01;  // at either end, values beyond are cut off
constexpr const char* first_style = "fill=\"none\" stroke=\"#1c7ed6\" stroke-width=\"2\"";
constexpr const char* second_style = "fill=\"none\" stroke=\"#e8590c\" stroke-width=\"2\"";
constexpr const char* label_style = "font-size=\"12\" fill=\"#495057\"";

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& ordered, double part) {
  return ordered[static_cast<std::size_t>(part * static_cast<double>(ordered.size() - 1))];
}

/// The visible part of the quantity's axis.
struct Axis {
  double low = 0, high = 1;

  void hold(const std::vector<double>& ordered) {
    if (ordered.empty()) return;
    const double from = quantile(ordered, shown_quantile), to = quantile(ordered, 1 - shown_quantile);
    low = is_empty ? from : std::min(low, from);
    high = is_empty ? to : std::max(high, to);
    is_empty = false;
  }
  /// Never a single value.
  void widen() {
    const double least = 1e-9 * (1 + std::fabs(low));
    if (high - low < least) low -= least, high += least;
  }
  double place(double value) const { return std::clamp((value - low) / (high - low), 0.0, 1.0); }

  bool is_empty = true;
};

void draw_function(Svg& svg, Point corner, const Axis& axis, const std::vector<double>& ordered, const char* style) {
  std::vector<Point> points;
  const std::size_t every = std::max<std::size_t>(1, ordered.size() / points_max);
  const auto at = [&](double value, double part) {
    return corner + Point{plot_width * axis.place(value), plot_height * (1 - part)};
  };
  for (std::size_t i = 0; i < ordered.size(); i += every) {
    points.push_back(at(ordered[i], static_cast<double>(i) / static_cast<double>(ordered.size())));
    const std::size_t next = std::min(i + every, ordered.size());
    points.push_back(at(ordered[i], static_cast<double>(next) / static_cast<double>(ordered.size())));
  }
  svg.polyline(points, style);
}

void draw_frame(Svg& svg, Point corner, const Sample& first, const Sample& second) {
  const std::vector<double> a = sorted(first.values), b = sorted(second.values);
  Axis axis;
  axis.hold(a);
  axis.hold(b);
  axis.widen();
  svg.rectangle(corner, plot_width, plot_height, "fill=\"none\" stroke=\"#adb5bd\"");
  svg.text(corner + Point{0, -8}, first.quantity, "font-size=\"14\" fill=\"#212529\"");
  if (axis.is_empty) return;
  svg.text(corner + Point{0, plot_height + 16}, fmt::format("{:.3g}", axis.low), label_style);
  svg.text(corner + Point{plot_width, plot_height + 16}, fmt::format("{:.3g}", axis.high),
           "font-size=\"12\" fill=\"#495057\" text-anchor=\"end\"");
  draw_function(svg, corner, axis, a, first_style);
  draw_function(svg, corner, axis, b, second_style);
}

}  // namespace

std::string comparison_picture_svg(const std::string& first_name, std::span<const Sample> first,
                                   const std::string& second_name, std::span<const Sample> second) {
  const std::size_t rows = (first.size() + columns - 1) / columns;
  const double width = left + columns * (plot_width + gap),
               height = top + static_cast<double>(rows) * (plot_height + gap);
  Svg svg(width, height);
  svg.rectangle({0, 0}, width, height, "fill=\"#ffffff\"");
  double x = left;
  for (const auto& [style, name] : {std::pair(first_style, first_name), std::pair(second_style, second_name)}) {
    svg.line({x, 32}, {x + 34, 32}, style);
    svg.text({x + 42, 37}, name, "font-size=\"15\" fill=\"#212529\"");
    x += 1.5 * (plot_width + gap);
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::size_t row = i / columns;
    const auto x_places = static_cast<double>(i % columns), y_places = static_cast<double>(row);
    draw_frame(svg, {left + x_places * (plot_width + gap), top + y_places * (plot_height + gap)}, first[i], second[i]);
  }
  return svg.finish();
}

}  // namespace waitpoint::tools
