// SPDX-License-Identifier: BSD-3-Clause
// Strict typed reading of YAML values: any deviation throws BadInput with file, line and the expected value. A YamlMap
// reads a map; it has a list of all valid keys and rejects others.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/number_range.hpp"
#include "core/setting.hpp"
#include "core/time.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// Numbers are decimal text ("-0.5", "1e-3"), independent of the locale, and finite. `what` is the subject of the
/// message: "expected step_ms to be a positive number, found '-1'".
double read_number(const YamlNode& node, std::string_view what, const NumberRange& range);
std::uint64_t read_count(const YamlNode& node, std::string_view what, std::uint64_t low, std::uint64_t high);
/// A positive duration in multiples of `unit`, at least a microsecond.
Duration read_duration(const YamlNode& node, std::string_view what, Duration unit);
bool read_truth(const YamlNode& node, std::string_view what);
/// Any non-empty scalar that can be printed within a line: names are, in summaries.
std::string read_text(const YamlNode& node, std::string_view what);
/// Any non-empty scalar, of any number of lines: for what is never printed.
std::string read_lines(const YamlNode& node, std::string_view what);
/// The index of the word in `words`.
std::size_t read_word(const YamlNode& node, std::string_view what, std::span<const std::string_view> words);
/// A list of `size_min` to `size_max` numbers.
std::vector<double> read_numbers(const YamlNode& node, std::string_view what, std::size_t size_min,
                                 std::size_t size_max, const NumberRange& range);
/// The elements of a list.
const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view what);

/// The values below `node`, keyed by `prefix` and the keys and list positions, joined by dots; nulls are omitted.
std::vector<Setting> flattened(const YamlNode& node, const std::string& prefix = "");

/// A map with a list of valid keys. Must not outlive its node.
class YamlMap {
 public:
  /// `what` names the map in messages: "the base". Throws if the node is not a map or has an unknown key.
  YamlMap(const YamlNode& node, std::string what, std::span<const std::string_view> known);
  YamlMap(const YamlNode& node, std::string what, std::initializer_list<std::string_view> known)
      : YamlMap(node, std::move(what), std::span(known.begin(), known.size())) {}

  const YamlNode& node() const { return node_; }
  const std::string& what() const { return what_; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// nullptr if the key is missing or null.
  const YamlNode* find(std::string_view key) const { return node_.find(key); }
  /// Throws at the map's line if the key is missing.
  const YamlNode& require(std::string_view key) const;

  double number(std::string_view key, const NumberRange& range) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  /// The index of the key's word in `words`; `otherwise` if the key is missing.
  std::size_t one_of(std::string_view key, std::span<const std::string_view> words, std::size_t otherwise) const;
  std::size_t one_of(std::string_view key, std::initializer_list<std::string_view> words, std::size_t otherwise) const {
    return one_of(key, std::span(words.begin(), words.size()), otherwise);
  }

  // Overwrite `value` if the key is present.
  void read(std::string_view key, double& value, const NumberRange& range) const;
  void read(std::string_view key, std::uint32_t& value, std::uint32_t low, std::uint32_t high) const;
  void read(std::string_view key, std::uint64_t& value, std::uint64_t low, std::uint64_t high) const;
  void read(std::string_view key, bool& value) const;
  /// As read_duration().
  void read(std::string_view key, Duration& value, Duration unit) const;
  void read_degrees(std::string_view key, double& value_rad, const NumberRange& range) const;

 private:
  const YamlNode& node_;
  std::string what_;
};

/// Converts degrees to radians; multiples of 90 degrees give the nearest double.
double radians(double degrees);

}  // namespace waitpoint::scenario
