// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/senses.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "world/planar/separation.hpp"
#include "world/sensors/laser_timing.hpp"

namespace waitpoint::world {
namespace {

// The margin of movers' bounding boxes: at walking speed the tree changes about twice a second.
constexpr double roam_m = 0.4;

double longest_scan_s(const BodyDescription& body) {
  double longest_s = 0;
  for (const LaserDescription& laser : body.sensors<Lasers>()) longest_s = std::max(longest_s, scan_span_s(laser));
  return longest_s;
}

bool has_sonars(const BodyDescription& body) { return !body.sensors<Sonars>().empty(); }

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

}  // namespace

std::vector<Shape> shapes_of(std::span<const Obstacle> obstacles) {
  std::vector<Shape> shapes;
  for (const Obstacle& obstacle : obstacles) shapes.push_back(obstacle.shape);
  return shapes;
}

std::vector<Shape> shapes_of(std::span<const BodyDescription> bodies) {
  std::vector<Shape> shapes;
  for (const BodyDescription& body : bodies) {
    shapes.push_back(raised(body.shape, body.start_height_m));
    shapes.back().pose = compose(body.start, body.shape.pose);
  }
  return shapes;
}

Senses::Devices::Devices(const BodyDescription& body, double step_s, std::uint64_t seed, LaserKinds& kinds)
    : trail(longest_scan_s(body), step_s, body.start) {
  lasers.reserve(body.sensors<Lasers>().size());
  for (std::size_t i = 0; i < body.sensors<Lasers>().size(); ++i)
    lasers.emplace_back(kinds.of(body.sensors<Lasers>()[i]), seed, body.name, i);
  looks_back = !std::all_of(lasers.begin(), lasers.end(), [](const Laser& laser) { return laser.plain(); });
  for (std::size_t i = 0; i < body.sensors<Sonars>().size(); ++i)
    sonar_noise.push_back(world::sonar_noise(seed, body.name, i));
  SensorsWithModel::for_each([&]<class S>() {
    if (const auto& description = body.sensors<S>())
      std::get<OwnedModel<S>>(models) = std::make_unique<typename S::Model>(*description, seed, body.name);
  });
}

void Senses::Devices::reseed(std::uint64_t seed, const std::string& body) {
  for (std::size_t i = 0; i < lasers.size(); ++i) lasers[i].reseed(seed, body, i);
  for (std::size_t i = 0; i < sonar_noise.size(); ++i) sonar_noise[i] = world::sonar_noise(seed, body, i);
  SensorsWithModel::for_each([&]<class S>() {
    if (const auto& model = this->model<S>()) model->reseed(seed, body);
  });
}

Senses::Senses(const WorldDescription& description, std::span<const Shape> standing, std::span<const Shape> movers)
    : description_(description),
      surfaces_(description.meshes),
      standing_(std::span<const Shape>()),
      movers_(std::span<const Shape>()),
      caster_(description, surfaces_, standing_, movers_),
      sonar_echoes_(standing_, surfaces_, caster_) {
  stand(standing);
  move(movers);
}

void Senses::restart(std::uint64_t seed) {
  devices_.clear();
  LaserKinds kinds;
  for (const BodyDescription& body : description_.bodies)
    devices_.emplace_back(body, description_.step.seconds(), seed, kinds);
  expected_.restart(devices_.size());
}

void Senses::reseed(std::uint64_t seed) {
  for (std::size_t i = 0; i < devices_.size(); ++i) devices_[i].reseed(seed, description_.bodies[i].name);
}

void Senses::moved(std::uint32_t body, const Vehicle& vehicle, std::uint64_t step) {
  WAITPOINT_FAST_CHECK(body < devices_.size(), "a body without devices has moved");
  Devices& devices = devices_[body];
  const BodyState& state = vehicle.state();
  if (devices.looks_back) devices.trail.add(state.arc);
  const StepDone done{description_.step * static_cast<std::int64_t>(step), description_.step};
  SensorsWithModel::for_each([&]<class S>() {
    if constexpr (!ReadOnDemand<S>)
      if (const auto& model = devices.model<S>()) model->moved(done, state);
  });
}

void Senses::add_scan_to(WorkingSet& set, std::uint32_t body) const {
  const Devices& devices = devices_.at(body);
  set.add_between(&devices, &devices.trail);
  set.add(devices.lasers.data(), devices.lasers.size() * sizeof(Laser));
}

void Senses::put(std::uint32_t body, const Pose& pose) {
  devices_[body].trail.restart(pose);
  expected_.forget();
}

void Senses::stand(std::span<const Shape> standing) {
  expected_.forget();
  standing_ = Scene(standing);
  caster_.stand(standing);
  if (std::any_of(description_.bodies.begin(), description_.bodies.end(), has_sonars)) sonar_echoes_.stand(standing);
}

void Senses::move(std::span<const Shape> movers) {
  WAITPOINT_CHECK(movers.empty() || movers.size() >= description_.bodies.size(), "the movers lack a body");
  expected_.forget();
  movers_ = Scene(movers, roam_m);
  caster_.move(movers);
}

void Senses::place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m) {
  caster_.place(mover, outline, z_low_m, z_high_m);
}

