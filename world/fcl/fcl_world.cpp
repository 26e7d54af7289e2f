// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/fcl_world.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "world/fcl/beam_caster.hpp"
#include "world/fcl/scene.hpp"
#include "world/fcl/sonar_echoes.hpp"
#include "world/motion/contact_loop.hpp"
#include "world/planar/separation.hpp"
#include "world/sensors/bumper.hpp"
#include "world/sensors/infrared.hpp"
#include "world/sensors/laser.hpp"
#include "world/sensors/laser_timing.hpp"
#include "world/slice/footprints.hpp"
#include "world/start_check.hpp"
#include "world/vehicles/vehicle.hpp"

namespace waitpoint::world {
namespace {

// Bodies' bounding boxes are this much wider than the bodies: at walking speed the tree changes twice a second.
constexpr double roam_m = 0.4;

std::vector<Shape> shapes_of(const std::vector<Obstacle>& obstacles) {
  std::vector<Shape> shapes;
  for (const Obstacle& obstacle : obstacles) shapes.push_back(obstacle.shape);
  return shapes;
}

std::vector<Shape> shapes_of(const std::vector<BodyDescription>& bodies) {
  std::vector<Shape> shapes;
  for (const BodyDescription& body : bodies) {
    shapes.push_back(raised(body.shape, body.start_height_m));
    shapes.back().pose = compose(body.start, body.shape.pose);
  }
  return shapes;
}

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

double longest_scan_s(const BodyDescription& body) {
  double longest_s = 0;
  for (const LaserDescription& laser : body.lasers) longest_s = std::max(longest_s, scan_span_s(laser));
  return longest_s;
}

struct Body {
  Vehicle vehicle;
  ArcTrail trail;  // as far back as a scan reaches
  std::vector<Laser> lasers;
  std::vector<RandomStream> sonar_noise;
  RandomStream infrared_noise;

  Body(const BodyDescription& d, double step_s, std::uint64_t seed)
      : vehicle(d, seed),
        trail(longest_scan_s(d), step_s, d.start),
        infrared_noise(world::infrared_noise(seed, d.name)) {
    for (std::size_t i = 0; i < d.lasers.size(); ++i) lasers.emplace_back(d.lasers[i], seed, d.name, i);
    for (std::size_t i = 0; i < d.sonars.size(); ++i) sonar_noise.push_back(world::sonar_noise(seed, d.name, i));
  }
};

/// The rays of one sensor of a body.
class SensorRays final : public RayCaster {
 public:
  SensorRays(const BeamCaster& caster, double height_m, std::uint32_t own, double range_max_m)
      : caster_(caster), height_m_(height_m), own_(own), range_max_m_(range_max_m) {}

  double distance_m(const Ray& ray) const override {
    return caster_.cast(ray.origin, ray.direction, height_m_, own_, range_max_m_);
  }

 private:
  const BeamCaster& caster_;
  double height_m_;
  std::uint32_t own_;
  double range_max_m_;
};

class FclWorld final : public World {
 public:
  FclWorld(const WorldDescription& description, std::uint64_t seed);

  const WorldDescription& description() const override { return description_; }
  void command(BodyId id, Velocity velocity) override { bodies_.at(index(id)).vehicle.command(velocity, steps_); }
  void step() override;
  std::uint64_t steps() const override { return steps_; }
  void reset(std::uint64_t seed) override;

  std::optional<std::string> move_body(BodyId id, const Pose& pose) override;
  std::optional<std::string> put_obstacle(const Obstacle& obstacle) override;
  bool remove_obstacle(const std::string& name) override;

  const BodyState& body(BodyId id) const override { return bodies_.at(index(id)).vehicle.state(); }
  const OdometerReading& odometer(BodyId id) const override { return bodies_.at(index(id)).vehicle.odometer(); }
  double battery_volts(BodyId id) const override;

  void scan(BodyId id, std::size_t laser, std::uint64_t scan_number, LaserScan& out) const override;
  void sonar(BodyId id, std::size_t ring, std::uint64_t firing_number, std::vector<double>& range_m) const override;
  std::uint32_t bumpers(BodyId id) const override;
  void infrareds(BodyId id, std::uint64_t reading_number, std::vector<double>& volts) const override;
  double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const override;

 private:
  void latch();
  void move();
  void find_meetings(std::uint32_t body, double path_max_m, double climb_max_m);
  void publish();
  void place(std::uint32_t body);

  std::vector<Obstacle>::iterator find_obstacle(const std::string& name);
  void change_obstacles(std::vector<Obstacle> obstacles);
  std::optional<std::string> body_met(const Shape& shape, const Outline& outline, std::uint32_t except) const;

