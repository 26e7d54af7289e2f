// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/parameter_value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"
#include "modules/ros1/launch_expression.hpp"

namespace waitpoint::scenario {
namespace {

bool is_digit_of(int base, char c) {
  const int value = c >= '0' && c <= '9'                     ? c - '0'
                    : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                             : 16;
  return value < base;
}

bool are_digits(std::string_view text, int base) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [base](char c) { return is_digit_of(base, c); });
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

std::string without_underscores(std::string_view text) {
  std::string digits(text);
  std::erase(digits, '_');
  return digits;
}

nlohmann::json integer(const YamlNode& node, std::string_view digits, int base, bool is_negative) {
  std::uint64_t size = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size, base);
  const bool fits = error == std::errc() && end == digits.data() + digits.size() &&
                    size <= std::uint64_t{std::numeric_limits<std::int64_t>::max()};
  if (!fits) throw node.written.bad("expected an integer of at most 64 bits, found '" + node.text + "'");
  return is_negative ? -static_cast<std::int64_t>(size) : static_cast<std::int64_t>(size);
}

// [digits].[digits], with at least a digit in front of the '.' or behind it, and perhaps an exponent with a sign.
bool is_double(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == text.npos) return false;
  const std::size_t exponent = std::min(text.find_first_of("eE"), text.size());
  if (exponent < point) return false;
  const std::string_view before = text.substr(0, point), after = text.substr(point + 1, exponent - point - 1);
  const bool good = (before.empty() || are_digits(before, 10)) && (after.empty() || are_digits(after, 10)) &&
                    !(before.empty() && after.empty());
  if (!good || exponent == text.size()) return good;
  const std::string_view power = text.substr(exponent + 1);
  return (power.starts_with('+') || power.starts_with('-')) && are_digits(power.substr(1), 10);
}

nlohmann::json real(const YamlNode& node, const std::string& text, bool is_negative) {
  double number = 0;
  if (!parse_number(text, number))
    throw node.written.bad("expected a number within the range of double, found '" + node.text + "'");
  return is_negative ? -number : number;
}

// Of deg(...) and rad(...): false for another text.
bool read_angle(const YamlNode& node, double& angle_rad) {
  const std::string_view text = node.text;
  const bool is_degrees = text.starts_with("deg(");
  if (!(is_degrees || text.starts_with("rad(")) || text.find(')') != text.size() - 1) return false;
  const auto pi = [&node](const std::vector<std::string>& words) -> std::string {
    if (words != std::vector<std::string>{"arg", "pi"})
      throw node.written.bad("expected numbers and pi in an angle, found '" + node.text + "'");
    return number_text(exact::pi);
  };
  if (!parse_number(ros1::value_of_expression(text.substr(4, text.size() - 5), pi, node.written), angle_rad))
    throw node.written.bad("expected a number as an angle, found '" + node.text + "'");
  if (is_degrees) angle_rad = angle_rad / 180 * exact::pi;
  return true;
}

nlohmann::json plain_value(const YamlNode& node) {
  const std::string& text = node.text;
  if (is_one_of(text, {"yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"})) return true;
  if (is_one_of(text, {"no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"})) return false;
  if (is_one_of(text, {"Null", "NULL"})) return nullptr;
  if (is_one_of(text, {".nan", ".NaN", ".NAN"})) return std::numeric_limits<double>::quiet_NaN();
  const bool is_negative = text.starts_with('-');
  const std::string_view size = std::string_view(text).substr(is_negative || text.starts_with('+') ? 1 : 0);
  if (is_one_of(size, {".inf", ".Inf", ".INF"}))
    return is_negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  double angle_rad = 0;
  if (read_angle(node, angle_rad)) return angle_rad;
  const std::string digits = without_underscores(size);
  const bool can_be_number = !size.empty() && !size.starts_with('_');
  if (!can_be_number) return text;
  if (digits.starts_with("0x") && are_digits(digits.substr(2), 16))
    return integer(node, digits.substr(2), 16, is_negative);
  if (digits.starts_with("0b") && are_digits(digits.substr(2), 2))
    return integer(node, digits.substr(2), 2, is_negative);
  if (are_digits(digits, 10)) {
    const bool is_octal = digits.size() > 1 && digits.front() == '0';
    if (is_octal && !are_digits(digits, 8)) return text;
    return integer(node, digits, is_octal ? 8 : 10, is_negative);
  }
  if (is_double(digits)) return real(node, digits, is_negative);
  return text;
}

}  // namespace

nlohmann::json parameter_value(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null: return nullptr;
    case YamlNode::Kind::scalar: return node.quoted ? nlohmann::json(node.text) : plain_value(node);
    case YamlNode::Kind::list: {
      nlohmann::json list = nlohmann::json::array();
      for (const YamlNode& item : node.items) list.push_back(parameter_value(item));
      return list;
    }
    case YamlNode::Kind::map: break;
  }
  nlohmann::json map = nlohmann::json::object();
  for (const YamlEntry& entry : node.entries) map[entry.key] = parameter_value(entry.value);
  return map;
}

}  // namespace waitpoint::scenario
