// SPDX-License-Identifier: BSD-3-Clause
// The common part of all worlds: vehicles and senses. The motion is the derived class's.
#pragma once

#include "world/kinematic/senses.hpp"
#include "world/vehicles/vehicle.hpp"
#include "world/world.hpp"

namespace waitpoint::world {

constexpr std::uint32_t number(BodyId id) { return static_cast<std::uint32_t>(id); }

class VehicleWorld : public World {
 public:
  const WorldDescription& description() const final { return description_; }
  void command(BodyId id, Velocity velocity) final { vehicles_.at(index(id)).command(velocity, steps_); }
  std::uint64_t steps() const final { return steps_; }
  void reseed(std::uint64_t seed) final {
    for (Vehicle& vehicle : vehicles_) vehicle.reseed(seed);
    senses_.reseed(seed);
  }

  const BodyState& body(BodyId id) const final { return vehicles_.at(index(id)).state(); }
  const OdometerReading& odometer(BodyId id) const final { return vehicles_.at(index(id)).odometer(); }

  /// Scans with the body's laser number `laser`: the ranges that World::read() rounds to those of the device's
  /// telegram.
  void scan(BodyId id, std::size_t laser, std::uint64_t scan_number, LaserScan& out) const {
    senses_.scan(vehicles_.at(index(id)), number(id), laser, scan_number, elapsed_s(), out);
  }
  void expect_scan(BodyId id, std::size_t laser, std::uint64_t scan_number) final {
    senses_.expect_scan(number(id), laser, scan_number);
  }
  void add_to(WorkingSet& set, BodyId id) const final { vehicles_.at(index(id)).add_to(set); }
  void add_scan_to(WorkingSet& set, BodyId id) const final { senses_.add_scan_to(set, number(id)); }
  double cast(const Beam& beam, double range_max_m, std::optional<BodyId> own = std::nullopt) const final {
    return senses_.cast(beam, range_max_m, own);
  }

 protected:
  /// Without vehicles: the derived class's reset() makes them. The shapes are those of Senses.
  VehicleWorld(const WorldDescription& description, std::span<const Shape> standing, std::span<const Shape> movers);

  double elapsed_s() const { return static_cast<double>(steps_) * step_s_; }
  /// The index of the first obstacle of that name; the number of obstacles if there is none.
  std::size_t find_obstacle(const std::string& name) const;
  /// The name of a body, other than `except`, that a solid with this outline and the shape's heights would touch.
  std::optional<std::string> body_met(const Shape& shape, const Outline& outline, std::uint32_t except) const;
  /// The name of a mesh that it would touch.
  std::optional<std::string> mesh_met(const Shape& shape, const Outline& outline) const;

  WorldDescription description_;
  const double step_s_;
  std::uint64_t steps_ = 0;
  std::vector<Vehicle> vehicles_;
  Senses senses_;  // with the bodies as published at the last step but one, at the beginning of the last step

 private:
  bool read_any(BodyId id, std::size_t device, std::uint64_t reading_number, const AnyReadingOut& out) const final {
    return senses_.read(vehicles_.at(index(id)), number(id), device, reading_number, elapsed_s(), out);
  }
};

}  // namespace waitpoint::world
