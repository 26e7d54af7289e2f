// SPDX-License-Identifier: BSD-3-Clause
// The sensors of a world's bodies, shared by all worlds.
//
// It owns the geometry that sensors see, in two parts: fixed solids and movers. Movers are numbered: first the bodies,
// as in the description, then the loose obstacles. Sensors see a mover where it was last placed: the world places it at
// the beginning of each step, in its last published pose. A sensor's own body has its current pose.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "world/fcl/beam_caster.hpp"
#include "world/fcl/scene.hpp"
#include "world/kinematic/expected_scans.hpp"
#include "world/kinematic/sonar_echoes.hpp"
#include "world/sensors/arc_trail.hpp"
#include "world/sensors/laser.hpp"
#include "world/sensors/models.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// The shapes of obstacles, and of bodies at their starts, in the world frame.
std::vector<Shape> shapes_of(std::span<const Obstacle> obstacles);
std::vector<Shape> shapes_of(std::span<const BodyDescription> bodies);

class Senses {
 public:
  /// Takes the bodies with their devices, the meshes and the engine from the description, which must outlive it; fixed
  /// solids are those in `standing` only.
  Senses(const WorldDescription& description, std::span<const Shape> standing, std::span<const Shape> movers);
  Senses(const Senses&) = delete;
  Senses& operator=(const Senses&) = delete;

  /// All devices as at the start, with the random streams of that seed.
  void restart(std::uint64_t seed);
  /// See World::reseed().
  void reseed(std::uint64_t seed);

  // The fixed solids and the movers.

  const Scene& standing() const { return standing_; }
  const Surfaces& surfaces() const { return surfaces_; }
  const Scene& movers() const { return caster_.movers(); }
  /// Replaces the fixed solids.
  void stand(std::span<const Shape> standing);
  /// Replaces the movers; the bodies are the first of them.
  void move(std::span<const Shape> movers);
  void place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m);
  void place(std::uint32_t mover, const Vehicle& vehicle);

  // Events of a body.

  /// Announces a scan after the next step.
  void expect_scan(std::uint32_t body, std::size_t laser, std::uint64_t scan_number) {
    expected_.expect(body, static_cast<std::uint32_t>(laser), scan_number);
  }
  /// Makes the announced scans after a step that ends at `time_s`; vehicle i is body i.
  void make_expected_scans(std::span<const Vehicle> vehicles, double time_s);
  /// Body `body`, which is `vehicle`, has completed step number `step`.
  void moved(std::uint32_t body, const Vehicle& vehicle, std::uint64_t step);
  /// An intervention has moved the body.
  void put(std::uint32_t body, const Pose& pose);

  /// Adds the memory of the body's own that a scan touches.
  void add_scan_to(WorkingSet& set, std::uint32_t body) const;

  // The functions of VehicleWorld and World with the same names, for body `own`, which is `vehicle`.

  void scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser, std::uint64_t scan_number, double time_s,
            LaserScan& out) const;
  bool read(const Vehicle& vehicle, std::uint32_t own, std::size_t device, std::uint64_t number, double time_s,
            const AnyReadingOut& out) const;
  double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const;

 private:
  void make_scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser, std::uint64_t scan_number, double time_s,
                 LaserScan& out) const;
  void fire(const Vehicle& vehicle, std::uint32_t own, std::size_t ring, std::uint64_t firing,
            Sonars::Reading& reading) const;
  template <HasModel S>
  bool read_model(const Vehicle& vehicle, std::uint32_t own, std::uint64_t number, typename S::Reading& reading) const;

  class OfBody;

  template <class S>
  using OwnedModel = std::unique_ptr<typename S::Model>;

  /// The models of a body's sensors.
  struct Devices {
    std::vector<Laser> lasers;
    bool looks_back;                             // a laser measures beams at different times
    SensorsWithModel::Tuple<OwnedModel> models;  // null for a body without one
    ArcTrail trail;                              // of the longest scan; kept only if looks_back
    std::vector<RandomStream> sonar_noise;

    Devices(const BodyDescription& body, double step_s, std::uint64_t seed, LaserKinds& kinds);
    void reseed(std::uint64_t seed, const std::string& body);
    template <class S>
    const OwnedModel<S>& model() const {
      return std::get<OwnedModel<S>>(models);
    }
  };

  const WorldDescription& description_;
  std::vector<Devices> devices_;
  Surfaces surfaces_;
  Scene standing_, movers_;
  BeamCaster caster_;
  SonarEchoes sonar_echoes_;
  ExpectedScans expected_;

  // Scratch space of one call, kept so that readings allocate nothing.
  mutable std::vector<std::uint32_t> near_;
  mutable std::vector<Separation> separations_;
  mutable std::vector<double> distances_;
  mutable LaserScan scan_;
  std::vector<std::uint32_t> in_turn_;
};

}  // namespace waitpoint::world
