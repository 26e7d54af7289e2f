// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/bullet_world.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "world/bullet/drive_forces.hpp"
#include "world/bullet/dynamics.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/kinematic/vehicle_world.hpp"
#include "world/motion/first_contact.hpp"
#include "world/planar/separation.hpp"

namespace waitpoint::world {
namespace {

// The parts of a step for Bullet: without and with loose obstacles in motion. In one part no hull travels farther than
// Bullet's range of contacts (2 cm).
constexpr double part_s_max = 0.01, loose_part_s_max = 0.002, way_m_max = 0.015;
constexpr double parts_max = 1000;

/// Linear interpolation.
Velocity between(const Velocity& from, const Velocity& to, double fraction) {
  const auto part = [&](double a, double b) { return fraction == 1 ? b : a + fraction * (b - a); };
  return {part(from.v_m_s, to.v_m_s), part(from.w_rad_s, to.w_rad_s), part(from.side_m_s, to.side_m_s),
          part(from.climb_m_s, to.climb_m_s)};
}

std::vector<Shape> standing_shapes(const std::vector<Obstacle>& obstacles) {
  std::vector<Shape> shapes;
  for (const Obstacle& obstacle : obstacles)
    if (!obstacle.loose()) shapes.push_back(obstacle.shape);
  return shapes;
}

/// The motion of an obstacle; none for a new or fixed one.
using MaybeMoving = std::optional<LooseSolid>;

class BulletWorld final : public VehicleWorld {
 public:
  BulletWorld(const WorldDescription& description, std::uint64_t seed);

  void step() override;
  void reset(std::uint64_t seed) override;

  std::optional<std::string> move_body(BodyId id, const Pose& pose) override;
  std::optional<std::string> guide_body(BodyId, const std::optional<Pose>&, const Velocity&) override {
    return "bodies of a dynamic world are moved by forces";
  }
  std::optional<std::string> put_obstacle(const Obstacle& obstacle) override;
  bool remove_obstacle(const std::string& name) override;
  std::optional<std::string> push(const std::string& name, Point force_n, Duration time) override;

  std::span<const LooseState> loose() const override { return loose_; }

 private:
  /// A lasting force on the body or obstacle of that name.
  struct Push {
    std::string name;
    Point force_n;
    std::uint64_t last_step;
  };

  void show();
  void latch();
  void move();
  void exert(const Push& push);
  void publish();
  void publish_loose(std::uint32_t loose);
  std::uint64_t parts_of_step() const;

  std::vector<MaybeMoving> moving() const;
  void change_obstacles(std::vector<Obstacle> obstacles, const std::vector<MaybeMoving>& moving);
  void make_dynamics(const std::vector<MaybeMoving>& moving);

  const std::vector<Obstacle> first_obstacles_;
  std::optional<Dynamics> dynamics_;
  std::vector<DriveAim> forces_;  // per vehicle: its drive's
  std::vector<LooseState> loose_;
  std::vector<char> loose_moved_;  // in the last step
  std::vector<Push> pushes_;

  // Of one step.
  std::vector<Velocity> from_;
  std::vector<Arc> arcs_;
};

BulletWorld::BulletWorld(const WorldDescription& description, std::uint64_t seed)
    : VehicleWorld(description, {}, {}), first_obstacles_(description.obstacles) {
  WAITPOINT_CHECK(loose_overlaps(description_).empty(), "something loose starts inside something solid");
  for (const BodyDescription& body : description_.bodies) forces_.push_back(forces_of(body));
  reset(seed);
}

void BulletWorld::reset(std::uint64_t seed) {
  steps_ = 0;
  pushes_.clear();
  vehicles_.clear();
  for (const BodyDescription& body : description_.bodies) vehicles_.emplace_back(body, seed);
  senses_.restart(seed);
  change_obstacles(first_obstacles_, std::vector<MaybeMoving>(first_obstacles_.size()));
}

void BulletWorld::change_obstacles(std::vector<Obstacle> obstacles, const std::vector<MaybeMoving>& moving) {
  description_.obstacles = std::move(obstacles);
  senses_.stand(standing_shapes(description_.obstacles));
  make_dynamics(moving);
  std::vector<Shape> movers = shapes_of(description_.bodies);
  for (const LooseState& loose : loose_) movers.push_back(description_.obstacles[loose.obstacle].shape);
  senses_.move(movers);
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) senses_.place(i, vehicles_[i]);
}

// Rebuilds everything, in the order of the description: interventions are rare.
void BulletWorld::make_dynamics(const std::vector<MaybeMoving>& moving) {
  dynamics_.emplace(standing_shapes(description_.obstacles), description_.meshes);
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    const BodyDescription& body = description_.bodies[i];
    dynamics_->add_hull(body.shape, body.base.mass_kg, body.base.kind == BaseDescription::Kind::aerial);
    dynamics_->place_hull(i, vehicles_[i].state().pose, vehicles_[i].state().height_m);
    dynamics_->set_velocity(i, vehicles_[i].state().velocity);
  }
  loose_.clear();
  for (std::uint32_t k = 0; k < description_.obstacles.size(); ++k) {
    const Obstacle& obstacle = description_.obstacles[k];
    if (!obstacle.loose()) continue;
    dynamics_->add_loose(moving[k] ? *moving[k] : loose_solid(obstacle.shape, obstacle.mass_kg, obstacle.friction));
    loose_.emplace_back().obstacle = k;
    publish_loose(static_cast<std::uint32_t>(loose_.size() - 1));
  }
  loose_moved_.assign(loose_.size(), true);
}

