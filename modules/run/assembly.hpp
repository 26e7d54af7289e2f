// SPDX-License-Identifier: BSD-3-Clause
// What a scenario describes, put together and checked: a world, and the robots in it with their software. Nothing runs
// yet; an Experiment carries it out in virtual time, a ThreadedExperiment by threads, real ones or not.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/formats/world_file.hpp"
#include "world/world.hpp"

namespace waitpoint::run {

class Assembly {
 public:
  /// Everything that can be wrong with the input is found here, as BadInput. The scenario and the network, null where
  /// there is none, must outlive the assembly.
  Assembly(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types, io::Network* network,
           std::uint64_t seed);

  const scenario::Scenario& scenario() const { return scenario_; }
  world::World& world() { return *world_; }
  const world::World& world() const { return *world_; }
  /// In the order of the scenario.
  const std::vector<std::unique_ptr<bridge::Robot>>& robots() const { return robots_; }
  /// Goals reached so far, and all there are.
  std::size_t goals_reached() const;
  std::size_t goals() const;

  /// What has come out so far: of the robots, and the warnings. What is the run's to know is left out.
  bridge::RunResult result() const;

 private:
  std::shared_ptr<const world::WorldFile> load(scenario::MapFile map);
  void make_world(const world::WorldDescription& description, std::uint64_t seed);
  void check_step();

  const scenario::Scenario& scenario_;
  std::vector<std::string> warnings_;
  std::unique_ptr<world::World> world_;
  std::vector<std::unique_ptr<bridge::Robot>> robots_;
};

}  // namespace waitpoint::run
