// SPDX-License-Identifier: BSD-3-Clause
#include "world/formats/stage_values.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/exact_math.hpp"
#include "core/number_text.hpp"
#include "world/formats/limits.hpp"

namespace waitpoint::world {
namespace {

std::string_view without_plus(std::string_view text) { return text.substr(text.starts_with('+') ? 1 : 0); }

double number(const StageProperty& property, std::string_view text) {
  double value = 0;
  if (!parse_number(without_plus(text), value) || std::fabs(value) > coordinate_m_max) {
    refuse(property.place, "expected numbers within 100000 in '" + std::string(property.name.substr(0, 40)) + "'");
  }
  return value;
}

// "[x y z heading]" with the last ones left out.
StageFrame frame_of(const StageProperty& property) {
  std::vector<double> p = stage_numbers(property, 2, 4);
  p.resize(4);
  return {{p[0], p[1], exact::wrap_angle(p[3] / 180 * exact::pi)}, p[2]};
}

}  // namespace

void refuse(const StagePlace& place, const std::string& message) { throw BadInput(*place.file, place.line, message); }

double stage_number(const StageProperty& property, double low, double high) {
  const double value = stage_numbers(property, 1, 1)[0];
  if (value >= low && value <= high) return value;
  refuse(property.place, "expected '" + std::string(property.name) + "' to be from " + std::to_string(low) + " to " +
                             std::to_string(high));
}

std::vector<double> stage_numbers(const StageProperty& property, std::size_t size_min, std::size_t size_max) {
  if (property.values.size() < size_min || property.values.size() > size_max) {
    const std::string most = size_max > size_min ? " to " + std::to_string(size_max) : "";
    refuse(property.place, "expected " + std::to_string(size_min) + most + " numbers in '" +
                               std::string(property.name.substr(0, 40)) + "'");
  }
  std::vector<double> values;
  for (const std::string_view text : property.values) values.push_back(number(property, text));
  return values;
}

double stage_return(const StageProperty& property) {
  double value = 0;
  if (property.values.size() != 1 || !parse_number(without_plus(property.values[0]), value))
    refuse(property.place, "expected a number in '" + std::string(property.name) + "'");
  return value;
}

std::string stage_text(const StageProperty& property) {
  if (property.values.size() != 1 || property.values[0].empty()) {
    refuse(property.place, "expected a text in '" + std::string(property.name) + "'");
  }
  return std::string(property.values[0]);
}

double stage_number_or(const StageThing& thing, StageKey key, double low, double high, double otherwise) {
  const StageProperty* property = thing.find(key);
  return property == nullptr ? otherwise : stage_number(*property, low, high);
}

StageFrame stage_frame(const StageThing& thing, const StageFrame& outer) {
  const StageProperty* property = thing.find(StageKey::pose);
  if (property == nullptr) return outer;
  const StageFrame own = frame_of(*property);
  const StageFrame frame = {compose(outer.pose, own.pose), outer.z_m + own.z_m};
  for (const double coordinate : {frame.pose.x, frame.pose.y, frame.z_m})
    if (!(std::fabs(coordinate) <= coordinate_m_max)) refuse(property->place, "expected a pose within 100 km");
  return frame;
}

Pose stage_origin(const StageThing& thing) {
  const StageProperty* property = thing.find(StageKey::origin);
  return property == nullptr ? Pose() : frame_of(*property).pose;
}

StageSize stage_size(const StageThing& thing) {
  StageSize size;
  const StageProperty* property = thing.find(StageKey::size);
  if (property == nullptr) return size;
  const std::vector<double> values = stage_numbers(*property, 2, 3);
  size = {values[0], values[1], values.size() == 3 ? values[2] : size.z_m};
  if (!(size.x_m > 0 && size.y_m > 0 && size.z_m >= 0)) refuse(property->place, "expected a positive size");
  return size;
}

}  // namespace waitpoint::world
