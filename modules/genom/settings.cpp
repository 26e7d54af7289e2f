// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"

namespace waitpoint::genom {
namespace {

[[noreturn]] void refuse(const Setting& setting, const std::string& expected) {
  throw BadInput(setting.file, setting.line,
                 "expected '" + setting.key + "' to be " + expected + ", found '" + setting.text + "'");
}

struct Unit {
  std::string_view ending;
  double most;
};
// The longest endings first. Within these the modules' and the world's angles, positions and times are in range.
constexpr Unit units[] = {{"_rad_s2", 1e6}, {"_m_s2", 1e6}, {"_rad_s", 1e4}, {"_m_s", 1e4}, {"_deg", 3600},
                          {"_rad", 1e3},    {"_m", 1e5},    {"_s", 1e9},     {"_v", 1e5}};
constexpr double most_of_others = 1e12, least_nonzero = 1e-12;

/// The greatest amount of a number with this key, by the unit at its end or before "_max" or "_min". A quotient of
/// units ("units_per_m") is a number like any other.
double most_of(std::string_view key) {
  for (const std::string_view bound : {"_max", "_min"})
    if (key.ends_with(bound)) key.remove_suffix(bound.size());
  if (key.find("_per_") != std::string_view::npos) return most_of_others;
  const auto unit =
      std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return key.ends_with(u.ending); });
  return unit == std::end(units) ? most_of_others : unit->most;
}

std::string number_text(double number) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.12g", number);
  return digits.data();
}

double parse_double(const Setting& setting, double most, const char* expected) {
  double value = 0;
  if (!parse_number(setting.text, value) || !std::isfinite(value)) refuse(setting, expected);
  if (std::fabs(value) > most || (value != 0 && std::fabs(value) < least_nonzero)) {
    refuse(setting, std::string(expected) + " of at most " + number_text(most) + ", and 0 or at least 1e-12");
  }
  return value;
}

}  // namespace

Settings Settings::describing() {
  Settings settings;
  settings.rows_ = std::make_shared<std::vector<SettingRow>>();
  return settings;
}

void Settings::describe(const std::string& key, SettingRow::Kind kind, double least, double most,
                        std::string otherwise) {
  if (rows_ != nullptr) rows_->push_back({key, kind, least, most, std::move(otherwise), {}});
}

void Settings::describe_map(const std::string& key, std::string_view description) {
  if (rows_ != nullptr) rows_->push_back({key, SettingRow::Kind::map, 0, 0, "", description});
}

SettingRow* Settings::row_of(const std::string& key) const {
  if (rows_ == nullptr) return nullptr;
  const auto row = std::find_if(rows_->begin(), rows_->end(), [&](const SettingRow& r) { return r.key == key; });
  return row == rows_->end() ? nullptr : &*row;
}

const Setting* Settings::take(const std::string& key) {
  known_.push_back(key);
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    if (settings_[i].key != key) continue;
    used_[i] = true;
    return &settings_[i];
  }
  return nullptr;
}

bool Settings::has(const std::string& key) const {
  return std::any_of(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
}

void Settings::derive(const std::string& key, double value, const std::string& from) {
  constexpr double tolerance = 1e-6;
  const auto at = std::find_if(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
  if (at == settings_.end()) {
    // A computed 0 may come out as a number that no setting may have.
    settings_.push_back({key, waitpoint::number_text(std::fabs(value) < least_nonzero ? 0 : value), "", 0});
    used_.push_back(true);
    return;
  }
  double set = 0;
  if (parse_number(at->text, set) && !(std::fabs(set - value) <= tolerance))
    refuse(*at, number_text(value) + " by " + from + ", or left out");
}

bool Settings::has_any(const std::string& key) const {
  return std::any_of(settings_.begin(), settings_.end(),
                     [&](const Setting& s) { return s.key == key || s.key.starts_with(key + "."); });
}

void Settings::reject(const std::string& key, const std::string& expected) const {
  const auto at = std::find_if(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
  WAITPOINT_CHECK(at != settings_.end(), "a setting is rejected that is not there");
  refuse(*at, expected);
}

void Settings::check_least(const std::string& key, double value, double least) const {
  if (SettingRow* const row = row_of(key)) row->least = std::max(row->least, least);
  if (rows_ == nullptr && value < least) reject(key, number_text(least) + " or more");
}

void Settings::check_most(const std::string& key, double value, double most) const {
  if (SettingRow* const row = row_of(key)) row->most = std::min(row->most, most);
  if (rows_ == nullptr && value > most) reject(key, number_text(most) + " or less");
}

void Settings::check_within(const std::string& key, double value, double least, double most) const {
  if (rows_ == nullptr && !has(key)) return;
  check_least(key, value, least);
  check_most(key, value, most);
}

void Settings::read_one(const std::string& key, double& value) {
  describe(key, SettingRow::Kind::number, -most_of(key), most_of(key), number_text(value));
  if (const Setting* s = take(key)) value = parse_double(*s, most_of(key), "a number");
}

void Settings::read_one(const std::string& key, bool& value) {
  describe(key, SettingRow::Kind::truth, 0, 1, value ? "true" : "false");
  const Setting* s = take(key);
  if (s == nullptr) return;
  if (s->text != "true" && s->text != "false") refuse(*s, "true or false");
  value = s->text == "true";
}

void Settings::read_one(const std::string& key, std::string& value) {
  describe(key, SettingRow::Kind::text, 0, 0, value);
  if (const Setting* s = take(key)) value = s->text;
}

void Settings::read_one(const std::string& key, Duration& value) {
  const double unit_s = key.ends_with("_us") ? 1e-6 : key.ends_with("_ms") ? 1e-3 : 1.0;
  describe(key, SettingRow::Kind::number, 0, std::min(1e9 / unit_s, most_of_others),
           number_text(value.seconds() / unit_s));
  const Setting* s = take(key);
  if (s == nullptr) return;
  const double seconds = parse_double(*s, most_of_others, "a duration as a number") * unit_s;
  if (seconds < 0 || seconds > 1e9) refuse(*s, "a duration that is not negative, at most 1e9 s");
  value = Duration::from_seconds(seconds);
}

void Settings::read_one(const std::string& key, Time& value) {
  Duration since_start = value.since_start();
  read_one(key, since_start);
  value = Time() + since_start;
}

void Settings::read_one(const std::string& key, Point& value) {
  describe_map(key);
  read_one(key + ".x", value.x);
  read_one(key + ".y", value.y);
}

void Settings::read_one(const std::string& key, Pose& value) {
  describe_map(key);
  read_one(key + ".x", value.x);
  read_one(key + ".y", value.y);
  read_one(key + ".heading", value.heading);
}

void Settings::read_integer(const std::string& key, std::int64_t& value, std::int64_t least, std::int64_t most) {
  describe(key, SettingRow::Kind::integer, static_cast<double>(least), static_cast<double>(most),
           std::to_string(value));
  const Setting* s = take(key);
  if (s == nullptr) return;
  std::int64_t read = 0;
  if (!parse_number(s->text, read) || read < least || read > most)
    refuse(*s, "an integer between " + std::to_string(least) + " and " + std::to_string(most));
  value = read;
}

void Settings::check_all_used() const {
  std::vector<std::string_view> known(known_.begin(), known_.end());
  for (std::size_t i = 0; i < settings_.size(); ++i)
    if (!used_[i])
      throw BadInput(settings_[i].file, settings_[i].line,
                     "unknown key '" + settings_[i].key + "'" + did_you_mean(settings_[i].key, known));
}

}  // namespace waitpoint::genom
