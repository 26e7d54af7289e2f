// SPDX-License-Identifier: BSD-3-Clause
// How a value of a scenario is written: its reading, its schema, and its text where it is a default. The two former
// stand beside each other, so that they agree.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/scenario/value_schema.hpp"
#include "modules/scenario/yaml_reader.hpp"

namespace waitpoint::scenario {

template <class T>
struct Form {
  /// Overwrites `value`; `what` is the subject of messages.
  std::function<void(const YamlNode& node, std::string_view what, T& value)> read;
  std::function<Json(SchemaDefinitions& definitions)> schema;
  /// The value as JSON, null if it needs no mention; empty: never mentioned.
  std::function<Json(const T& value)> written = nullptr;
};

Form<double> number_form(const NumberRange& range);
/// Of a member in radians.
Form<double> degrees_form(const NumberRange& range);
/// In multiples of `unit`; at least a microsecond without a range.
Form<Duration> duration_form(Duration unit, const std::optional<NumberRange>& range = std::nullopt);
Form<bool> truth_form();
/// One line.
Form<std::string> text_form();
/// The path of a file, resolved from that of the scenario.
Form<std::string> file_form();
template <class Integer>
Form<Integer> count_form(const CountRange& range) {
  return {[range](const YamlNode& node, std::string_view what, Integer& value) {
            value = static_cast<Integer>(read_count(node, what, range.low, range.high));
          },
          [range](SchemaDefinitions&) { return count_schema(range); },
          [range](const Integer& value) { return value >= range.low && value <= range.high ? Json(value) : Json(); }};
}

/// An enumeration whose values from 0 have these words, of static storage.
template <class Enum>
Form<Enum> word_form(std::span<const std::string_view> words) {
  return {[words](const YamlNode& node, std::string_view what, Enum& value) {
            value = static_cast<Enum>(read_word(node, what, words));
          },
          [words](SchemaDefinitions&) { return word_schema(words); },
          [words](const Enum& value) { return Json(words[static_cast<std::size_t>(value)]); }};
}

template <class T>
Form<std::optional<T>> optional_form(const Form<T>& form) {
  return {[read = form.read](const YamlNode& node, std::string_view what, std::optional<T>& value) {
            read(node, what, value.emplace());
          },
          form.schema};
}

/// A list of such values, each named `item` in messages; as a whole in the place of the present one.
template <class T>
Form<std::vector<T>> list_form(const Form<T>& form, std::string item) {
  return {[read = form.read, item](const YamlNode& node, std::string_view what, std::vector<T>& values) {
            values.clear();
            for (const YamlNode& each : read_list(node, what)) {
              T value{};
              read(each, item, value);
              values.push_back(std::move(value));
            }
          },
          [schema = form.schema](SchemaDefinitions& definitions) { return list_schema(schema(definitions)); }};
}

/// The unit of durations at the end of a key: "period_ms" is in milliseconds; seconds without one.
Duration duration_unit(std::string_view key);

}  // namespace waitpoint::scenario
