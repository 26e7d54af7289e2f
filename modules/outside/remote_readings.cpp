// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/remote_readings.hpp"

#include <algorithm>

#include "core/number_text.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::outside {
namespace {

/// The words KEY=VALUE of a line.
class Values {
 public:
  Values(std::string_view text, const scenario::Location& written) : written_(written) {
    for (std::string word = scenario::take_word(text, written); !word.empty();
         word = scenario::take_word(text, written))
      words_.push_back(std::move(word));
  }

  std::string_view text(std::string_view key) const {
    for (const std::string_view word : words_)
      if (word.size() > key.size() && word.starts_with(key) && word[key.size()] == '=')
        return word.substr(key.size() + 1);
    throw written_.bad("expected " + std::string(key) + "=VALUE");
  }
  template <class Number>
  void read(std::string_view key, Number& number) const {
    if (!parse_number(text(key), number)) throw bad_number(key);
  }
  std::vector<double> list(std::string_view key) const {
    std::vector<double> numbers;
    for (std::string_view rest = text(key); !rest.empty();) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      double number = 0;
      if (!parse_number(rest.substr(0, comma), number)) throw bad_number(key);
      numbers.push_back(number);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    return numbers;
  }

 private:
  BadInput bad_number(std::string_view key) const {
    return written_.bad("expected '" + std::string(key) + "' to be a number, found '" + std::string(text(key)) + "'");
  }

  std::vector<std::string> words_;
  const scenario::Location& written_;
};

}  // namespace

void RemoteReadings::take(std::string_view line, const scenario::RobotScenario& robot,
                          const scenario::Location& written) {
  const std::string word = scenario::take_word(line, written);
  if (word == "step") ++steps;
  if (word != "base" && word != "truth" && word != "scan") return;
  const Values values(line, written);
  if (word == "base") {
    int stalled = 0;
    values.read("travel_units", odometer.travel_units);
    values.read("turn_units", odometer.turn_units);
    values.read("side_units", odometer.side_units);
    values.read("v_m_s", odometer.velocity.v_m_s);
    values.read("w_rad_s", odometer.velocity.w_rad_s);
    values.read("volts", battery.volts);
    values.read("current_a", battery.current_a);
    values.read("charge", battery.charge);
    values.read("stalled", stalled);
    values.read("height_m", body.height_m);
    body.stalled = stalled != 0;
  } else if (word == "truth") {
    values.read("x_m", body.pose.x);
    values.read("y_m", body.pose.y);
    values.read("heading_rad", body.pose.heading);
    values.read("travelled_m", body.travelled_m);
    values.read("collisions", body.collisions);
  } else {
    const std::vector<std::string>& lasers = robot.laser_names;
    const auto laser = std::find(lasers.begin(), lasers.end(), values.text("laser"));
    if (laser == lasers.end()) throw written.bad("there is no laser '" + std::string(values.text("laser")) + "'");
    world::LaserScan scan;
    values.read("first_angle_rad", scan.first_angle_rad);
    values.read("angle_step_rad", scan.angle_step_rad);
    values.read("range_max_m", scan.range_max_m);
    scan.range_m = values.list("range_m");
    const auto index = static_cast<std::size_t>(laser - lasers.begin());
    if (const std::size_t beams = robot.body.sensors<world::Lasers>()[index].beams; scan.range_m.size() != beams)
      throw written.bad("expected range_m with the " + std::to_string(beams) + " ranges of laser '" + *laser +
                        "', found " + std::to_string(scan.range_m.size()));
    scans[index] = std::move(scan);
  }
}

}  // namespace waitpoint::outside
