// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/kinematic_world.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "world/kinematic/start_check.hpp"
#include "world/kinematic/vehicle_world.hpp"
#include "world/mesh/band.hpp"
#include "world/motion/meetings.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/footprints.hpp"

namespace waitpoint::world {
namespace {

Footprints footprints_of(const WorldDescription& description) {
  return Footprints(description.engine == Engine::slice ? shapes_of(description.obstacles) : std::vector<Shape>{});
}

const Band* find_band(std::span<const Band> bands, const Shape& shape) {
  for (const Band& band : bands)
    if (band.z_low_m() == shape.z_low_m && band.z_high_m() == shape.z_high_m) return &band;
  return nullptr;
}

bool climbs(const BodyDescription& body) { return body.base.kind == BaseDescription::Kind::aerial; }

// One for each pair of heights of bodies that do not climb.
std::vector<Band> bands_of(const WorldDescription& description, const Surfaces& surfaces) {
  std::vector<Band> bands;
  if (surfaces.size() == 0) return bands;
  for (const BodyDescription& body : description.bodies)
    if (!climbs(body) && find_band(bands, body.shape) == nullptr)
      bands.emplace_back(surfaces, body.shape.z_low_m, body.shape.z_high_m);
  return bands;
}

class KinematicWorld final : public VehicleWorld, private MeetingPlace {
 public:
  KinematicWorld(const WorldDescription& description, std::uint64_t seed);

  void step() override;
  void reset(std::uint64_t seed) override;

  std::optional<std::string> move_body(BodyId id, const Pose& pose) override;
  std::optional<std::string> guide_body(BodyId id, const std::optional<Pose>& to, const Velocity& velocity) override {
    vehicles_.at(index(id)).guide(to, velocity);
    return std::nullopt;
  }
  std::optional<std::string> put_obstacle(const Obstacle& obstacle) override;
  bool remove_obstacle(const std::string& name) override;
  std::optional<std::string> push(const std::string&, Point, Duration) override {
    return "there are no forces in a kinematic world";
  }

  std::span<const LooseState> loose() const override { return {}; }

 private:
  void latch();
  void move();
  void publish();

  const Outline& outline(std::uint32_t body) const override { return vehicles_[body].outline(); }
  Mover mover(std::uint32_t body) const override;
  void near(std::uint32_t body, const Bounds& bounds, std::vector<std::uint32_t>& found) const override;
  Mover obstacle(std::uint32_t obstacle) const override;
  double gap_m(std::uint32_t body, std::uint32_t obstacle) const override;

  void change_obstacles(std::vector<Obstacle> obstacles);

  std::optional<std::vector<Obstacle>> first_obstacles_;  // those of the start, once they have been changed
  Footprints footprints_;                                 // of the obstacles; empty if FCL finds neighbours

  std::vector<Band> bands_;           // of the surfaces, one for each pair of heights of bodies that do not climb
  std::vector<const Band*> band_of_;  // each body's own; null for one that climbs, or without surfaces

  std::vector<double> reaches_m_;  // of the bodies
  Meetings meetings_;

  mutable std::vector<std::uint32_t> near_;  // scratch space of one call

  // Of one step.
  std::vector<Arc> arcs_;
  std::vector<Meetings::Motion> motions_;
};

KinematicWorld::KinematicWorld(const WorldDescription& description, std::uint64_t seed)
    : VehicleWorld(description, shapes_of(description.obstacles), shapes_of(description.bodies)),
      footprints_(footprints_of(description)),
      bands_(bands_of(description, senses_.surfaces())),
      meetings_(*this, shapes_of(description.bodies)) {
  for (const BodyDescription& body : description_.bodies) {
    reaches_m_.push_back(reach_m(body.shape));
    band_of_.push_back(climbs(body) ? nullptr : find_band(bands_, body.shape));
  }
  reset(seed);
}

void KinematicWorld::reset(std::uint64_t seed) {
  steps_ = 0;
  if (first_obstacles_) {
    change_obstacles(*first_obstacles_);
    first_obstacles_.reset();
  }
  vehicles_.clear();
  vehicles_.reserve(description_.bodies.size());
  for (const BodyDescription& body : description_.bodies) vehicles_.emplace_back(body, seed);
  meetings_.forget();
  senses_.restart(seed);
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) senses_.place(i, vehicles_[i]);
}

void KinematicWorld::step() {
  ++steps_;
  latch();
  move();
  publish();
  senses_.make_expected_scans(vehicles_, elapsed_s());
}

void KinematicWorld::latch() {
  arcs_.clear();
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    Vehicle& vehicle = vehicles_[i];
    if (vehicle.state().arc.moves()) senses_.place(i, vehicle);
    arcs_.push_back(vehicle.latch(steps_, description_.step));
  }
}

void KinematicWorld::move() {
  motions_.clear();
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i)
    motions_.push_back({path_m(arcs_[i], reaches_m_[i]), arcs_[i].moves()});
  meetings_.step(motions_);
}

