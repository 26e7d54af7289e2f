// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/position_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::run {
namespace {

struct Key {
  std::string_view name;
  double most;
};
enum Place : std::size_t { time_s, x_m, y_m, heading_rad, v_m_s, w_rad_s, side_m_s, keys };
constexpr std::size_t necessary = heading_rad + 1;

std::array<Key, keys> known_keys(std::string_view time_key) {
  return {{{time_key, 1e12},
           {"x_m", 1e5},
           {"y_m", 1e5},
           {"heading_rad", 1e3},
           {"v_m_s", 100},
           {"w_rad_s", 100},
           {"side_m_s", 100}}};
}

std::size_t find(const std::array<Key, keys>& known, std::string_view name, const scenario::Location& written) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].name == name) return i;
    names.push_back(known[i].name);
  }
  throw written.bad("unknown key '" + std::string(name) + "'" + did_you_mean(name, names));
}

}  // namespace

PositionReport parse_report(std::string_view text, std::string_view time_key, const scenario::Location& written) {
  const std::array<Key, keys> known = known_keys(time_key);
  std::array<std::optional<double>, keys> values;
  for (std::string word = scenario::take_word(text, written); !word.empty();
       word = scenario::take_word(text, written)) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) throw written.bad("expected KEY=VALUE, found '" + word + "'");
    const std::size_t place = find(known, std::string_view(word).substr(0, equals), written);
    if (values[place]) throw written.bad("'" + std::string(known[place].name) + "' is given twice");
    double value = 0;
    if (!parse_number(word.substr(equals + 1), value) || !(std::fabs(value) <= known[place].most))
      throw written.bad(fmt::format("expected '{}' to be a number of at most {:g}, found '{}'", known[place].name,
                                    known[place].most, word.substr(equals + 1)));
    values[place] = value;
  }
  for (std::size_t i = 0; i < necessary; ++i)
    if (!values[i]) throw written.bad("expected " + std::string(known[i].name) + "=NUMBER");
  PositionReport report{*values[time_s], {*values[x_m], *values[y_m], exact::wrap_angle(*values[heading_rad])}, {}};
  if (values[v_m_s] || values[w_rad_s] || values[side_m_s])
    report.velocity = {values[v_m_s].value_or(0), values[w_rad_s].value_or(0), values[side_m_s].value_or(0)};
  return report;
}

std::string to_text(const PositionReport& report, std::string_view time_key) {
  std::string text = fmt::format("{}={} x_m={} y_m={} heading_rad={}", time_key, report.time_s, report.pose.x,
                                 report.pose.y, report.pose.heading);
  if (const auto& velocity = report.velocity)
    text += fmt::format(" v_m_s={} w_rad_s={} side_m_s={}", velocity->v_m_s, velocity->w_rad_s, velocity->side_m_s);
  return text;
}

}  // namespace waitpoint::run
