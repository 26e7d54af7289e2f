// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/form.hpp"

#include <cmath>
#include <cstdio>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"

namespace waitpoint::scenario {
namespace {

/// To twelve digits: the nearest short text of a converted number.
double rounded(double number) {
  if (number == 0 || !std::isfinite(number)) return number;
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.12g", number);
  double value = 0;
  return parse_number(digits, value) ? value : number;
}

/// A default outside of the range is that of a key that has no effect unless it is given.
Json default_within(const NumberRange& range, double number) {
  return number >= range.low && number <= range.high ? Json(number) : Json();
}

}  // namespace

Form<double> number_form(const NumberRange& range) {
  return {
      [range](const YamlNode& node, std::string_view what, double& value) { value = read_number(node, what, range); },
      [range](SchemaDefinitions&) { return number_schema(range); },
      [range](const double& value) { return default_within(range, value); }};
}

Form<double> degrees_form(const NumberRange& range) {
  return {[range](const YamlNode& node, std::string_view what, double& value) {
            value = radians(read_number(node, what, range));
          },
          [range](SchemaDefinitions&) { return number_schema(range); },
          [range](const double& value) { return default_within(range, rounded(value / exact::pi * 180)); }};
}

Form<Duration> duration_form(Duration unit, const std::optional<NumberRange>& range) {
  return {[=](const YamlNode& node, std::string_view what, Duration& value) {
            value = range ? Duration::from_seconds(read_number(node, what, *range) * unit.seconds())
                          : read_duration(node, what, unit);
          },
          [=](SchemaDefinitions&) { return range ? number_schema(*range) : duration_schema(unit); },
          [=](const Duration& value) {
            const double number = rounded(value.seconds() / unit.seconds());
            return range ? default_within(*range, number) : number > 0 ? Json(number) : Json();
          }};
}

Form<bool> truth_form() {
  return {[](const YamlNode& node, std::string_view what, bool& value) { value = read_truth(node, what); },
          [](SchemaDefinitions&) { return truth_schema(); }, [](const bool& value) { return Json(value); }};
}

Form<std::string> text_form() {
  return {[](const YamlNode& node, std::string_view what, std::string& value) { value = read_text(node, what); },
          [](SchemaDefinitions&) { return text_schema(); },
          [](const std::string& value) { return value.empty() ? Json() : Json(value); }};
}

Form<std::string> file_form() {
  return {[](const YamlNode& node, std::string_view what, std::string& value) {
            value = node.written.resolve(read_text(node, what)).string();
          },
          [](SchemaDefinitions&) { return text_schema(); }};
}

Duration duration_unit(std::string_view key) {
  using namespace std::chrono_literals;
  return key.ends_with("_ms") ? Duration(1ms) : key.ends_with("_us") ? Duration(1us) : Duration(1s);
}

}  // namespace waitpoint::scenario
