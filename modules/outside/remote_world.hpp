// SPDX-License-Identifier: BSD-3-Clause
// The world of a run in another process (world_server.hpp), for robots' software on real threads: each robot with
// modules has a connection of its own. Sensors are switched on when they are first read.
//
// One thread uses it. step() waits for the next step of the other world. A connection that ends sets `ended`, and
// everything stays as it was.
#pragma once

#include <atomic>
#include <memory>
#include <string_view>
#include <vector>

#include "modules/outside/endpoint.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/world.hpp"

namespace waitpoint::outside {

class RemoteWorld final : public world::World {
 public:
  /// Attaches the robots. Throws BadInput at `where` for a world that does not have them, or another step.
  /// `ended` must outlive it.
  RemoteWorld(const scenario::Scenario& scenario, const world::WorldDescription& description, const Endpoint& endpoint,
              const std::string& where, std::atomic<bool>& ended);
  ~RemoteWorld() override;

  const world::WorldDescription& description() const override { return description_; }
  void command(world::BodyId id, world::Velocity velocity) override;
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  void reset(std::uint64_t seed) override;
  void reseed(std::uint64_t seed) override;

  std::optional<std::string> move_body(world::BodyId id, const Pose& pose) override;
  std::optional<std::string> guide_body(world::BodyId id, const std::optional<Pose>& to,
                                        const world::Velocity& velocity) override;
  std::optional<std::string> put_obstacle(const world::Obstacle& obstacle) override;
  bool remove_obstacle(const std::string&) override { return false; }
  std::optional<std::string> push(const std::string& name, Point force_n, Duration time) override;

  const world::BodyState& body(world::BodyId id) const override;
  std::span<const world::LooseState> loose() const override { return {}; }
  const world::OdometerReading& odometer(world::BodyId id) const override;
  void expect_scan(world::BodyId id, std::size_t laser, std::uint64_t scan_number) override;
  void add_to(WorkingSet&, world::BodyId) const override {}
  void add_scan_to(WorkingSet&, world::BodyId) const override {}
  double cast(const world::Beam&, double range_max_m, std::optional<world::BodyId>) const override {
    return range_max_m;
  }

 private:
  struct Attached;

  /// The last reading that came; waits for the first scan of a laser.
  bool read_any(world::BodyId id, std::size_t device, std::uint64_t number,
                const world::AnyReadingOut& out) const override;
  template <class S>
  bool read_sensor(Attached& robot, std::size_t device, typename S::Reading& reading) const;
  Attached& attached(world::BodyId id) const { return *robots_[index(id)]; }
  void attach(Attached& robot, const Endpoint& endpoint, const std::string& where);
  void switch_on(Attached& robot, const std::string& sensor) const;
  /// Reads received data, waiting for some; false if the connection has ended.
  bool read(Attached& robot) const;

  world::WorldDescription description_;
  std::atomic<bool>& ended_;
  std::vector<std::unique_ptr<Attached>> robots_;  // by body
  std::uint64_t steps_ = 0;
};

}  // namespace waitpoint::outside