Mover KinematicWorld::mover(std::uint32_t body) const {
  const Vehicle& vehicle = vehicles_[body];
  return {vehicle.description().shape, vehicle.outline(), arcs_[body], vehicle.state().height_m};
}

// Numbers beyond the obstacles are triangles of meshes.
Mover KinematicWorld::obstacle(std::uint32_t obstacle) const {
  const std::uint32_t solids = senses_.standing().size();
  WAITPOINT_CHECK(obstacle < solids + senses_.surfaces().size(), "an obstacle does not exist");
  if (obstacle >= solids)
    return {senses_.surfaces().triangle(obstacle - solids), senses_.surfaces().outline(obstacle - solids)};
  const Shape& shape = description_.obstacles[obstacle].shape;
  return Mover(senses_.standing().outline(obstacle), {shape.z_low_m, shape.z_high_m});
}

double KinematicWorld::gap_m(std::uint32_t body, std::uint32_t obstacle) const {
  const Vehicle& vehicle = vehicles_[body];
  const std::uint32_t solids = senses_.standing().size();
  if (obstacle < solids) return separation(vehicle.outline(), senses_.standing().outline(obstacle)).distance_m;
  if (band_of_[body] != nullptr) return band_of_[body]->separation_m(vehicle.outline(), obstacle - solids);
  return separation(vehicle.outline(), senses_.surfaces().outline(obstacle - solids)).distance_m;
}

void KinematicWorld::near(std::uint32_t body, const Bounds& bounds, std::vector<std::uint32_t>& found) const {
  const Heights any;
  if (description_.engine == Engine::slice)
    footprints_.near(bounds, Scene::padding_m, any.low_m, any.high_m, found);
  else
    senses_.standing().near(bounds, any.low_m, any.high_m, found);
  if (senses_.surfaces().size() == 0) return;
  if (band_of_[body] != nullptr)
    band_of_[body]->near(bounds, near_);
  else
    senses_.surfaces().near(bounds, any.low_m, any.high_m, near_);
  for (const std::uint32_t number : near_) found.push_back(senses_.standing().size() + number);
  WAITPOINT_FAST_CHECK(std::is_sorted(found.begin(), found.end()),
                       "the obstacles near a body are not in ascending order");
}

void KinematicWorld::publish() {
  for (std::uint32_t i = 0; i < vehicles_.size(); ++i) {
    const std::optional<double> stop = meetings_.stop(i);
    WAITPOINT_CHECK(!stop || (0 <= *stop && *stop < 1), "a body stops outside of its step");
    vehicles_[i].publish(steps_, description_.step, arcs_[i], stop);
    senses_.moved(i, vehicles_[i], steps_);
  }
}

std::optional<std::string> KinematicWorld::move_body(BodyId id, const Pose& pose) {
  const std::uint32_t own = number(id);
  Vehicle& vehicle = vehicles_.at(index(id));
  const Shape shape = vehicle.shape();
  const Outline outline = outline_of(shape, pose);
  std::vector<std::uint32_t> obstacles;
  senses_.standing().near(bounds_of(outline).grown(2 * contact_gap_m), shape.z_low_m, shape.z_high_m, obstacles);
  for (const std::uint32_t obstacle : obstacles) {
    if (separation(outline, senses_.standing().outline(obstacle)).distance_m <= contact_gap_m)
      return description_.obstacles[obstacle].name;
  }
  if (auto mesh = mesh_met(shape, outline)) return mesh;
  if (auto other = body_met(shape, outline, own)) return other;
  vehicle.put(pose);
  meetings_.forget();
  senses_.put(own, pose);
  // Other bodies' sensors see it there at once, as if it had been published so at the last step but one.
  senses_.place(own, vehicle);
  return std::nullopt;
}

std::optional<std::string> KinematicWorld::put_obstacle(const Obstacle& obstacle) {
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

bool KinematicWorld::remove_obstacle(const std::string& name) {
  const std::size_t place = find_obstacle(name);
  std::vector<Obstacle> obstacles = description_.obstacles;
  if (place == obstacles.size()) return false;
  obstacles.erase(obstacles.begin() + static_cast<std::ptrdiff_t>(place));
  change_obstacles(std::move(obstacles));
  return true;
}

// Rebuilds everything: interventions are rare.
void KinematicWorld::change_obstacles(std::vector<Obstacle> obstacles) {
  if (!first_obstacles_) first_obstacles_ = description_.obstacles;
  description_.obstacles = std::move(obstacles);
  senses_.stand(shapes_of(description_.obstacles));
  WAITPOINT_CHECK(senses_.standing().size() == description_.obstacles.size(), "the scene lacks an obstacle");
  footprints_ = footprints_of(description_);
  meetings_.forget();
}

}  // namespace

std::unique_ptr<VehicleWorld> make_kinematic_world(const WorldDescription& description, std::uint64_t seed) {
  return std::make_unique<KinematicWorld>(description, seed);
}

}  // namespace waitpoint::world
