// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/world_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/outside/reading_words.hpp"
#include "modules/outside/words.hpp"
#include "modules/run/intervention.hpp"
#include "modules/scenario/words.hpp"
#include "world/timed_sensor.hpp"

namespace waitpoint::outside {
namespace {

constexpr const char* server = "world";

std::string base(const world::World& world, world::BodyId id) {
  const world::OdometerReading& odometer = world.odometer(id);
  world::Battery::Reading battery;
  world.read<world::Battery>(id, 0, battery);
  const world::BodyState& body = world.body(id);
  return fmt::format(
      "base travel_units={} turn_units={} side_units={} v_m_s={} w_rad_s={} volts={} current_a={} charge={} stalled={} "
      "height_m={}\n",
      odometer.travel_units, odometer.turn_units, odometer.side_units, odometer.velocity.v_m_s,
      odometer.velocity.w_rad_s, battery.volts, battery.current_a, battery.charge, body.stalled ? 1 : 0, body.height_m);
}

std::string truth(const world::BodyState& body) {
  return fmt::format("truth x_m={} y_m={} heading_rad={} travelled_m={} collisions={}\n", body.pose.x, body.pose.y,
                     body.pose.heading, body.travelled_m, body.collisions);
}

}  // namespace

WorldServer::WorldServer(const scenario::Scenario& scenario, std::vector<std::string> taken, const Endpoint& endpoint,
                         const std::string& where)
    : scenario_(scenario), taken_(std::move(taken)), where_(where), listener_(endpoint, where) {}

void WorldServer::begin(Host& host) { host.tell(server, "served at " + listener_.endpoint().text()); }

std::string WorldServer::name(const Client& client) const {
  return client.robot ? scenario_.robots[*client.robot].name : server;
}

void WorldServer::take_in(Host& host) {
  while (Descriptor waiting = listener_.accept()) {
    ++connections_;
    clients_.push_back(std::make_unique<Client>(std::move(waiting)));
    clients_.back()->lines.send(
        fmt::format("waitpoint world 1 {} step_s={}\n", quoted_word(scenario_.name), scenario_.step.seconds()));
  }
  for (const auto& client : clients_) {
    client->lines.receive();
    std::string line;
    while (client->lines.take(line)) obey(*client, line, host);
    if (!client->command.empty()) {
      host.intervene(std::exchange(client->command, {}), {where_, 0});
      client->lines.send("taken at " + to_string(host.next_step()) + "\n");
      ++commands_;
    }
    if (client->lines.is_over()) end(*client, host);
  }
  std::erase_if(clients_, [](const auto& client) { return client->lines.is_over(); });
}

void WorldServer::obey(Client& client, std::string_view line, Host& host) {
  const scenario::Location written{listener_.endpoint().text(), client.lines.lines()};
  try {
    const std::string word = scenario::take_word(line, written);
    if (word.empty()) return;
    if (word == "robot") {
      const std::string robot = scenario::take_word(line, written);
      scenario::require_end(line, written);
      return attach(client, robot, written, host);
    }
    if (word != "command" && word != "laser" && word != "sensor")
      throw written.bad("expected 'robot', 'command' or 'sensor', found '" + word + "'");
    if (!client.robot) throw written.bad("expected 'robot NAME' before '" + word + "'");
    if (word != "command") return switch_sensor(client, word, line, written);
    const std::string command = "command " + quoted_word(name(client)) + std::string(line);
    client.command = run::parse_intervention(command, written).text;
  } catch (const BadInput& error) {
    const std::string text = printable_message(error.what());
    client.lines.send("refused: " + text + "\n");
    faults_.add("malformed");
    if (client.faults.add("malformed")) host.tell_fault(name(client), text);
  }
}

void WorldServer::attach(Client& client, const std::string& robot, const scenario::Location& written, Host& host) {
  if (client.robot) throw written.bad("'" + name(client) + "' is attached already");
  const std::size_t index = bridge::index_of(robot, host.experiment().robots(), written);
  if (std::find(taken_.begin(), taken_.end(), robot) != taken_.end())
    throw written.bad("'" + robot + "' is moved by position reports");
  for (const auto& other : clients_)
    if (other->robot == index) throw written.bad("'" + robot + "' is attached to another connection");
  for (const scenario::BridgeRow& row : scenario_.robots[index].bridge)
    if (row.device == "base.command")
      throw written.bad("'" + robot + "' is driven by its modules in this run: see " + row.written.text());
  client.robot = index;
  client.sensors = sensors_of(index);
  client.lines.send("attached " + quoted_word(robot) + "\n");
  host.tell(robot, "attached to software outside");
}

std::vector<WorldServer::Sensor> WorldServer::sensors_of(std::size_t index) const {
  const scenario::RobotScenario& robot = scenario_.robots[index];
  std::vector<Sensor> sensors;
  world::Sensors::for_each([&]<class S>() {
    constexpr bool is_laser = std::is_same_v<S, world::Lasers>;
    for (std::size_t i = 0; i < robot.body.equipment.count<S>(); ++i) {
      Sensor& sensor = sensors.emplace_back(Sensor{robot.device_name<S>(i), is_laser});
      sensor.lines = [begin = (is_laser ? "scan laser=" : "reading sensor=") + sensor.name, id = world::BodyId(index),
                      timed = world::TimedSensor<S>(i, robot.body.equipment.description<S>(i), scenario_.step)](
                         const world::World& world) mutable {
        std::string lines;
        timed.read(world, id, world.steps(), [&] { lines += begin + words_of(timed.reading()) + "\n"; });
        return lines;
      };
    }
  });
  return sensors;
}

void WorldServer::switch_sensor(Client& client, const std::string& kind, std::string_view words,
                                const scenario::Location& written) {
  const std::string wanted = scenario::take_word(words, written), state = scenario::take_word(words, written);
  scenario::require_end(words, written);
  const auto found = std::find_if(client.sensors.begin(), client.sensors.end(), [&](const Sensor& sensor) {
    return sensor.name == wanted && (kind == "sensor" || sensor.is_laser);
  });
  if (found == client.sensors.end()) throw written.bad("'" + name(client) + "' has no " + kind + " '" + wanted + "'");
  if (state != "on" && state != "off") throw written.bad("expected on or off, found '" + state + "'");
  found->is_on = state == "on";
}

// A base without a watchdog would drive on for ever.
void WorldServer::end(Client& client, Host& host) {
  if (!client.robot) return;
  host.intervene("command " + quoted_word(name(client)), {where_, 0});
  host.tell_fault(name(client), "the connection of its software ended" + client.faults.text() + ": it stops");
}

void WorldServer::publish(Host& host) {
  const world::World& world = host.experiment().world();
  if (published_ == world.steps()) return;
  published_ = world.steps();
  for (const auto& client : clients_) {
    if (!client->robot || client->lines.send(readings(*client, world))) continue;
    faults_.add("steps not read");
    if (client->faults.add("steps not read")) host.tell_fault(name(*client), "its software does not read the readings");
  }
}

std::string WorldServer::readings(Client& client, const world::World& world) const {
  const auto id = static_cast<world::BodyId>(*client.robot);
  std::string lines = base(world, id) + truth(world.body(id));
  for (Sensor& sensor : client.sensors)
    if (sensor.is_on) lines += sensor.lines(world);
  const Time now = Time() + scenario_.step * static_cast<std::int64_t>(world.steps());
  return lines + "step " + to_string(now) + "\n";
}

std::string WorldServer::account() const {
  return "world: " + counted(connections_, "connection") + ", " + counted(commands_, "command") + faults_.text();
}

}  // namespace waitpoint::outside