void BulletWorld::step() {
  ++steps_;
  show();
  latch();
  move();
  publish();
  senses_.make_expected_scans(vehicles_, elapsed_s());
}

// Shows sensors the poses published by the last step.
void BulletWorld::show() {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i)
    if (vehicles_[i].state().arc.moves()) senses_.place(i, vehicles_[i]);
  for (std::uint32_t i = 0; i < loose_.size(); ++i) {
    if (!loose_moved_[i]) continue;
    const Shape& shape = description_.obstacles[loose_[i].obstacle].shape;
    senses_.place(static_cast<std::uint32_t>(vehicles_.size()) + i, outline_of(shape), shape.z_low_m, shape.z_high_m);
  }
}

void BulletWorld::latch() {
  from_.clear();
  arcs_.clear();
  for (Vehicle& vehicle : vehicles_) {
    from_.push_back(nearest_held(vehicle.description().base, vehicle.state().velocity));
    arcs_.push_back(vehicle.latch(steps_, description_.step));
  }
}

void BulletWorld::move() {
  const std::uint64_t parts = parts_of_step();
  const double part_s = step_s_ / static_cast<double>(parts);
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i)
    dynamics_->place_hull(i, vehicles_[i].state().pose, vehicles_[i].state().height_m);
  // A drive's target for the end of the step is interpolated over the parts.
  for (std::uint64_t part = 1; part <= parts; ++part) {
    const double fraction = static_cast<double>(part) / static_cast<double>(parts);
    for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
      DriveAim aim = forces_[i];
      aim.velocity = between(from_[i], vehicles_[i].state().velocity, fraction);
      dynamics_->aim(i, aim, part_s);
    }
    for (const Push& push : pushes_) exert(push);
    dynamics_->step(part_s);
  }
  std::erase_if(pushes_, [this](const Push& push) { return push.last_step <= steps_; });
}

std::uint64_t BulletWorld::parts_of_step() const {
  double way_m = 0;
  for (const BodyDescription& body : description_.bodies) way_m = std::max(way_m, body.base.v_max_m_s * step_s_);
  const double longest_s = dynamics_->any_awake() ? loose_part_s_max : part_s_max;
  const double parts = std::max(step_s_ / longest_s, way_m / way_m_max);
  return static_cast<std::uint64_t>(std::clamp(std::ceil(parts - 1e-9), 1.0, parts_max));
}

void BulletWorld::exert(const Push& push) {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i)
    if (description_.bodies[i].name == push.name) return dynamics_->push_hull(i, push.force_n);
  for (std::uint32_t i = 0; i < loose_.size(); ++i)
    if (description_.obstacles[loose_[i].obstacle].name == push.name) return dynamics_->push_loose(i, push.force_n);
}

void BulletWorld::publish() {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    vehicles_[i].publish(steps_, description_.step, arcs_[i], dynamics_->motion(i));
    senses_.moved(i, vehicles_[i], steps_);
  }
  for (std::uint32_t i = 0; i < loose_.size(); ++i) {
    // An obstacle that fell asleep in this step may have moved in it.
    const bool awake = dynamics_->awake(i);
    if (awake || loose_moved_[i]) publish_loose(i);
    loose_moved_[i] = awake;
  }
}

