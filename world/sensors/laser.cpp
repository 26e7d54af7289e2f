// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/laser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/exact_batch.hpp"
#include "core/random_batch.hpp"
#include "world/sensors/laser_timing.hpp"

namespace waitpoint::world {
namespace {

// The least range in the computation of a spot's angular width, which it bounds.
constexpr double nearest_spot_m = 0.05;
// For a beam that is a line, two more rays at this angle beside it give the incidence on a surface.
constexpr double feeler_rad = 5e-4;

Point turned(Point v, double angle_rad) {
  const auto [s, c] = exact::sincos(angle_rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

double measured(const LaserDescription& laser, double true_m, double bias_m, double normal) {
  if (true_m >= laser.range_max_m) return laser.range_max_m;
  double range = true_m + bias_m + range_noise_m(laser, true_m) * normal;
  if (laser.resolution_m > 0) range = std::nearbyint(range / laser.resolution_m) * laser.resolution_m;
  return std::clamp(range, 0.0, laser.range_max_m);
}

/// The hits of the three rays of one spot: the middle one, and those at +- `half_rad`.
struct Spot {
  double middle_m, left_m, right_m, half_rad;

  // On a plane, 1 / distance is a cosine of the angle: its mean over the two ends follows from the middle,
  bool on_a_plane() const {
    constexpr double rounding = 1e-6;
    return std::fabs(middle_m * (1 / left_m + 1 / right_m) - 2 * exact::cos(half_rad)) < rounding;
  }
  // and its difference is 2 sin(half) tan(incidence).
  bool flatter_than(double incidence_rad) const {
    const double slope = middle_m * std::fabs(1 / right_m - 1 / left_m);
    const auto [s, c] = exact::sincos(incidence_rad);
    return slope * c > 2 * exact::sin(half_rad) * s;
  }
};

bool is_plain(const LaserDescription& d) {
  return d.mirror_turn == Duration() && d.angle_noise_rad == 0 && d.spot_m == 0 && d.spot_divergence_rad == 0 &&
         d.incidence_max_rad >= 0.5 * exact::pi;
}

RandomStream stream(std::uint64_t seed, std::string_view robot, std::size_t number, std::string_view what) {
  return RandomStream(seed, robot, "laser " + std::to_string(number) + "." + std::string(what));
}

}  // namespace

double range_noise_m(const LaserDescription& laser, double range_m) {
  constexpr double constant_to_m = 8, grown_from_m = 20;
  const double growth = (range_m - constant_to_m) / (grown_from_m - constant_to_m);
  return laser.range_noise_m * (1 + (laser.noise_growth - 1) * std::clamp(growth, 0.0, 1.0));
}

LaserKind::LaserKind(const LaserDescription& of)
    : description(of),
      plain(is_plain(of)),
      first_angle_rad(-0.5 * of.field_of_view_rad),
      angle_step_rad(of.beams > 1 ? of.field_of_view_rad / (of.beams - 1) : 0) {
  WAITPOINT_CHECK(of.beams > 0 && of.range_max_m > 0, "a laser has no beam or no range");
  for (std::uint32_t i = 0; i < of.beams; ++i) {
    const auto [s, c] = exact::sincos(first_angle_rad + i * angle_step_rad);
    directions.push_back({c, s});
  }
}

std::shared_ptr<const LaserKind> LaserKinds::of(const LaserDescription& description) {
  constexpr std::size_t remembered = 8;
  for (const auto& kind : latest_)
    if (kind->description == description) return kind;
  if (latest_.size() == remembered) latest_.pop_front();
  return latest_.emplace_back(std::make_shared<LaserKind>(description));
}

Laser::Draws::Draws(std::uint64_t seed, std::string_view robot, std::size_t number)
    : range_noise(stream(seed, robot, number, "range")),
      angle_noise(stream(seed, robot, number, "angle")),
      mixed(stream(seed, robot, number, "mixed")),
      dropout(stream(seed, robot, number, "dropout")) {}

Laser::Laser(std::shared_ptr<const LaserKind> kind, std::uint64_t seed, std::string_view robot, std::size_t number)
    : kind_(std::move(kind)), draws_(seed, robot, number) {}

void Laser::look(std::uint64_t scan_number, const ArcTrail& body, const RayCaster& caster,
                 std::span<double> ranges_m) const {
  WAITPOINT_CHECK(ranges_m.size() == directions().size(), "as many ranges as beams");
  const LaserDescription& d = description();
  const double span_s = scan_span_s(d);
  for (std::uint32_t i = 0; i < d.beams; ++i) {
    WAITPOINT_FAST_CHECK(beam_time_s(d, i) <= span_s, "a beam is measured after the end of its scan");
    const Pose device = compose(body.at(span_s - beam_time_s(d, i)), d.mount);
    Point direction = turned(directions()[i], device.heading);
    if (d.angle_noise_rad > 0) {
      const std::array<double, 2> normals = draws_.angle_noise.normal_pair(scan_number, i / 2);
      direction = turned(direction, d.angle_noise_rad * normals[i % 2]);
    }
    ranges_m[i] = seen_m(scan_number, i, {device.position(), direction}, caster);
  }
}

double Laser::seen_m(std::uint64_t scan_number, std::size_t beam, const Ray& middle, const RayCaster& caster) const {
  const LaserDescription& d = description();
  const double middle_m = caster.distance_m(middle);
  WAITPOINT_FAST_CHECK(0 <= middle_m && middle_m <= d.range_max_m, "a ray's length is not between 0 and its limit");
  const bool wide = d.spot_m > 0 || d.spot_divergence_rad > 0;
  if (!wide && d.incidence_max_rad >= 0.5 * exact::pi) return middle_m;

  const double half_rad =
      wide ? 0.5 * (d.spot_divergence_rad + d.spot_m / std::max(middle_m, nearest_spot_m)) : feeler_rad;
  const Spot spot = {middle_m, caster.distance_m({middle.origin, turned(middle.direction, half_rad)}),
                     caster.distance_m({middle.origin, turned(middle.direction, -half_rad)}), half_rad};
  double near_m = d.range_max_m, far_m = 0;
  for (const double range_m : {middle_m, spot.left_m, spot.right_m}) {
    near_m = std::min(near_m, range_m);
    if (range_m < d.range_max_m) far_m = std::max(far_m, range_m);
  }
  if (near_m >= d.range_max_m) return d.range_max_m;
  const bool whole = near_m > 0 && std::max({middle_m, spot.left_m, spot.right_m}) < d.range_max_m;
  const bool jumps = far_m - near_m > d.mixed_jump_m && !(whole && spot.on_a_plane());
  if (jumps) return wide ? near_m + (far_m - near_m) * draws_.mixed.uniform(scan_number, beam) : middle_m;
  if (whole && spot.flatter_than(d.incidence_max_rad)) return d.range_max_m;
  return wide && middle_m >= d.range_max_m ? near_m : middle_m;
}

void Laser::measure(std::uint64_t scan_number, double on_s, std::span<double> ranges_m) const {
  const LaserDescription& d = description();
  WAITPOINT_FAST_CHECK(on_s >= 0, "a laser measures before it is switched on");
  const bool warms_up = d.warm_up_bias_m != 0;
  const double bias_m = d.range_bias_m + (warms_up ? d.warm_up_bias_m * exact::exp(-on_s / d.warm_up_s) : 0);
  const bool noisy = d.range_noise_m > 0;
  std::array<std::array<double, 2>, exact::batch> normals{};
  for (std::size_t first = 0; first < ranges_m.size(); first += 2 * normals.size()) {
    const std::span<double> part = ranges_m.subspan(first, std::min(2 * normals.size(), ranges_m.size() - first));
    if (noisy)
      normal_pairs(draws_.range_noise, scan_number, first / 2, std::span(normals).first((part.size() + 1) / 2));
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = measured(d, part[i], bias_m, normals[i / 2][i % 2]);
  }
  if (d.dropout <= 0) return;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (draws_.dropout.uniform(scan_number, i) < d.dropout) ranges_m[i] = d.range_max_m;
  }
}

}  // namespace waitpoint::world
