// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/expression_value.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "modules/ros1/parameter_text.hpp"

namespace waitpoint::ros1 {
namespace {

constexpr std::size_t joined_bytes_max = 1 << 20;

bool is_text(const ExpressionValue& value) { return std::holds_alternative<std::string>(value); }
bool is_double(const ExpressionValue& value) { return std::holds_alternative<double>(value); }

// Of a truth value or integer.
std::int64_t integer(const ExpressionValue& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
  return std::get<std::int64_t>(value);
}

// Of any but a text.
double number(const ExpressionValue& value) {
  return is_double(value) ? std::get<double>(value) : static_cast<double>(integer(value));
}

std::string python_text(double value) {
  std::array<char, 40> digits{};
  const double size = std::fabs(value);
  const bool plain = value == 0 || (size >= 1e-4 && size < 1e16);
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific);
  std::string text(digits.data(), end.ptr);
  if (plain && text.find('.') == text.npos) text += ".0";
  return text;
}

bool calculate_integers(std::int64_t a, std::string_view op, std::int64_t b, std::int64_t& result) {
  if (op == "+") return !__builtin_add_overflow(a, b, &result);
  if (op == "-") return !__builtin_sub_overflow(a, b, &result);
  if (op == "*") return !__builtin_mul_overflow(a, b, &result);
  // The greatest negative number divided by -1 has no value.
  if (b == 0 || (b == -1 && __builtin_sub_overflow(std::int64_t{0}, a, &result))) return false;
  // Python rounds down; the remainder has the sign of the divisor.
  const bool is_less = a % b != 0 && ((a < 0) != (b < 0));
  result = op == "//" ? a / b - (is_less ? 1 : 0) : a % b + (is_less ? b : 0);
  return true;
}

bool calculate_doubles(double a, std::string_view op, double b, double& result) {
  if (op == "+") result = a + b;
  if (op == "-") result = a - b;
  if (op == "*") result = a * b;
  if (op == "+" || op == "-" || op == "*") return std::isfinite(result);
  if (b == 0) return false;
  if (op == "/") result = a / b;
  if (op == "//") result = std::floor(a / b);
  if (op == "%") result = a - b * std::floor(a / b);
  return std::isfinite(result);
}

}  // namespace

ExpressionValue value_of_text(const std::string& text) {
  nlohmann::json value;
  read_parameter(text, "auto", value);
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float()) return value.get<double>();
  return text;
}

std::string text_of(const ExpressionValue& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "True" : "False";
  if (is_text(value)) return std::get<std::string>(value);
  return is_double(value) ? python_text(std::get<double>(value)) : std::to_string(integer(value));
}

bool is_true(const ExpressionValue& value) {
  return is_text(value) ? !std::get<std::string>(value).empty() : number(value) != 0;
}

bool is_equal(const ExpressionValue& a, const ExpressionValue& b) {
  if (is_text(a) || is_text(b)) return is_text(a) && is_text(b) && std::get<std::string>(a) == std::get<std::string>(b);
  return is_double(a) || is_double(b) ? number(a) == number(b) : integer(a) == integer(b);
}

bool compare(const ExpressionValue& a, std::string_view op, const ExpressionValue& b, bool& result) {
  if (is_text(a) != is_text(b)) return false;
  const bool is_less = is_text(a)                     ? std::get<std::string>(a) < std::get<std::string>(b)
                       : is_double(a) || is_double(b) ? number(a) < number(b)
                                                      : integer(a) < integer(b);
  result = op == "<" || op == "<=" ? is_less : !is_less && !is_equal(a, b);
  if (op.ends_with('=')) result = result || is_equal(a, b);
  return true;
}

bool calculate(const ExpressionValue& a, std::string_view op, const ExpressionValue& b, ExpressionValue& result) {
  if (is_text(a) || is_text(b)) {
    if (op != "+" || !is_text(a) || !is_text(b)) return false;
    const std::string& joined = result.emplace<std::string>(std::get<std::string>(a) + std::get<std::string>(b));
    return joined.size() <= joined_bytes_max;
  }
  if (op == "/" || is_double(a) || is_double(b))
    return calculate_doubles(number(a), op, number(b), result.emplace<double>());
  return calculate_integers(integer(a), op, integer(b), result.emplace<std::int64_t>());
}

}  // namespace waitpoint::ros1
