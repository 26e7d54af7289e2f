// SPDX-License-Identifier: BSD-3-Clause
// Strict typed reading of YAML values: any deviation throws BadInput with file, line and the expected value. A YamlMap
// reads a map; it has a list of all valid keys and rejects others.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "core/time.hpp"
#include "modules/scenario/yaml_tree.hpp"

namespace waitpoint::scenario {

inline constexpr double least_nonzero = 1e-12;

/// A range of valid numbers, and its description in messages. Numbers nearer to 0 than `least`, but not 0, are not
/// valid either: quotients by them would leave the range of integers.
struct NumberRange {
  double low, high;         ///< inclusive
  std::string_view phrase;  ///< "a positive number"
  double least = least_nonzero;
};
inline constexpr NumberRange positive_number{least_nonzero, 1e9, "a positive number"};
inline constexpr NumberRange number_from_zero{0, 1e9, "a number that is not negative"};
/// Of times in seconds that are not durations of the simulation, such as time constants.
inline constexpr NumberRange time_constant{1e-3, 1e9, "a number of seconds from 0.001 to 1e9"};
inline constexpr NumberRange length_number{1e-4, 1e5, "a length from 0.0001 to 100000 m"};
/// Of the places of devices on bodies, and of the ends of bodies.
inline constexpr NumberRange height_number{0, 1e5, "a height from 0 to 100000 m"};
inline constexpr NumberRange coordinate{-1e5, 1e5, "a coordinate within 100 km"};
/// Of errors and noises of angles: within the headings that the simulation can stand, after any way.
inline constexpr NumberRange angle_error{0, 10, "a number of rad from 0 to 10"};
inline constexpr NumberRange signed_angle_error{-10, 10, "a number of rad from -10 to 10"};
/// Of errors and noises of places.
inline constexpr NumberRange length_error{0, 1e5, "a number of metres from 0 to 100000"};
/// Of the steps in which readings are rounded: 0 for none.
inline constexpr NumberRange resolution{0, 1e3, "0, or a resolution from 0.000001 to 1000", 1e-6};
inline constexpr NumberRange factor{1e-3, 1e3, "a factor from 0.001 to 1000"};
/// Of speeds, accelerations and the errors of sensors for them.
inline constexpr NumberRange rate{least_nonzero, 1e4, "a positive number up to 10000"};
inline constexpr NumberRange acceleration{1e-6, 1e6, "an acceleration from 0.000001 to 1000000"};
/// Of the units of an encoder for a metre or a radian.
inline constexpr NumberRange units{1e-3, 1e9, "a number of units from 0.001 to 1e9"};
inline constexpr NumberRange rate_error{0, 1e3, "a number from 0 to 1000"};

/// Numbers are decimal text ("-0.5", "1e-3"), independent of the locale, and finite. `what` is the subject of the
/// message: "expected step_ms to be a positive number, found '-1'".
double read_number(const YamlNode& node, std::string_view what, const NumberRange& range);
std::uint64_t read_count(const YamlNode& node, std::string_view what, std::uint64_t low, std::uint64_t high);
bool read_truth(const YamlNode& node, std::string_view what);
/// Any non-empty scalar that can be printed within a line: names are, in summaries.
std::string read_text(const YamlNode& node, std::string_view what);
/// Any non-empty scalar, of any number of lines: for what is never printed.
std::string read_lines(const YamlNode& node, std::string_view what);
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
  YamlMap(const YamlNode& node, std::string what, std::initializer_list<std::string_view> known);

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
  std::size_t one_of(std::string_view key, std::initializer_list<std::string_view> words, std::size_t otherwise) const;

  // Overwrite `value` if the key is present.
  void read(std::string_view key, double& value, const NumberRange& range) const;
  void read(std::string_view key, std::uint32_t& value, std::uint32_t low, std::uint32_t high) const;
  void read(std::string_view key, std::uint64_t& value, std::uint64_t low, std::uint64_t high) const;
  void read(std::string_view key, bool& value) const;
  /// A positive duration in multiples of `unit`, at least a microsecond.
  void read(std::string_view key, Duration& value, Duration unit) const;
  void read_degrees(std::string_view key, double& value_rad, const NumberRange& range) const;

 private:
  const YamlNode& node_;
  std::string what_;
};

/// Converts degrees to radians; multiples of 90 degrees give the nearest double.
double radians(double degrees);

}  // namespace waitpoint::scenario