void Senses::place(std::uint32_t mover, const Vehicle& vehicle) {
  const Shape shape = vehicle.shape();
  place(mover, vehicle.outline(), shape.z_low_m, shape.z_high_m);
}

void Senses::make_expected_scans(std::span<const Vehicle> vehicles, double time_s) {
  if (!expected_.begin()) return;
  caster_.list_movers(in_turn_);
  constexpr std::size_t ahead = 2;  // a crowd's bodies are mostly out of the cache
  WAITPOINT_CHECK(vehicles.size() == devices_.size() && in_turn_.size() >= vehicles.size(),
                  "there are not as many vehicles as bodies, or the movers lack one");
  const auto body_in = [&](std::size_t turn) { return std::min<std::size_t>(in_turn_[turn], vehicles.size() - 1); };
  for (std::size_t turn = 0; turn < in_turn_.size(); ++turn) {
    if (turn + 2 * ahead < in_turn_.size()) __builtin_prefetch(&devices_[body_in(turn + 2 * ahead)]);
    if (turn + ahead < in_turn_.size()) {
      const std::size_t next = body_in(turn + ahead);
      __builtin_prefetch(devices_[next].lasers.data());
      __builtin_prefetch(&vehicles[next].state());
    }
    const std::uint32_t mover = in_turn_[turn];
    if (mover >= vehicles.size()) continue;  // loose obstacles have no lasers
    expected_.make(mover, [&](const ExpectedScans::Entry& expected, LaserScan& scan) {
      make_scan(vehicles[mover], mover, expected.laser, expected.number, time_s, scan);
    });
  }
}

void Senses::scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser, std::uint64_t scan_number,
                  double time_s, LaserScan& out) const {
  if (!expected_.find(own, static_cast<std::uint32_t>(laser), scan_number, out))
    make_scan(vehicle, own, laser, scan_number, time_s, out);
}

void Senses::make_scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser_number, std::uint64_t scan_number,
                       double time_s, LaserScan& out) const {
  const Laser& laser = devices_[own].lasers.at(laser_number);
  const LaserDescription& device = laser.description();
  out.first_angle_rad = laser.first_angle_rad();
  out.angle_step_rad = laser.angle_step_rad();
  out.range_max_m = device.range_max_m;
  out.range_m.resize(laser.directions().size());
  const double height_m = device.height_m + vehicle.state().height_m;
  if (laser.plain()) {
    const Pose at = compose(vehicle.state().pose, device.mount);
    const auto [s, c] = exact::sincos(at.heading);
    caster_.cast({at.position(), {c, s}, laser.angle_step_rad(), laser.directions()}, height_m, own, device.range_max_m,
                 out.range_m);
  } else {
    laser.look(scan_number, devices_[own].trail, SensorRays(caster_, height_m, own, device.range_max_m), out.range_m);
  }
  laser.measure(scan_number, time_s, out.range_m);
  WAITPOINT_FAST_CHECK(
      std::all_of(out.range_m.begin(), out.range_m.end(), [&](double r) { return 0 <= r && r <= out.range_max_m; }),
      "a range of a scan is not between 0 and the laser's greatest");
}

double Senses::cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const {
  const auto [s, c] = exact::sincos(beam.heading_rad);
  return caster_.cast(beam.origin, {c, s}, beam.height_m, own ? static_cast<std::uint32_t>(*own) : Scene::none,
                      range_max_m);
}

