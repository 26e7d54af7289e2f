// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/remote_readings.hpp"

#include "modules/outside/reading_words.hpp"

namespace waitpoint::outside {
namespace {

void check(const world::LaserDescription& laser, const Values& values, const std::string& name,
           const scenario::Location& written) {
  if (const std::size_t beams = values.list("range_m").size(); beams != laser.beams)
    throw written.bad("expected range_m with the " + std::to_string(laser.beams) + " ranges of laser '" + name +
                      "', found " + std::to_string(beams));
}
void check(const auto&, const Values&, const std::string&, const scenario::Location&) {}

}  // namespace

RemoteReadings::RemoteReadings(const scenario::RobotScenario& robot) : robot_(robot) {
  body.pose = robot.body.start;
  world::Sensors::for_each([&]<class S>() { of<S>().resize(robot.body.equipment.count<S>()); });
}

void RemoteReadings::take(std::string_view line, const scenario::Location& written) {
  const std::string word = scenario::take_word(line, written);
  if (word == "step") ++steps;
  if (word != "base" && word != "truth" && word != "scan" && word != "reading") return;
  const Values values(line, written);
  if (word == "base") {
    world::Battery::Reading battery;
    values.read("travel_units", odometer.travel_units);
    values.read("turn_units", odometer.turn_units);
    values.read("side_units", odometer.side_units);
    values.read("v_m_s", odometer.velocity.v_m_s);
    values.read("w_rad_s", odometer.velocity.w_rad_s);
    values.read("volts", battery.volts);
    values.read("current_a", battery.current_a);
    values.read("charge", battery.charge);
    values.read("stalled", body.stalled);
    values.read("height_m", body.height_m);
    of<world::Battery>()[0] = battery;
  } else if (word == "truth") {
    values.read("x_m", body.pose.x);
    values.read("y_m", body.pose.y);
    values.read("heading_rad", body.pose.heading);
    values.read("travelled_m", body.travelled_m);
    values.read("collisions", body.collisions);
  } else {
    take_reading(word == "scan" ? "laser" : "sensor", values, written);
  }
}

void RemoteReadings::take_reading(std::string_view kind, const Values& values, const scenario::Location& written) {
  const std::string name(values.text(kind));
  bool is_known = false;
  world::Sensors::for_each([&]<class S>() {
    for (std::size_t i = 0; i < of<S>().size() && !is_known; ++i) {
      is_known = robot_.device_name<S>(i) == name;
      if (!is_known) continue;
      check(robot_.body.equipment.description<S>(i), values, name, written);
      values.read(of<S>()[i].emplace());
    }
  });
  if (!is_known) throw written.bad("there is no " + std::string(kind) + " '" + name + "'");
}

}  // namespace waitpoint::outside
