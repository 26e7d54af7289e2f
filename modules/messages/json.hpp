// SPDX-License-Identifier: BSD-3-Clause
// Messages, and readings of sensors, as JSON, by the tables of their fields: objects in the order of the declaration.
// Numbers that are none, and infinite ones, are null; bytes that are no UTF-8 become replacement characters.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "modules/messages/message.hpp"

namespace waitpoint::messages {

template <class T>
nlohmann::ordered_json to_json(const T& value) {
  using Json = nlohmann::ordered_json;
  if constexpr (std::same_as<T, Time>) {
    return to_json(stamp_of(value));
  } else if constexpr (std::same_as<T, Duration>) {
    return value.seconds();
  } else if constexpr (std::same_as<T, waitpoint::Point>) {
    return {{"x", value.x}, {"y", value.y}};
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<int>(value);
  } else if constexpr (Plain<T> || std::same_as<T, std::string>) {
    return value;
  } else if constexpr (HasFields<T>) {
    Json object = Json::object();
    for_each_field(value,
                   [&](std::string_view name, const auto& member) { object[std::string(name)] = to_json(member); });
    return object;
  } else {
    Json array = Json::array();
    for (const auto& element : value) array.push_back(to_json(element));
    return array;
  }
}

/// Of JSON whose type or range is not the field's.
struct JsonMismatch {};

/// Throws JsonMismatch, or nlohmann::json::exception, for what has another type, is missing or does not fit.
template <class T>
void take_json(const nlohmann::json& json, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    value = json.is_null() ? std::numeric_limits<T>::quiet_NaN() : json.get<T>();
  } else if constexpr (std::is_integral_v<T> && !std::same_as<T, bool>) {
    value = json.get<T>();
    if (!json.is_number() || json != nlohmann::json(value)) throw JsonMismatch();
  } else if constexpr (std::is_enum_v<T>) {
    std::underlying_type_t<T> number{};
    take_json(json, number);
    value = T{number};
  } else if constexpr (HasFields<T>) {
    T::fields([&](std::string_view name, auto member, auto... facts) {
      if (has_fact<Optional, decltype(facts)...> && !json.contains(name)) return;
      take_json(json.at(std::string(name)), value.*member);
    });
  } else if constexpr (is_list<T>) {
    if (!json.is_array()) throw JsonMismatch();
    value.resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) take_json(json[i], value[i]);
  } else if constexpr (array_size<T> > 0) {
    for (std::size_t i = 0; i < value.size(); ++i) take_json(json.at(i), value[i]);
  } else {
    value = json.get<T>();
  }
}

template <HasFields M>
std::string encode_json(const M& message) {
  return to_json(message).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// BadInput, naming the message's `place`, for a text that is no JSON, or lacks a field or has one of another type.
template <Message M>
M decode_json(const std::string& place, std::string_view text) {
  const auto refuse = [&] { throw BadInput(place, "expected a message " + std::string(M::type_name) + " in JSON"); };
  M message;
  try {
    take_json(nlohmann::json::parse(text), message);
  } catch (const nlohmann::json::exception&) {
    refuse();
  } catch (const JsonMismatch&) {
    refuse();
  }
  return message;
}

}  // namespace waitpoint::messages
