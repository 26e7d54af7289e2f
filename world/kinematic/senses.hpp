// SPDX-License-Identifier: BSD-3-Clause
// What the sensors of a world's bodies read: the same for every world server, whatever moves its bodies.
//
// It has the geometry that sensors ask, in two parts: what stands, and what moves. Movers are numbered, the bodies
// first as in the description, then whatever else there is. A mover is to sensors where it was last placed: the server
// places it at the beginning of each step, as it was published last. A sensor's own body is asked itself.
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
#include "world/sensors/imu.hpp"
#include "world/sensors/laser.hpp"
#include "world/sensors/position_receiver.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

/// The shapes of obstacles, and those of bodies at their starts.
std::vector<Shape> shapes_of(std::span<const Obstacle> obstacles);
std::vector<Shape> shapes_of(std::span<const BodyDescription> bodies);

class Senses {
 public:
  /// Of the description it takes the bodies, with their devices, the meshes and the engine: its obstacles stand only if
  /// they are `standing`. The description must outlive it.
  Senses(const WorldDescription& description, std::span<const Shape> standing, std::span<const Shape> movers);
  Senses(const Senses&) = delete;
  Senses& operator=(const Senses&) = delete;

  /// All devices as at the start, with the random streams of that seed.
  void restart(std::uint64_t seed);

  // What stands and what moves.

  const Scene& standing() const { return standing_; }
  const Surfaces& surfaces() const { return surfaces_; }
  const Scene& movers() const { return caster_.movers(); }
  /// Other things stand there now.
  void stand(std::span<const Shape> standing);
  /// Other things move now; the bodies are the first of them, as ever.
  void move(std::span<const Shape> movers);
  void place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m);
  void place(std::uint32_t mover, const Vehicle& vehicle);

  // What happens to a body.

  /// After the next step this scan of it will be asked for.
  void expect_scan(std::uint32_t body, std::size_t laser, std::uint64_t scan_number) {
    expected_.expect(body, static_cast<std::uint32_t>(laser), scan_number);
  }
  /// A step is done, at that time: the scans that are expected after it are made, of bodies that are these vehicles.
  void make_expected_scans(std::span<const Vehicle> vehicles, double time_s);
  /// It, which is `vehicle`, has done step number `step`.
  void moved(std::uint32_t body, const Vehicle& vehicle, std::uint64_t step);
  /// A hand has put it there.
  void put(std::uint32_t body, const Pose& pose);

  /// Adds what a scan of it touches, without what is everybody's.
  void add_scan_to(WorkingSet& set, std::uint32_t body) const;

  // What World has of the same names, for the body `own`, which is `vehicle`.

  void scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser, std::uint64_t scan_number, double time_s,
            LaserScan& out) const;
  void sonar(const Vehicle& vehicle, std::uint32_t own, std::size_t ring, std::uint64_t firing_number,
             std::vector<double>& range_m) const;
  std::uint32_t bumpers(const Vehicle& vehicle, std::uint32_t own) const;
  void infrareds(const Vehicle& vehicle, std::uint32_t own, std::uint64_t reading_number,
                 std::vector<double>& volts) const;
  double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own) const;
  const ImuSample& imu(std::uint32_t own) const;
  const PositionFix& position_fix(std::uint32_t own) const;

 private:
  void make_scan(const Vehicle& vehicle, std::uint32_t own, std::size_t laser, std::uint64_t scan_number, double time_s,
                 LaserScan& out) const;

  /// A body's, that remember something.
  struct Devices {
    std::vector<Laser> lasers;
    bool looks_back;                        // a laser measures while it moves
    std::unique_ptr<Imu> imu;               // null for a body without one
    std::unique_ptr<PositionReceiver> gps;  // likewise
    ArcTrail trail;                         // as far back as a scan reaches, where one looks back
    std::vector<RandomStream> sonar_noise;
    RandomStream infrared_noise;

    Devices(const BodyDescription& body, double step_s, std::uint64_t seed, LaserKinds& kinds);
  };

  const WorldDescription& description_;
  std::vector<Devices> devices_;
  Surfaces surfaces_;
  Scene standing_, movers_;
  BeamCaster caster_;
  SonarEchoes sonar_echoes_;
  ExpectedScans expected_;

  // Of one call, kept so that readings allocate nothing.
  mutable std::vector<std::uint32_t> near_;
  mutable std::vector<double> distances_;
  std::vector<std::uint32_t> in_turn_;
};

}  // namespace waitpoint::world
