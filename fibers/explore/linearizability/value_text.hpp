// SPDX-License-Identifier: BSD-3-Clause
// The text of a user's operation or result in reports.
#pragma once

#include <concepts>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

namespace waitpoint::exploration {

template <class Value>
concept Streamable = requires(std::ostream& out, const Value& value) {
  out << value;
};

inline std::string value_text(bool value) { return value ? "true" : "false"; }
inline std::string value_text(std::monostate) { return ""; }
template <class Value>
std::string value_text(const std::optional<Value>& value);
template <class... Values>
std::string value_text(const std::variant<Values...>& value);
template <class First, class Second>
std::string value_text(const std::pair<First, Second>& value);

/// By the type's operator<<; of optional values "none" or the value's own text, of variants that of the alternative.
template <class Value>
std::string value_text(const Value& value) {
  static_assert(Streamable<Value>, "an operation or a result needs an operator<< (std::ostream&) for reports");
  std::ostringstream text;
  text << value;
  return text.str();
}

template <class Value>
std::string value_text(const std::optional<Value>& value) {
  return value ? value_text(*value) : "none";
}
template <class... Values>
std::string value_text(const std::variant<Values...>& value) {
  return std::visit([](const auto& alternative) { return value_text(alternative); }, value);
}
template <class First, class Second>
std::string value_text(const std::pair<First, Second>& value) {
  return value_text(value.first) + ", " + value_text(value.second);
}

}  // namespace waitpoint::exploration
