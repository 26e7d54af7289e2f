// SPDX-License-Identifier: BSD-3-Clause
#include "modules/outside/remote_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/printable_line.hpp"
#include "modules/outside/line_stream.hpp"
#include "modules/outside/remote_readings.hpp"
#include "modules/outside/words.hpp"

namespace waitpoint::outside {
namespace {

constexpr const char* elsewhere = "the world is in another process";

std::string require_line(LineStream& lines, const std::string& where) {
  std::string line;
  while (!lines.take(line)) {
    if (lines.is_over()) throw BadInput(where, "expected a world's server, which ended the connection");
    lines.receive();
  }
  return line;
}

}  // namespace

/// A robot of the scenario, and its connection if it has software.
struct RemoteWorld::Attached {
  explicit Attached(const scenario::RobotScenario& robot) : scenario(robot), readings(robot) {}

  const scenario::RobotScenario& scenario;
  std::optional<LineStream> lines;
  RemoteReadings readings;
  std::set<std::string> on;  // the sensors that were asked for
};

RemoteWorld::RemoteWorld(const scenario::Scenario& scenario, const world::WorldDescription& description,
                         const Endpoint& endpoint, const std::string& where, std::atomic<bool>& ended)
    : description_(description), ended_(ended) {
  for (const scenario::RobotScenario& robot : scenario.robots) {
    robots_.push_back(std::make_unique<Attached>(robot));
    const bool has_software =
        std::any_of(robot.modules.begin(), robot.modules.end(), [](const auto& module) { return module.enabled; });
    if (!has_software) continue;
    attach(*robots_.back(), endpoint, where);
  }
}

RemoteWorld::~RemoteWorld() = default;

void RemoteWorld::attach(Attached& robot, const Endpoint& endpoint, const std::string& where) {
  LineStream& lines = robot.lines.emplace(connect_to(endpoint, where));
  const std::string greeting = require_line(lines, where);
  if (!greeting.starts_with("waitpoint world 1 "))
    throw BadInput(where, "expected a world's server, found '" + printable_line(greeting) + "'");
  const std::string step = fmt::format(" step_s={}", description_.step.seconds());
  if (!greeting.ends_with(step)) throw BadInput(where, "expected a world with" + step + ", found: " + greeting);
  lines.send("robot " + quoted_word(robot.scenario.name) + "\n");
  const std::string answer = require_line(lines, where);
  if (!answer.starts_with("attached ")) throw BadInput(where, printable_line(answer));
}

void RemoteWorld::command(world::BodyId id, world::Velocity velocity) {
  if (attached(id).lines)
    attached(id).lines->send(fmt::format("command v_m_s={} w_rad_s={} side_m_s={} climb_m_s={}\n", velocity.v_m_s,
                                         velocity.w_rad_s, velocity.side_m_s, velocity.climb_m_s));
}

void RemoteWorld::step() {
  ++steps_;
  for (const auto& robot : robots_) {
    if (!robot->lines) continue;
    const std::uint64_t before = robot->readings.steps;
    while (robot->readings.steps == before && read(*robot)) {
    }
  }
}

bool RemoteWorld::read(Attached& robot) const {
  LineStream& lines = *robot.lines;
  if (ended_) return false;
  lines.receive();
  std::string line;
  try {
    while (lines.take(line)) {
      if (line.starts_with("refused: ")) throw BadInput("the world's server", line);
      robot.readings.take(line, {"the world's server", lines.lines()});
    }
    if (lines.is_over()) throw BadInput("the world's server", "ended the connection of '" + robot.scenario.name + "'");
  } catch (const BadInput& error) {
    ended_ = true;
    std::fprintf(stderr, "waitpoint: %s\n", printable_message(error.what()).c_str());
  }
  return !ended_;
}

void RemoteWorld::switch_on(Attached& robot, const std::string& sensor) const {
  if (robot.lines && robot.on.insert(sensor).second) robot.lines->send("sensor " + quoted_word(sensor) + " on\n");
}

void RemoteWorld::expect_scan(world::BodyId id, std::size_t laser, std::uint64_t) {
  switch_on(attached(id), attached(id).scenario.device_name<world::Lasers>(laser));
}

template <class S>
bool RemoteWorld::read_sensor(Attached& robot, std::size_t device, typename S::Reading& reading) const {
  std::optional<typename S::Reading>& last = robot.readings.of<S>()[device];
  if (!std::is_same_v<S, world::Battery>) switch_on(robot, robot.scenario.device_name<S>(device));
  if constexpr (world::HasCommand<S>)
    while (!last && robot.lines && read(robot)) {
    }
  if (!last) return false;
  if constexpr (!world::ReadOnDemand<S>)
    if (last->number == reading.number) return false;
  const Time date = reading.date;
  reading = *last;
  reading.date = date;
  return true;
}

bool RemoteWorld::read_any(world::BodyId id, std::size_t device, std::uint64_t, const world::AnyReadingOut& out) const {
  return std::visit(
      [&]<class S>(const world::ReadingOut<S>& of) { return read_sensor<S>(attached(id), device, *of.reading); }, out);
}

const world::BodyState& RemoteWorld::body(world::BodyId id) const { return attached(id).readings.body; }
const world::OdometerReading& RemoteWorld::odometer(world::BodyId id) const { return attached(id).readings.odometer; }

// --- interventions, which are the run's ---

void RemoteWorld::reset(std::uint64_t) { WAITPOINT_CHECK(false, "a world of another process is reset"); }
void RemoteWorld::reseed(std::uint64_t) { WAITPOINT_CHECK(false, "a world of another process is given a seed"); }

std::optional<std::string> RemoteWorld::move_body(world::BodyId, const Pose&) { return elsewhere; }
std::optional<std::string> RemoteWorld::guide_body(world::BodyId, const std::optional<Pose>&, const world::Velocity&) {
  return elsewhere;
}
std::optional<std::string> RemoteWorld::put_obstacle(const world::Obstacle&) { return elsewhere; }
std::optional<std::string> RemoteWorld::push(const std::string&, Point, Duration) { return elsewhere; }

}  // namespace waitpoint::outside
