// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/fcl_world.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "world/fcl/vehicle_world.hpp"
#include "world/motion/contact_loop.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/footprints.hpp"
#include "world/start_check.hpp"

namespace waitpoint::world {
namespace {

Footprints footprints_of(const WorldDescription& description) {
  return Footprints(description.engine == Engine::slice ? shapes_of(description.obstacles) : std::vector<Shape>{});
}

/// The heights that a solid has during a step, and a little more if it climbs; else exactly its own, so that what
/// stands on another, or under it, does not meet it.
Heights swept_heights(const Heights& at_start, double climb_m) {
  if (climb_m == 0) return at_start;
  const double low = std::min(climb_m, 0.0), high = std::max(climb_m, 0.0);
  return {at_start.low_m + low - 2 * contact_gap_m, at_start.high_m + high + 2 * contact_gap_m};
}

class FclWorld final : public VehicleWorld {
 public:
  FclWorld(const WorldDescription& description, std::uint64_t seed);

  void step() override;
  void reset(std::uint64_t seed) override;

  std::optional<std::string> move_body(BodyId id, const Pose& pose) override;
  std::optional<std::string> put_obstacle(const Obstacle& obstacle) override;
  bool remove_obstacle(const std::string& name) override;
  std::optional<std::string> push(const std::string&, Point, Duration) override {
    return "there are no forces in a kinematic world";
  }

  std::span<const LooseState> loose() const override { return {}; }

 private:
  void latch();
  void move();
  void find_meetings(std::uint32_t body, double path_max_m, double climb_max_m);
  void publish();

  void change_obstacles(std::vector<Obstacle> obstacles);

  std::optional<std::vector<Obstacle>> first_obstacles_;  // of the start, once they have been changed
  Footprints footprints_;                                 // the same obstacles; none where FCL finds neighbours

  // Buffers of one call, kept so that steps allocate nothing.
  ContactLoop contacts_;
  std::vector<Arc> arcs_;
  std::vector<Mover> movers_;
  std::vector<std::uint32_t> near_;
};

FclWorld::FclWorld(const WorldDescription& description, std::uint64_t seed)
    : VehicleWorld(description, shapes_of(description.obstacles), shapes_of(description.bodies)),
      footprints_(footprints_of(description)) {
  reset(seed);
}

void FclWorld::reset(std::uint64_t seed) {
  steps_ = 0;
  if (first_obstacles_) {
    change_obstacles(*first_obstacles_);
    first_obstacles_.reset();
  }
  vehicles_.clear();
  for (const BodyDescription& body : description_.bodies) vehicles_.emplace_back(body, seed);
  senses_.restart(seed);
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) senses_.place(i, vehicles_[i]);
}

void FclWorld::step() {
  ++steps_;
  latch();
  move();
  publish();
}

void FclWorld::latch() {
  arcs_.clear();
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    Vehicle& vehicle = vehicles_[i];
    if (vehicle.state().arc.moves()) senses_.place(i, vehicle);
    arcs_.push_back(vehicle.latch(steps_, description_.step));
  }
}

void FclWorld::move() {
  contacts_.clear();
  movers_.clear();
  double path_max_m = 0, climb_max_m = 0;
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    const Vehicle& vehicle = vehicles_[i];
    movers_.emplace_back(vehicle.description().shape, vehicle.outline(), arcs_[i], vehicle.state().height_m);
    contacts_.add_body(movers_[i]);
    path_max_m = std::max(path_max_m, movers_[i].path_m());
    climb_max_m = std::max(climb_max_m, std::fabs(movers_[i].climb_m()));
  }
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    if (movers_[i].moves()) find_meetings(i, path_max_m, climb_max_m);
  }
  contacts_.run();
}

void FclWorld::find_meetings(std::uint32_t body, double path_max_m, double climb_max_m) {
  const Mover& mover = movers_[body];
  const Heights heights = swept_heights(mover.heights(), mover.climb_m());
  const Bounds swept = bounds_of(mover.start()).grown(mover.path_m() + 2 * contact_gap_m);
  if (description_.engine == Engine::slice)
    footprints_.near(swept, Scene::padding_m, heights.low_m, heights.high_m, near_);
  else
    senses_.standing().near(swept, heights.low_m, heights.high_m, near_);
  for (const std::uint32_t obstacle : near_) {
    const Shape& shape = description_.obstacles[obstacle].shape;
    contacts_.add_obstacle(body, senses_.standing().outline(obstacle), {shape.z_low_m, shape.z_high_m});
  }
  if (vehicles_.size() == 1) return;
  // The others may climb too.
  const double margin_m = climb_max_m > 0 ? climb_max_m + 2 * contact_gap_m : 0;
  senses_.movers().near(swept.grown(path_max_m), heights.low_m - margin_m, heights.high_m + margin_m, near_);
  for (const std::uint32_t other : near_) {
    // Of two that both move, the first asks.
    if (other > body || (other != body && !movers_[other].moves())) contacts_.add_pair(body, other);
  }
}

void FclWorld::publish() {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    vehicles_[i].publish(steps_, description_.step, arcs_[i], contacts_.stop(i));
    senses_.moved(i, vehicles_[i], steps_);
  }
}

std::optional<std::string> FclWorld::move_body(BodyId id, const Pose& pose) {
  const std::uint32_t own = number(id);
  Vehicle& vehicle = vehicles_.at(index(id));
  const Shape shape = vehicle.shape();
  const Outline outline = outline_of(shape, pose);
  senses_.standing().near(bounds_of(outline).grown(2 * contact_gap_m), shape.z_low_m, shape.z_high_m, near_);
  for (const std::uint32_t obstacle : near_) {
    if (separation(outline, senses_.standing().outline(obstacle)).distance_m <= contact_gap_m)
      return description_.obstacles[obstacle].name;
  }
  if (auto other = body_met(shape, outline, own)) return other;
  vehicle.put(pose);
  senses_.put(own, pose);
  // To the others' sensors it stands there already, as if it had been published so at the last step but one.
  senses_.place(own, vehicle);
  return std::nullopt;
}

std::optional<std::string> FclWorld::put_obstacle(const Obstacle& obstacle) {
  if (auto body = body_met(obstacle.shape, outline_of(obstacle.shape), Scene::none)) return body;
  std::vector<Obstacle> obstacles = description_.obstacles;
  const std::size_t place = find_obstacle(obstacle.name);
  if (place < obstacles.size())
    obstacles[place] = obstacle;
  else
    obstacles.push_back(obstacle);
  change_obstacles(std::move(obstacles));
  return std::nullopt;
}

bool FclWorld::remove_obstacle(const std::string& name) {
  const std::size_t place = find_obstacle(name);
  std::vector<Obstacle> obstacles = description_.obstacles;
  if (place == obstacles.size()) return false;
  obstacles.erase(obstacles.begin() + static_cast<std::ptrdiff_t>(place));
  change_obstacles(std::move(obstacles));
  return true;
}

// All anew: a person's hand is slow.
void FclWorld::change_obstacles(std::vector<Obstacle> obstacles) {
  if (!first_obstacles_) first_obstacles_ = description_.obstacles;
  description_.obstacles = std::move(obstacles);
  senses_.stand(shapes_of(description_.obstacles));
  footprints_ = footprints_of(description_);
}

}  // namespace

std::unique_ptr<World> make_fcl_world(const WorldDescription& description, std::uint64_t seed) {
  return std::make_unique<FclWorld>(description, seed);
}

}  // namespace waitpoint::world
