// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/view_json.hpp"

#include <cmath>

#include "tools/output/picture_frame.hpp"

namespace waitpoint::tools::view {
namespace {

Json points(const std::vector<Point>& points) {
  Json list = Json::array();
  for (const Point& p : points) list.push_back({rounded(p.x), rounded(p.y)});
  return list;
}

void add_outline(Json& to, const world::Shape& shape) {
  if (shape.kind != world::Shape::Kind::cylinder) {
    to["outline"] = points(corners(shape));
  } else {
    to["x"] = rounded(shape.pose.x);
    to["y"] = rounded(shape.pose.y);
    to["radius"] = rounded(shape.radius_m);
  }
  to["low"] = rounded(shape.z_low_m);
  to["high"] = rounded(shape.z_high_m);
}

}  // namespace

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  const double number = rounded(value);
  fmt::format_to(std::back_inserter(text), "{}", number == 0 ? 0.0 : number);
}

void append_numbers(std::string& text, std::span<const double> values) {
  text += '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ',';
    append_number(text, values[i]);
  }
  text += ']';
}

Json obstacle(const world::Obstacle& obstacle) {
  Json json = {{"name", obstacle.name}};
  add_outline(json, obstacle.shape);
  json["known"] = obstacle.known;
  return json;
}

Json body(const world::Shape& shape) {
  Json json = Json::object();
  add_outline(json, shape);
  return json;
}

Json fields(const FieldShape& shape) {
  constexpr const char* kinds[] = {"value", "record", "list"};
  Json json = {{"name", shape.name}, {"kind", kinds[static_cast<int>(shape.kind)]}};
  if (shape.parts.empty()) return json;
  json["parts"] = Json::array();
  for (const FieldShape& part : shape.parts) json["parts"].push_back(fields(part));
  return json;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace waitpoint::tools::view
