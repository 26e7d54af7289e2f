// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/bench/kernel/meter.hpp"
#include "tests/bench/world/crowds.hpp"
#include "tests/bench/world/grounds.hpp"
#include "world/kinematic/kinematic_world.hpp"

namespace waitpoint::bench {
namespace {

using namespace std::chrono_literals;

constexpr double square_m = 3;  // a robot and an obstacle on each
constexpr Duration step = 50ms, period = 100ms;

world::BodyDescription robot(const std::string& name, const Pose& start) {
  world::BodyDescription body;
  body.name = name;
  body.shape.kind = world::Shape::Kind::cylinder;
  body.shape.radius_m = 0.2;
  body.start = start;
  body.base.kind = world::BaseDescription::Kind::differential;
  world::LaserDescription ranger;
  ranger.beams = 12;
  ranger.field_of_view_rad = 2 * exact::pi * 11 / 12;
  ranger.range_max_m = 2;
  ranger.range_noise_m = ranger.resolution_m = 0;
  body.sensors<world::Lasers>() = {ranger};
  return body;
}

world::WorldDescription described(std::size_t robots) {
  const Place place = grounds(robots, square_m, robots);
  world::WorldDescription description;
  description.step = step;
  description.engine = world::Engine::slice;
  for (const world::Shape& shape : place.obstacles) description.obstacles.push_back({"", shape});
  for (std::size_t i = 0; i < robots; ++i)
    description.bodies.push_back(robot("r" + std::to_string(i), place.stations[i]));
  return description;
}

void drive(world::World& world, world::BodyId body) {
  world::Lasers::Reading scan;
  scan.range_m.resize(12);
  WorkingSet set;
  set.add_stack_below(1024);
  set.add(scan.range_m.begin(), scan.range_m.size() * sizeof(float));
  world.add_to(set, body);
  world.add_scan_to(set, body);
  this_thread::set_working_set(set);
  for (std::uint64_t number = 1;; ++number) {
    world.read<world::Lasers>(body, number, scan);
    const double ahead_m = std::min({scan.range_m[4], scan.range_m[5], scan.range_m[6], scan.range_m[7]});
    world.command(body, ahead_m > 0.6 ? world::Velocity{0.5, 0} : world::Velocity{0, 0.8});
    this_thread::sleep_until(Time() + period * static_cast<std::int64_t>(number));
  }
}

struct Cost {
  double us;  // per robot and simulated second
  double resident_gb;
};

Cost cost(std::size_t robots, Duration warm, Duration measured) {
  const std::unique_ptr<world::World> world = world::make_kinematic_world(described(robots), 1);
  Simulation simulation;
  simulation.spawn(simulation.environment(), {.name = "world", .phase = kernel::Phase::world, .service = true}, [&] {
    for (std::int64_t k = 1;; ++k) {
      this_thread::sleep_until(Time() + step * k);
      world->step();
    }
  });
  for (std::size_t i = 0; i < robots; ++i) {
    const kernel::SpawnOptions options = {.name = "drive", .stack = kernel::StackSize::small};
    simulation.spawn(simulation.environment(), options, [&world = *world, i] { drive(world, world::BodyId(i)); });
  }
  simulation.run_before(Time() + warm);
  const std::int64_t from = clock_ns(Clock::processor);
  simulation.run_before(Time() + warm + measured);
  const double robot_s = static_cast<double>(robots) * measured.seconds();
  return {1e-3 * static_cast<double>(clock_ns(Clock::processor) - from) / robot_s,
          1e-9 * static_cast<double>(resident_bytes() + page_table_bytes())};
}

}  // namespace

void simple_robots(bool quick, Figures& figures) {
  double first_us = 0;
  for (const std::size_t robots : {1'000, 10'000, 100'000}) {
    const std::int64_t longer = quick ? 1 : 5;
    const Cost of = cost(robots, 1s, Duration(1s) * longer * (robots < 100'000 ? 4 : 1));
    Figure figure = {fmt::format("{} simple robots", robots), "waitpoint", of.us, "us robot s"};
    if (first_us > 0) figure.ratio = of.us / first_us;
    if (robots == 100'000) figure.must = Limit{2, true}, figure.aim = Limit{1.3, true};
    figures.add(figure);
    if (first_us == 0) first_us = of.us;
    if (robots == 100'000)
      figures.add({fmt::format("{} simple robots", robots), "waitpoint", of.resident_gb, "GB", {}, Limit{8, true}});
  }
}

}  // namespace waitpoint::bench