void BulletWorld::publish_loose(std::uint32_t number) {
  const LooseSolid& solid = dynamics_->loose(number);
  LooseState& state = loose_[number];
  Shape& shape = description_.obstacles[state.obstacle].shape;
  shape = upright_shape(solid);
  state.pose = shape.pose;
  state.low_m = shape.z_low_m;
  state.high_m = shape.z_high_m;
  state.velocity_m_s = {solid.velocity_m_s.x, solid.velocity_m_s.y};
  state.climb_m_s = solid.velocity_m_s.z;
  state.w_rad_s = solid.spin_rad_s.z;
}

// --- interventions ---

std::optional<std::string> BulletWorld::move_body(BodyId id, const Pose& pose) {
  Vehicle& vehicle = vehicles_.at(index(id));
  const Shape shape = vehicle.shape();
  const Outline outline = outline_of(shape, pose);
  for (const Obstacle& obstacle : description_.obstacles) {
    if (heights_overlap(shape, obstacle.shape) &&
        separation(outline, outline_of(obstacle.shape)).distance_m <= contact_gap_m)
      return obstacle.name;
  }
  if (auto mesh = mesh_met(shape, outline)) return mesh;
  if (auto other = body_met(shape, outline, number(id))) return other;
  vehicle.put(pose);
  senses_.put(number(id), pose);
  senses_.place(number(id), vehicle);
  dynamics_->place_hull(number(id), pose, vehicle.state().height_m);
  dynamics_->set_velocity(number(id), {});
  return std::nullopt;
}

std::vector<MaybeMoving> BulletWorld::moving() const {
  std::vector<MaybeMoving> moving(description_.obstacles.size());
  for (std::uint32_t i = 0; i < loose_.size(); ++i) moving[loose_[i].obstacle] = dynamics_->loose(i);
  return moving;
}

std::optional<std::string> BulletWorld::put_obstacle(const Obstacle& obstacle) {
  if (auto body = body_met(obstacle.shape, outline_of(obstacle.shape), Scene::none)) return body;
  for (const Obstacle& other : description_.obstacles) {
    if (other.name != obstacle.name && (obstacle.loose() || other.loose()) && overlap(obstacle.shape, other.shape))
      return other.name;
  }
  const std::size_t place = find_obstacle(obstacle.name);
  std::vector<Obstacle> obstacles = description_.obstacles;
  std::vector<MaybeMoving> moves = moving();
  if (place == obstacles.size()) {
    obstacles.push_back(obstacle);
    moves.emplace_back();
  } else {
    obstacles[place] = obstacle;
    moves[place].reset();
  }
  change_obstacles(std::move(obstacles), moves);
  return std::nullopt;
}

bool BulletWorld::remove_obstacle(const std::string& name) {
  const std::size_t place = find_obstacle(name);
  std::vector<Obstacle> obstacles = description_.obstacles;
  if (place == obstacles.size()) return false;
  std::vector<MaybeMoving> moves = moving();
  obstacles.erase(obstacles.begin() + static_cast<std::ptrdiff_t>(place));
  moves.erase(moves.begin() + static_cast<std::ptrdiff_t>(place));
  change_obstacles(std::move(obstacles), moves);
  return true;
}

std::optional<std::string> BulletWorld::push(const std::string& name, Point force_n, Duration time) {
  const bool body = std::any_of(description_.bodies.begin(), description_.bodies.end(),
                                [&](const BodyDescription& other) { return other.name == name; });
  const std::size_t place = find_obstacle(name);
  if (!body && place == description_.obstacles.size()) return "there is no '" + name + "'";
  if (!body && !description_.obstacles[place].loose()) return "'" + name + "' stands fast";
  const Duration step = description_.step;
  const auto lasts = static_cast<std::uint64_t>((time + step - Duration::from_ns(1)) / step);
  if (lasts > 0) pushes_.push_back({name, force_n, steps_ + lasts});
  return std::nullopt;
}

}  // namespace

std::unique_ptr<VehicleWorld> make_bullet_world(const WorldDescription& description, std::uint64_t seed) {
  return std::make_unique<BulletWorld>(description, seed);
}

}  // namespace waitpoint::world
