// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/svg.hpp"

#include <fmt/format.h>

#include "core/xml_text.hpp"

namespace waitpoint::tools {
namespace {

std::string point_text(Point p) { return svg_number(p.x) + "," + svg_number(p.y); }

}  // namespace

Svg::Svg(double width, double height)
    : head_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                      "font-family=\"Helvetica, Arial, sans-serif\">\n",
                      svg_number(width), svg_number(height))) {}

void Svg::rectangle(Point corner, double width, double height, std::string_view style) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", svg_number(corner.x),
                       svg_number(corner.y), svg_number(width), svg_number(height), style);
}

void Svg::circle(Point centre, double radius, std::string_view style) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", svg_number(centre.x), svg_number(centre.y),
                       svg_number(radius), style);
}

void Svg::line(Point a, Point b, std::string_view style) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", svg_number(a.x), svg_number(a.y),
                       svg_number(b.x), svg_number(b.y), style);
}

void Svg::polyline(std::span<const Point> points, std::string_view style) {
  if (points.size() < 2) return;
  std::string list;
  for (const Point p : points) list += (list.empty() ? "" : " ") + point_text(p);
  body_ += fmt::format("<polyline points=\"{}\" {}/>\n", list, style);
}

void Svg::path(std::string_view data, std::string_view style) {
  if (!data.empty()) body_ += fmt::format("<path d=\"{}\" {}/>\n", data, style);
}

void Svg::text(Point at, std::string_view text, std::string_view style) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", svg_number(at.x), svg_number(at.y), style,
                       xml_escaped(text));
}

void Svg::define(std::string_view xml) { body_ += fmt::format("<defs>{}</defs>\n", xml); }
void Svg::begin_group(std::string_view style) { body_ += fmt::format("<g {}>\n", style); }
void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::finish() const { return head_ + body_ + "</svg>\n"; }

std::string svg_number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string svg_polygon(std::span<const Point> points) {
  std::string text;
  for (const Point p : points) text += (text.empty() ? "M" : "L") + point_text(p);
  return text + "z";
}

}  // namespace waitpoint::tools
