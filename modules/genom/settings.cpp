// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/settings.hpp"

#include <algorithm>
#include <cmath>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"

namespace waitpoint::genom {
namespace {

[[noreturn]] void refuse(const Setting& setting, const std::string& expected) {
  throw BadInput(setting.file, setting.line,
                 "expected '" + setting.key + "' to be " + expected + ", found '" + setting.text + "'");
}

double parse_double(const Setting& setting, const char* expected) {
  double value = 0;
  if (!parse_number(setting.text, value) || !std::isfinite(value)) refuse(setting, expected);
  if (std::fabs(value) > 1e12) refuse(setting, std::string(expected) + " of at most 1e12");
  return value;
}

}  // namespace

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

bool Settings::has_any(const std::string& key) const {
  return std::any_of(settings_.begin(), settings_.end(),
                     [&](const Setting& s) { return s.key == key || s.key.starts_with(key + "."); });
}

void Settings::reject(const std::string& key, const std::string& expected) const {
  const auto at = std::find_if(settings_.begin(), settings_.end(), [&](const Setting& s) { return s.key == key; });
  WAITPOINT_CHECK(at != settings_.end(), "a setting is rejected that is not there");
  refuse(*at, expected);
}

void Settings::read_one(const std::string& key, double& value) {
  if (const Setting* s = take(key)) value = parse_double(*s, "a number");
}

void Settings::read_one(const std::string& key, bool& value) {
  const Setting* s = take(key);
  if (s == nullptr) return;
  if (s->text != "true" && s->text != "false") refuse(*s, "true or false");
  value = s->text == "true";
}

void Settings::read_one(const std::string& key, std::string& value) {
  if (const Setting* s = take(key)) value = s->text;
}

void Settings::read_one(const std::string& key, Duration& value) {
  const Setting* s = take(key);
  if (s == nullptr) return;
  const double unit_s = key.ends_with("_us") ? 1e-6 : key.ends_with("_ms") ? 1e-3 : 1.0;
  const double seconds = parse_double(*s, "a duration as a number") * unit_s;
  if (seconds < 0 || seconds > 1e9) refuse(*s, "a duration that is not negative, at most 1e9 s");
  value = Duration::from_seconds(seconds);
}

void Settings::read_one(const std::string& key, Time& value) {
  Duration since_start = value.since_start();
  read_one(key, since_start);
  value = Time() + since_start;
}

void Settings::read_one(const std::string& key, Point& value) {
  read_one(key + ".x", value.x);
  read_one(key + ".y", value.y);
}

void Settings::read_one(const std::string& key, Pose& value) {
  read_one(key + ".x", value.x);
  read_one(key + ".y", value.y);
  read_one(key + ".heading", value.heading);
}

void Settings::read_integer(const std::string& key, std::int64_t& value, std::int64_t least, std::int64_t most) {
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
