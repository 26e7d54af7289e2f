// SPDX-License-Identifier: BSD-3-Clause
// A message's type as a value, made of its declaration, and the texts that describe it in files and to nodes.
#pragma once

#include <type_traits>

#include "modules/messages/message.hpp"

namespace waitpoint::messages {

struct Description {
  struct Field {
    std::string name;
    std::string type;                    ///< of an element: "float64", "string", "time", "geometry_msgs/Pose"
    std::string brackets = {};           ///< of a list "[]", of an array "[9]", or none
    const Description* parts = nullptr;  ///< of a type with fields, also of "time" and "duration"
    bool is_message() const { return type.find('/') != type.npos; }
  };
  struct Constant {
    std::string type, name, value;
  };
  std::string name;
  std::vector<Constant> constants;
  std::vector<Field> fields;
};

/// The sum by which ROS 1 compares types, as genmsg makes it.
std::string md5_sum(const Description& type);
/// The .msg text of the type and of those within it, as in the headers of connections; without comments.
std::string ros1_definition(const Description& type);
std::string json_schema(const Description& type);

/// A type as ROS 1 announces it.
struct Ros1Type {
  std::string name, md5, definition;
};

template <Plain T>
std::string plain_type_name() {
  if constexpr (std::same_as<T, bool>) return "bool";
  if constexpr (std::same_as<T, Byte>) return "byte";
  const std::string kind = std::is_floating_point_v<T> ? "float" : std::is_signed_v<T> ? "int" : "uint";
  return kind + std::to_string(8 * sizeof(T));
}

template <HasFields T>
const Description& description_of();

template <class T>
Description::Field described_field(std::string name) {
  if constexpr (is_list<T> || array_size < T >> 0) {
    Description::Field field = described_field<typename T::value_type>(std::move(name));
    field.brackets = is_list<T> ? "[]" : "[" + std::to_string(array_size<T>) + "]";
    return field;
  } else if constexpr (HasFields<T>) {
    return {std::move(name), description_of<T>().name, "", &description_of<T>()};
  } else if constexpr (std::same_as<T, std::string>) {
    return {std::move(name), "string"};
  } else {
    return {std::move(name), plain_type_name<T>()};
  }
}

template <HasFields T>
Description describe() {
  Description type;
  if constexpr (std::same_as<T, Stamp>) {
    type.name = "time";
  } else if constexpr (std::same_as<T, Span>) {
    type.name = "duration";
  } else {
    type.name = T::type_name;
  }
  if constexpr (requires { T::constants; })
    for (const auto& [name, value] : T::constants)
      type.constants.push_back({plain_type_name<std::remove_const_t<decltype(value)>>(), std::string(name),
                                std::to_string(static_cast<int>(value))});
  T::fields([&]<class Member>(std::string_view name, Member T::*, auto...) {
    type.fields.push_back(described_field<Member>(std::string(name)));
  });
  return type;
}

template <HasFields T>
const Description& description_of() {
  static const Description type = describe<T>();
  return type;
}

template <Message T>
const Ros1Type& ros1_type() {
  static const Ros1Type type{std::string(T::type_name), md5_sum(description_of<T>()),
                             ros1_definition(description_of<T>())};
  return type;
}

}  // namespace waitpoint::messages
