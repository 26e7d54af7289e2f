// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/world_server.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/number_text.hpp"
#include "core/printable_line.hpp"
#include "modules/outside/sensor_times.hpp"
#include "modules/outside/words.hpp"
#include "modules/run/intervention.hpp"
#include "modules/scenario/words.hpp"

namespace waitpoint::outside {
namespace {

constexpr const char* server = "world";

std::string base(const world::World& world, world::BodyId id) {
  const world::OdometerReading& odometer = world.odometer(id);
  const world::BatteryState battery = world.battery(id);
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
    if (word != "command" && word != "laser")
      throw written.bad("expected 'robot', 'command' or 'laser', found '" + word + "'");
    if (!client.robot) throw written.bad("expected 'robot NAME' before '" + word + "'");
    if (word == "laser") return switch_laser(client, line, written);
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
  client.lasers.resize(scenario_.robots[index].laser_names.size());
  client.lines.send("attached " + quoted_word(robot) + "\n");
  host.tell(robot, "attached to software outside");
}

void WorldServer::switch_laser(Client& client, std::string_view words, const scenario::Location& written) {
  const std::string laser = scenario::take_word(words, written), state = scenario::take_word(words, written);
  scenario::require_end(words, written);
  const std::vector<std::string>& names = scenario_.robots[*client.robot].laser_names;
  const auto found = std::find(names.begin(), names.end(), laser);
  if (found == names.end()) throw written.bad("'" + name(client) + "' has no laser '" + laser + "'");
  if (state != "on" && state != "off") throw written.bad("expected on or off, found '" + state + "'");
  client.lasers[static_cast<std::size_t>(found - names.begin())].on = state == "on";
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
  for (std::size_t i = 0; i < client.lasers.size(); ++i)
    if (client.lasers[i].on &&
        is_due(scenario_.robots[*client.robot].body.sensors<world::Lasers>()[i].period, scenario_.step, world.steps()))
      lines += scan(client, i, world);
  const Time now = Time() + scenario_.step * static_cast<std::int64_t>(world.steps());
  return lines + "step " + to_string(now) + "\n";
}

std::string WorldServer::scan(Client& client, std::size_t laser, const world::World& world) const {
  world::LaserScan scan;
  world.scan(world::BodyId(*client.robot), laser, ++client.lasers[laser].scans, scan);
  return fmt::format("scan laser={} number={} first_angle_rad={} angle_step_rad={} range_max_m={} range_m={}\n",
                     scenario_.robots[*client.robot].laser_names[laser], client.lasers[laser].scans,
                     scan.first_angle_rad, scan.angle_step_rad, scan.range_max_m, fmt::join(scan.range_m, ","));
}

std::string WorldServer::account() const {
  return "world: " + counted(connections_, "connection") + ", " + counted(commands_, "command") + faults_.text();
}

}  // namespace waitpoint::outside
