// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/yaml_reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/exact_math.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "core/word_list.hpp"

namespace waitpoint::scenario {
namespace {

[[noreturn]] void refuse(const YamlNode& node, std::string_view what, const std::string& expected) {
  throw node.written.bad("expected " + std::string(what) + " to be " + expected + ", found " + described(node));
}

template <class Number>
bool parse(const YamlNode& node, Number& number) {
  return node.kind == YamlNode::Kind::scalar && !node.quoted && parse_number(node.text, number);
}

}  // namespace

double read_number(const YamlNode& node, std::string_view what, const NumberRange& range) {
  double number = 0;
  // Negated to reject "nan", too.
  if (!parse(node, number) || !(number >= range.low && number <= range.high) ||
      (number != 0 && std::fabs(number) < range.least)) {
    refuse(node, what, std::string(range.phrase));
  }
  return number;
}

std::uint64_t read_count(const YamlNode& node, std::string_view what, std::uint64_t low, std::uint64_t high) {
  std::uint64_t number = 0;
  if (!parse(node, number) || number < low || number > high) {
    refuse(node, what,
           low == high ? std::to_string(low)
                       : "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return number;
}

Duration read_duration(const YamlNode& node, std::string_view what, Duration unit) {
  const double seconds = read_number(node, what, {1e-6, 1e9, "a positive number"}) * unit.seconds();
  constexpr double least_s = 1e-6;  // a shorter period would be a hang
  if (seconds < least_s * (1 - 1e-9)) refuse(node, what, "at least a microsecond");
  return Duration::from_seconds(seconds);
}

bool read_truth(const YamlNode& node, std::string_view what) {
  const bool plain = node.kind == YamlNode::Kind::scalar && !node.quoted;
  if (plain && node.text == "true") return true;
  if (plain && node.text == "false") return false;
  refuse(node, what, "true or false");
}

std::string read_lines(const YamlNode& node, std::string_view what) {
  if (node.kind != YamlNode::Kind::scalar || node.text.empty()) refuse(node, what, "a text");
  return node.text;
}

std::string read_text(const YamlNode& node, std::string_view what) {
  read_lines(node, what);
  if (!is_printable_line(node.text)) refuse(node, what, "a text of one line without control characters");
  return node.text;
}

std::size_t read_word(const YamlNode& node, std::string_view what, std::span<const std::string_view> words) {
  const auto word = std::find(words.begin(), words.end(), read_text(node, what));
  if (word == words.end()) refuse(node, what, word_list(words));
  return static_cast<std::size_t>(word - words.begin());
}

std::vector<double> read_numbers(const YamlNode& node, std::string_view what, std::size_t size_min,
                                 std::size_t size_max, const NumberRange& range) {
  if (node.kind != YamlNode::Kind::list || node.items.size() < size_min || node.items.size() > size_max) {
    const std::string size = std::to_string(size_min) + (size_max > size_min ? " or " + std::to_string(size_max) : "");
    refuse(node, what, "a list of " + size + " numbers");
  }
  std::vector<double> numbers;
  for (const YamlNode& item : node.items) numbers.push_back(read_number(item, what, range));
  return numbers;
}

const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view what) {
  if (node.kind != YamlNode::Kind::list) refuse(node, what, "a list");
  return node.items;
}

YamlMap::YamlMap(const YamlNode& node, std::string what, std::span<const std::string_view> known)
    : node_(node), what_(std::move(what)) {
  if (node.kind != YamlNode::Kind::map) refuse(node, what_, "a map of keys");
  for (const YamlEntry& entry : node.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    throw entry.written.bad("unknown key '" + entry.key + "' in " + what_ + did_you_mean_or_expected(entry.key, known));
  }
}

const YamlNode& YamlMap::require(std::string_view key) const {
  const YamlNode* value = find(key);
  if (value == nullptr) throw node_.written.bad("expected key '" + std::string(key) + "' in " + what_);
  return *value;
}

double YamlMap::number(std::string_view key, const NumberRange& range) const {
  return read_number(require(key), key, range);
}

std::string YamlMap::text(std::string_view key) const { return read_text(require(key), key); }

std::string YamlMap::text(std::string_view key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

std::size_t YamlMap::one_of(std::string_view key, std::span<const std::string_view> words,
                            std::size_t otherwise) const {
  return has(key) ? read_word(*find(key), key, words) : otherwise;
}

void YamlMap::read(std::string_view key, double& value, const NumberRange& range) const {
  if (has(key)) value = number(key, range);
}

void YamlMap::read(std::string_view key, std::uint32_t& value, std::uint32_t low, std::uint32_t high) const {
  if (has(key)) value = static_cast<std::uint32_t>(read_count(*find(key), key, low, high));
}

void YamlMap::read(std::string_view key, std::uint64_t& value, std::uint64_t low, std::uint64_t high) const {
  if (has(key)) value = read_count(*find(key), key, low, high);
}

void YamlMap::read(std::string_view key, bool& value) const {
  if (has(key)) value = read_truth(*find(key), key);
}

void YamlMap::read(std::string_view key, Duration& value, Duration unit) const {
  if (has(key)) value = read_duration(*find(key), key, unit);
}

void YamlMap::read_degrees(std::string_view key, double& value_rad, const NumberRange& range) const {
  if (has(key)) value_rad = radians(number(key, range));
}

double radians(double degrees) { return degrees / 180 * exact::pi; }

std::vector<Setting> flattened(const YamlNode& node, const std::string& prefix) {
  std::vector<Setting> settings;
  const auto append = [&](const YamlNode& value, const std::string& key) {
    const std::string path = prefix.empty() ? key : prefix + "." + key;
    for (Setting& setting : flattened(value, path)) settings.push_back(std::move(setting));
  };
  switch (node.kind) {
    case YamlNode::Kind::null: break;
    case YamlNode::Kind::scalar: settings.push_back({prefix, node.text, node.written.file, node.written.line}); break;
    case YamlNode::Kind::list:
      for (std::size_t i = 0; i < node.items.size(); ++i) append(node.items[i], std::to_string(i));
      break;
    case YamlNode::Kind::map:
      for (const YamlEntry& entry : node.entries) append(entry.value, entry.key);
      break;
  }
  return settings;
}

}  // namespace waitpoint::scenario