  WorldDescription description_;
  std::optional<std::vector<Obstacle>> first_obstacles_;  // of the start, once they have been changed
  const double step_s_;
  std::uint64_t steps_ = 0;
  std::vector<Body> bodies_;
  Scene obstacle_scene_;
  Footprints footprints_;  // the same obstacles; none where FCL finds neighbours
  Scene body_scene_;       // bodies as published at the last step but one: where the last step began
  BeamCaster caster_;
  SonarEchoes sonar_echoes_;

  // Buffers of one call, kept so that steps and scans allocate nothing.
  ContactLoop contacts_;
  std::vector<Arc> arcs_;
  std::vector<Mover> movers_;
  mutable std::vector<std::uint32_t> near_;
  mutable std::vector<double> distances_;
};

FclWorld::FclWorld(const WorldDescription& description, std::uint64_t seed)
    : description_(description),
      step_s_(description.step.seconds()),
      obstacle_scene_(shapes_of(description.obstacles)),
      footprints_(footprints_of(description)),
      body_scene_(shapes_of(description.bodies), roam_m),
      caster_(description, obstacle_scene_, body_scene_),
      sonar_echoes_(obstacle_scene_, body_scene_, caster_) {
  WAITPOINT_CHECK(step_s_ > 0, "a world steps by a positive period");
  WAITPOINT_CHECK(start_overlaps(description_).empty(), "a body starts inside something solid");
  sonar_echoes_.stand(description_);
  reset(seed);
}

void FclWorld::reset(std::uint64_t seed) {
  steps_ = 0;
  if (first_obstacles_) {
    change_obstacles(*first_obstacles_);
    first_obstacles_.reset();
  }
  bodies_.clear();
  for (const BodyDescription& body : description_.bodies) bodies_.emplace_back(body, step_s_, seed);
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) place(i);
}

// Tells what finds beams and neighbours where the body is now.
void FclWorld::place(std::uint32_t body) {
  const Vehicle& vehicle = bodies_[body].vehicle;
  const Shape shape = vehicle.shape();
  caster_.place(body, vehicle.outline(), shape.z_low_m, shape.z_high_m);
}

void FclWorld::step() {
  ++steps_;
  latch();
  move();
  publish();
}

void FclWorld::latch() {
  arcs_.clear();
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    Vehicle& vehicle = bodies_[i].vehicle;
    if (vehicle.state().arc.moves()) place(i);
    arcs_.push_back(vehicle.latch(steps_, description_.step));
  }
}

void FclWorld::move() {
  contacts_.clear();
  movers_.clear();
  double path_max_m = 0, climb_max_m = 0;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const Vehicle& vehicle = bodies_[i].vehicle;
    movers_.emplace_back(vehicle.description().shape, vehicle.outline(), arcs_[i], vehicle.state().height_m);
    contacts_.add_body(movers_[i]);
    path_max_m = std::max(path_max_m, movers_[i].path_m());
    climb_max_m = std::max(climb_max_m, std::fabs(movers_[i].climb_m()));
  }
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
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
    obstacle_scene_.near(swept, heights.low_m, heights.high_m, near_);
  for (const std::uint32_t obstacle : near_) {
    const Shape& shape = description_.obstacles[obstacle].shape;
    contacts_.add_obstacle(body, obstacle_scene_.outline(obstacle), {shape.z_low_m, shape.z_high_m});
  }
  if (bodies_.size() == 1) return;
  // The others may climb too.
  const double margin_m = climb_max_m > 0 ? climb_max_m + 2 * contact_gap_m : 0;
  body_scene_.near(swept.grown(path_max_m), heights.low_m - margin_m, heights.high_m + margin_m, near_);
  for (const std::uint32_t other : near_) {
    // Of two that both move, the first asks.
    if (other > body || (other != body && !movers_[other].moves())) contacts_.add_pair(body, other);
  }
}

void FclWorld::publish() {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    body.vehicle.publish(steps_, description_.step, arcs_[i], contacts_.stop(i));
    body.trail.add(body.vehicle.state().arc);
  }
}

std::optional<std::string> FclWorld::move_body(BodyId id, const Pose& pose) {
  const std::uint32_t own = static_cast<std::uint32_t>(id);
  Vehicle& vehicle = bodies_.at(index(id)).vehicle;
  const Shape shape = vehicle.shape();
  const Outline outline = outline_of(shape, pose);
  obstacle_scene_.near(bounds_of(outline).grown(2 * contact_gap_m), shape.z_low_m, shape.z_high_m, near_);
  for (const std::uint32_t obstacle : near_) {
    if (separation(outline, obstacle_scene_.outline(obstacle)).distance_m <= contact_gap_m)
      return description_.obstacles[obstacle].name;
  }
  if (auto other = body_met(shape, outline, own)) return other;
  vehicle.put(pose);
  bodies_[index(id)].trail.restart(pose);
  // To the others' sensors it stands there already, as if it had been published so at the last step but one.
  place(own);
  return std::nullopt;
}

