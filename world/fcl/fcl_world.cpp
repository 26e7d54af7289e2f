// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/fcl_world.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "world/fcl/senses.hpp"
#include "world/motion/contact_loop.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/footprints.hpp"
#include "world/start_check.hpp"
#include "world/vehicles/vehicle.hpp"

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

std::uint32_t number(BodyId id) { return static_cast<std::uint32_t>(id); }

class FclWorld final : public World {
 public:
  FclWorld(const WorldDescription& description, std::uint64_t seed);

  const WorldDescription& description() const override { return description_; }
  void command(BodyId id, Velocity velocity) override { vehicles_.at(index(id)).command(velocity, steps_); }
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  void reset(std::uint64_t seed) override;

  std::optional<std::string> move_body(BodyId id, const Pose& pose) override;
  std::optional<std::string> put_obstacle(const Obstacle& obstacle) override;
  bool remove_obstacle(const std::string& name) override;
  std::optional<std::string> push(const std::string&, Point, Duration) override {
    return "there are no forces in a kinematic world";
  }

  const BodyState& body(BodyId id) const override { return vehicles_.at(index(id)).state(); }
  std::span<const LooseState> loose() const override { return {}; }
  const OdometerReading& odometer(BodyId id) const override { return vehicles_.at(index(id)).odometer(); }
  BatteryState battery(BodyId id) const override { return vehicles_.at(index(id)).battery(elapsed_s()); }
  const ImuSample& imu(BodyId id) const override { return senses_.imu(number(id)); }
  const PositionFix& position_fix(BodyId id) const override { return senses_.position_fix(number(id)); }

  void scan(BodyId id, std::size_t laser, std::uint64_t scan_number, LaserScan& out) const override {
    senses_.scan(vehicles_.at(index(id)), number(id), laser, scan_number, elapsed_s(), out);
  }
  void sonar(BodyId id, std::size_t ring, std::uint64_t firing_number, std::vector<double>& range_m) const override {
    senses_.sonar(vehicles_.at(index(id)), number(id), ring, firing_number, range_m);
  }
  std::uint32_t bumpers(BodyId id) const override { return senses_.bumpers(vehicles_.at(index(id)), number(id)); }
  void infrareds(BodyId id, std::uint64_t reading_number, std::vector<double>& volts) const override {
    senses_.infrareds(vehicles_.at(index(id)), number(id), reading_number, volts);
  }
  double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const override {
    return senses_.cast(beam, range_max_m, own);
  }

 private:
  double elapsed_s() const { return static_cast<double>(steps_) * step_s_; }
  void latch();
  void move();
  void find_meetings(std::uint32_t body, double path_max_m, double climb_max_m);
  void publish();

  std::vector<Obstacle>::iterator find_obstacle(const std::string& name);
  void change_obstacles(std::vector<Obstacle> obstacles);
  std::optional<std::string> body_met(const Shape& shape, const Outline& outline, std::uint32_t except) const;

  WorldDescription description_;
  std::optional<std::vector<Obstacle>> first_obstacles_;  // of the start, once they have been changed
  const double step_s_;
  std::uint64_t steps_ = 0;
  std::vector<Vehicle> vehicles_;
  Senses senses_;          // bodies as published at the last step but one: where the last step began
  Footprints footprints_;  // the same obstacles; none where FCL finds neighbours

  // Buffers of one call, kept so that steps allocate nothing.
  ContactLoop contacts_;
  std::vector<Arc> arcs_;
  std::vector<Mover> movers_;
  std::vector<std::uint32_t> near_;
};

FclWorld::FclWorld(const WorldDescription& description, std::uint64_t seed)
    : description_(description),
      step_s_(description.step.seconds()),
      senses_(description_, shapes_of(description_.obstacles), shapes_of(description_.bodies)),
      footprints_(footprints_of(description)) {
  WAITPOINT_CHECK(step_s_ > 0, "a world steps by a positive period");
  WAITPOINT_CHECK(start_overlaps(description_).empty(), "a body starts inside something solid");
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

std::optional<std::string> FclWorld::body_met(const Shape& shape, const Outline& outline, std::uint32_t except) const {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    const Vehicle& other = vehicles_[i];
    if (i != except && heights_overlap(shape, other.shape()) &&
        separation(outline, other.outline()).distance_m <= contact_gap_m)
      return other.description().name;
  }
  return std::nullopt;
}

std::vector<Obstacle>::iterator FclWorld::find_obstacle(const std::string& name) {
  std::vector<Obstacle>& all = description_.obstacles;
  return std::find_if(all.begin(), all.end(), [&](const Obstacle& obstacle) { return obstacle.name == name; });
}

std::optional<std::string> FclWorld::put_obstacle(const Obstacle& obstacle) {
  if (auto body = body_met(obstacle.shape, outline_of(obstacle.shape), Scene::none)) return body;
  std::vector<Obstacle> obstacles = description_.obstacles;
  const auto place = find_obstacle(obstacle.name) - description_.obstacles.begin();
  if (static_cast<std::size_t>(place) < obstacles.size())
    obstacles[static_cast<std::size_t>(place)] = obstacle;
  else
    obstacles.push_back(obstacle);
  change_obstacles(std::move(obstacles));
  return std::nullopt;
}

bool FclWorld::remove_obstacle(const std::string& name) {
  const auto place = find_obstacle(name);
  if (place == description_.obstacles.end()) return false;
  std::vector<Obstacle> obstacles = description_.obstacles;
  obstacles.erase(obstacles.begin() + (place - description_.obstacles.begin()));
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
