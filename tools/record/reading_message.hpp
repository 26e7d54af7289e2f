// SPDX-License-Identifier: BSD-3-Clause
// A sensor's reading as a message, by its declared fields: the schema of its JSON, which has their units, and a message
// for bags that has their names and numbers. For sensors without a message of ROS (modules/messages/readings.hpp).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/field_facts.hpp"
#include "modules/messages/json.hpp"
#include "modules/messages/poses.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::tools {

using Json = nlohmann::ordered_json;

template <class T>
Json reading_schema(std::string_view name = "") {
  Json schema;
  if constexpr (std::is_same_v<T, bool>) {
    schema = {{"type", "boolean"}};
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, Duration>) {
    schema = {{"type", std::is_integral_v<T> ? "integer" : "number"}};
  } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Point>) {
    const bool is_time = std::is_same_v<T, Time>;
    const Json part = {{"type", is_time ? "integer" : "number"}};
    schema = {{"type", "object"}, {"properties", {{is_time ? "sec" : "x", part}, {is_time ? "nsec" : "y", part}}}};
  } else if constexpr (HasFields<T>) {
    Json properties = Json::object();
    T::fields([&]<class Member>(std::string_view field, Member T::*, const auto&...) {
      properties[std::string(field)] = reading_schema<Member>(field);
    });
    schema = {{"type", "object"}, {"properties", std::move(properties)}};
  } else {
    schema = {{"type", "array"},
              {"items", reading_schema<std::remove_cvref_t<decltype(*std::declval<T>().begin())>>()}};
  }
  if (const std::string_view unit = unit_of(name); !unit.empty()) schema["description"] = unit;
  return schema;
}

struct ReadingMessage {
  static constexpr std::string_view type_name = "waitpoint_msgs/Reading";
  messages::std_msgs::Header header;
  std::vector<std::string> names;  ///< of the numbers: "position.x", "volts.3"; units are at the end of a field's name
  std::vector<double> values;

  static void fields(auto field) {
    field("header", &ReadingMessage::header);
    field("names", &ReadingMessage::names);
    field("values", &ReadingMessage::values);
  }
};

inline void add_numbers(ReadingMessage& message, const Json& value, const std::string& name) {
  if (!value.is_structured()) {
    message.names.push_back(name);
    message.values.push_back(value.is_boolean() ? static_cast<double>(value.get<bool>()) : value.get<double>());
    return;
  }
  for (const auto& [key, part] : value.items()) add_numbers(message, part, name + "." + key);
}

template <class Reading>
ReadingMessage reading_message(const Reading& reading, const std::string& frame) {
  ReadingMessage message{messages::header_of(reading.date, frame), {}, {}};
  const Json fields = messages::to_json(reading);
  for (const auto& [name, value] : fields.items())
    if (name != "date") add_numbers(message, value, name);
  return message;
}

}  // namespace waitpoint::tools
