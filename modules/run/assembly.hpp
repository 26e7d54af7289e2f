// SPDX-License-Identifier: BSD-3-Clause
// A scenario assembled and checked: a world, and its robots with their software. An Experiment runs it in virtual time,
// a ThreadedExperiment on threads, real or simulated.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/run/ranks/placement.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/formats/world_file.hpp"
#include "world/world.hpp"

namespace waitpoint::run {

/// Makes the world for a description that has all obstacles and bodies.
using MakeWorld = std::function<std::unique_ptr<world::World>(const world::WorldDescription&)>;

class Assembly {
 public:
  /// Bad input of any kind is found here, as BadInput. The scenario and the network (null without one) must outlive the
  /// assembly. `make`: in the place of the scenario's engine.
  Assembly(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, io::Network* network,
           std::uint64_t seed, const Placement& placement = {}, const MakeWorld& make = nullptr);

  const scenario::Scenario& scenario() const { return scenario_; }
  world::World& world() { return *world_; }
  const world::World& world() const { return *world_; }
  /// In the order of the scenario.
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return robots_; }
  /// Goals reached so far, and the number of goals, over all robots.
  std::size_t goals_reached() const;
  std::size_t goals() const;

  /// The result so far of the robots, and the warnings; the run's own figures are left out.
  bridge::RunResult result() const;

 private:
  std::shared_ptr<const world::WorldFile> load(scenario::MapFile map);
  void make_world(const world::WorldDescription& description, std::uint64_t seed, const MakeWorld& make);
  void check_step();

  const scenario::Scenario& scenario_;
  std::vector<std::string> warnings_;
  std::unique_ptr<world::World> world_;
  std::vector<std::unique_ptr<bridge::Robot>> robots_;
};

}  // namespace waitpoint::run
