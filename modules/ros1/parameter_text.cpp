// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ros1/parameter_text.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/number_text.hpp"

namespace waitpoint::ros1 {
namespace {

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

// Python, whose rules these are, allows blanks around a number, and a '+' before it.
std::string_view of_number(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  text = text.substr(0, text.find_last_not_of(blanks) + 1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  return text;
}

template <class Number>
bool read_number(const std::string& text, nlohmann::json& value) {
  Number number = 0;
  const bool good = parse_number(of_number(text), number);
  if (good) value = number;
  return good;
}

}  // namespace

bool read_bool(std::string_view text, bool& value) {
  const std::string small = in_small_letters(text);
  value = small == "true" || small == "1";
  return value || small == "false" || small == "0";
}

bool read_parameter(const std::string& text, std::string_view type, nlohmann::json& value) {
  if (type == "int") return read_number<std::int64_t>(text, value);
  if (type == "double") return read_number<double>(text, value);
  if (type == "bool" || type == "boolean") {
    bool truth = false;
    const bool good = read_bool(text, truth);
    value = truth;
    return good;
  }
  value = text;
  if (type == "str" || type == "string") return true;
  if (text.find('.') != text.npos ? read_number<double>(text, value) : read_number<std::int64_t>(text, value))
    return true;
  if (const std::string small = in_small_letters(text); small == "true" || small == "false") value = small == "true";
  return true;
}

}  // namespace waitpoint::ros1
