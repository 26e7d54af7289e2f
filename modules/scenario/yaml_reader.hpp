// SPDX-License-Identifier: BSD-3-Clause
// Strict typed reading of YAML values: what is not exactly what was expected throws BadInput with file, line and what
// was expected. A map is read through a YamlMap, which knows all its keys beforehand and refuses others.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>

#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

/// The numbers that make sense somewhere, and how to say so.
struct NumberRange {
  double low, high;         ///< both allowed
  std::string_view phrase;  ///< "a positive number"
};
inline constexpr double least_positive = std::numeric_limits<double>::min();
inline constexpr NumberRange any_number{-1e9, 1e9, "a number"};
inline constexpr NumberRange positive_number{least_positive, 1e9, "a positive number"};
inline constexpr NumberRange number_from_zero{0, 1e9, "a number that is not negative"};

/// Numbers are plain decimal text ("-0.5", "1e-3"), independent of any locale; never infinite. `what` begins the
/// message: "expected step_ms to be a positive number, found '-1'".
double read_number(const YamlNode& node, std::string_view what, const NumberRange& range);
std::uint64_t read_count(const YamlNode& node, std::string_view what, std::uint64_t low, std::uint64_t high);
bool read_truth(const YamlNode& node, std::string_view what);
/// Any scalar, not empty.
std::string read_text(const YamlNode& node, std::string_view what);
/// A list of as many numbers as `size_min` to `size_max`.
std::vector<double> read_numbers(const YamlNode& node, std::string_view what, std::size_t size_min,
                                 std::size_t size_max, const NumberRange& range);
/// The list itself.
const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view what);

/// A map with its known keys. Lives no longer than the node it reads.
class YamlMap {
 public:
  /// `what` names the map in messages: "the base". Throws if the node is no map or has a key that is not known.
  YamlMap(const YamlNode& node, std::string what, std::initializer_list<std::string_view> known);

  const YamlNode& node() const { return node_; }
  const std::string& what() const { return what_; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// nullptr where the key is left out or null.
  const YamlNode* find(std::string_view key) const { return node_.find(key); }
  /// Throws at the map's line where the key is left out.
  const YamlNode& require(std::string_view key) const;

  double number(std::string_view key, const NumberRange& range) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  /// The index of the key's word in `words`.
  std::size_t one_of(std::string_view key, std::initializer_list<std::string_view> words, std::size_t otherwise) const;

  // What the key says goes into `value`, which stays what it is where the key is left out.
  void read(std::string_view key, double& value, const NumberRange& range) const;
  void read(std::string_view key, std::uint32_t& value, std::uint32_t low, std::uint32_t high) const;
  void read(std::string_view key, std::uint64_t& value, std::uint64_t low, std::uint64_t high) const;
  void read(std::string_view key, bool& value) const;
  /// A positive duration, of a number times `unit`, at least a nanosecond.
  void read(std::string_view key, Duration& value, Duration unit) const;
  void read_degrees(std::string_view key, double& value_rad, const NumberRange& range) const;

 private:
  const YamlNode& node_;
  std::string what_;
};

/// Degrees in radians; quarters of a turn come out as the nearest double.
double radians(double degrees);

}  // namespace waitpoint::scenario