void Senses::fire(const Vehicle& vehicle, std::uint32_t own, std::size_t ring_number, std::uint64_t firing,
                  Sonars::Reading& reading) const {
  const SonarRingDescription& ring = vehicle.description().sensors<Sonars>().at(ring_number);
  if (reading.range_m.size() != ring.count) {
    reading.range_m.resize(ring.count);
    std::fill(reading.range_m.begin(), reading.range_m.end(), ring.range_max_m);
  }
  distances_.resize(ring.count);
  sonar_echoes_.fire(vehicle, own, ring_number, firing, distances_);
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    WAITPOINT_FAST_CHECK(!Sonars::fires(ring, i, firing) || distances_[i] >= 0, "the distance of an echo is negative");
    if (Sonars::fires(ring, i, firing))
      reading.range_m[i] = sonar_range_m(ring, distances_[i], devices_[own].sonar_noise[ring_number].normal(firing, i));
  }
}

/// What the sensors of one body see.
class Senses::OfBody final : public Surroundings {
 public:
  OfBody(const Senses& senses, const Vehicle& vehicle, std::uint32_t own)
      : senses_(senses), vehicle_(vehicle), own_(own) {}

  const BodyState& body() const override { return vehicle_.state(); }
  double cast(const Beam& beam, double range_max_m) const override {
    return senses_.cast(beam, range_max_m, BodyId(own_));
  }
  std::span<const Separation> near(double reach_m) const override;

 private:
  const Senses& senses_;
  const Vehicle& vehicle_;
  std::uint32_t own_;
};

std::span<const Separation> Senses::OfBody::near(double reach_m) const {
  const Shape shape = vehicle_.shape();
  const Bounds reach = bounds_of(vehicle_.outline()).grown(reach_m);
  std::vector<std::uint32_t>& found = senses_.near_;
  std::vector<Separation>& separations = senses_.separations_;
  separations.clear();
  const auto add = [&](const Scene& scene) {
    scene.near(reach, shape.z_low_m, shape.z_high_m, found);
    for (const std::uint32_t other : found) {
      if (&scene == &senses_.movers_ && other == own_) continue;
      separations.push_back(separation(vehicle_.outline(), scene.outline(other)));
    }
  };
  add(senses_.standing_);
  add(senses_.movers());
  senses_.surfaces_.near(reach, shape.z_low_m, shape.z_high_m, found);
  for (const std::uint32_t number : found)
    separations.push_back(senses_.surfaces_.separation(vehicle_.outline(), shape.z_low_m, shape.z_high_m, number));
  return separations;
}

template <HasModel S>
bool Senses::read_model(const Vehicle& vehicle, std::uint32_t own, std::uint64_t number,
                        typename S::Reading& reading) const {
  const auto& model = devices_.at(own).model<S>();
  WAITPOINT_CHECK(model != nullptr, "a body is asked for a sensor that it does not have");
  if constexpr (ReadOnDemand<S>) {
    model->read(OfBody(*this, vehicle, own), number, reading);
  } else {
    if (model->reading().number == reading.number) return false;
    reading = model->reading();
  }
  return true;
}

bool Senses::read(const Vehicle& vehicle, std::uint32_t own, std::size_t device, std::uint64_t number, double time_s,
                  const AnyReadingOut& out) const {
  return std::visit(
      [&]<class S>(const ReadingOut<S>& of) {
        typename S::Reading& reading = *of.reading;
        const Time date = reading.date;
        bool is_new = true;
        if constexpr (HasModel<S>) {
          is_new = read_model<S>(vehicle, own, number, reading);
        } else if constexpr (std::is_same_v<S, Lasers>) {
          scan(vehicle, own, device, number, time_s, scan_);
          reading.number = static_cast<std::uint32_t>(number);
          reading.first_angle_rad = scan_.first_angle_rad;
          reading.angle_step_rad = scan_.angle_step_rad;
          reading.range_max_m = scan_.range_max_m;
          reading.range_m.clear();
          for (const double range_m : scan_.range_m) reading.range_m.push_back(static_cast<float>(range_m));
        } else if constexpr (std::is_same_v<S, Sonars>) {
          WAITPOINT_CHECK(number > 0, "firings of sonars are numbered from 1");
          fire(vehicle, own, device, number - 1, reading);
          reading.number = number;
        } else {
          static_assert(std::is_same_v<S, Battery>);
          reading = vehicle.battery(time_s);
        }
        reading.date = date;
        return is_new;
      },
      out);
}

}  // namespace waitpoint::world