std::optional<std::string> FclWorld::body_met(const Shape& shape, const Outline& outline, std::uint32_t except) const {
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const Vehicle& other = bodies_[i].vehicle;
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
  const std::vector<Shape> shapes = shapes_of(description_.obstacles);
  obstacle_scene_ = Scene(shapes);
  footprints_ = footprints_of(description_);
  caster_.stand(shapes);
  sonar_echoes_.stand(description_);
}

double FclWorld::battery_volts(BodyId id) const {
  const Vehicle& vehicle = bodies_.at(index(id)).vehicle;
  return world::battery_volts(vehicle.description().base, static_cast<double>(steps_) * step_s_,
                              vehicle.state().travelled_m);
}

void FclWorld::scan(BodyId id, std::size_t laser_number, std::uint64_t scan_number, LaserScan& out) const {
  const Body& body = bodies_.at(index(id));
  const Laser& laser = body.lasers.at(laser_number);
  const Vehicle& vehicle = body.vehicle;
  const LaserDescription& device = vehicle.description().lasers[laser_number];
  out.first_angle_rad = laser.first_angle_rad();
  out.angle_step_rad = laser.angle_step_rad();
  out.range_max_m = device.range_max_m;
  out.range_m.resize(laser.directions().size());
  const std::uint32_t own = static_cast<std::uint32_t>(id);
  const double height_m = device.height_m + vehicle.state().height_m;
  if (laser.plain()) {
    const Pose at = compose(vehicle.state().pose, device.mount);
    const auto [s, c] = exact::sincos(at.heading);
    caster_.cast({at.position(), {c, s}, laser.angle_step_rad(), laser.directions()}, height_m, own, device.range_max_m,
                 out.range_m);
  } else {
    laser.look(scan_number, body.trail, SensorRays(caster_, height_m, own, device.range_max_m), out.range_m);
  }
  laser.measure(scan_number, static_cast<double>(steps_) * step_s_, out.range_m);
}

double FclWorld::cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const {
  const auto [s, c] = exact::sincos(beam.heading_rad);
  return caster_.cast(beam.origin, {c, s}, beam.height_m, own ? static_cast<std::uint32_t>(*own) : Scene::none,
                      range_max_m);
}

void FclWorld::sonar(BodyId id, std::size_t ring_number, std::uint64_t firing_number,
                     std::vector<double>& range_m) const {
  const Body& body = bodies_.at(index(id));
  const SonarRingDescription& ring = body.vehicle.description().sonars.at(ring_number);
  if (range_m.size() != ring.count) range_m.assign(ring.count, ring.range_max_m);
  distances_.resize(ring.count);
  sonar_echoes_.fire(body.vehicle, static_cast<std::uint32_t>(id), ring_number, firing_number, distances_);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    if (fires(ring, i, firing_number))
      range_m[i] = sonar_range_m(ring, distances_[i], body.sonar_noise[ring_number].normal(firing_number, i));
  }
}

std::uint32_t FclWorld::bumpers(BodyId id) const {
  const Body& body = bodies_.at(index(id));
  if (!body.vehicle.description().bumpers) return 0;
  const BumperDescription& bumper = *body.vehicle.description().bumpers;
  const Shape shape = body.vehicle.shape();
  const Bounds reach = bounds_of(body.vehicle.outline()).grown(bumper.travel_m);
  std::uint32_t pressed = 0;
  const auto touch = [&](const Scene& scene) {
    scene.near(reach, shape.z_low_m, shape.z_high_m, near_);
    for (const std::uint32_t other : near_) {
      if (&scene == &body_scene_ && other == static_cast<std::uint32_t>(id)) continue;
      pressed |= pressed_panel(bumper, body.vehicle.state().pose.heading,
                               separation(body.vehicle.outline(), scene.outline(other)));
    }
  };
  touch(obstacle_scene_);
  touch(body_scene_);
  return pressed;
}

void FclWorld::infrareds(BodyId id, std::uint64_t reading_number, std::vector<double>& volts) const {
  const Body& body = bodies_.at(index(id));
  WAITPOINT_CHECK(body.vehicle.description().infrareds.has_value(),
                  "a body without infrared range finders is asked for them");
  const InfraredRingDescription& ring = *body.vehicle.description().infrareds;
  volts.resize(ring.count);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    const Pose finder = compose(body.vehicle.state().pose, infrared_mount(ring, i));
    const double height_m = ring.height_m + body.vehicle.state().height_m;
    const double range_m = cast({finder.position(), finder.heading, height_m}, ring.range_max_m, id);
    volts[i] = infrared_v(ring, range_m, body.infrared_noise.normal(reading_number, i));
  }
}

}  // namespace

std::unique_ptr<World> make_fcl_world(const WorldDescription& description, std::uint64_t seed) {
  return std::make_unique<FclWorld>(description, seed);
}

}  // namespace waitpoint::world
