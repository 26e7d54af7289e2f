// SPDX-License-Identifier: BSD-3-Clause
#include "world/kinematic/sonar_echoes.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// A reflecting surface is itself hit at its own distance, up to rounding.
constexpr double rounding_m = 1e-9;

}  // namespace

SonarEchoes::SonarEchoes(const Scene& obstacles, const Surfaces& surfaces, const BeamCaster& caster)
    : obstacles_(obstacles), surfaces_(surfaces), caster_(caster) {}

void SonarEchoes::stand(std::span<const Shape> obstacles) {
  WAITPOINT_CHECK(obstacles.size() == obstacles_.size(), "corners are searched for in another scene than the sonars'");
  corners_.clear();
  corners_.resize(obstacles.size());
  std::vector<ConcaveCorner> found;
  for (std::uint32_t i = 0; i < obstacles.size(); ++i) {
    const Shape& shape = obstacles[i];
    const Outline& outline = obstacles_.outline(i);
    if (!outline.is_box) continue;
    obstacles_.near(bounds_of(outline), shape.z_low_m, shape.z_high_m, near_);
    for (const std::uint32_t j : near_) {
      const Outline& other = obstacles_.outline(j);
      if (j <= i || !other.is_box) continue;
      found.clear();
      find_concave_corners(outline, other, found);
      for (const ConcaveCorner& corner : found) corners_[i].push_back({corner, j});
    }
  }
}

void SonarEchoes::collect_surroundings(Point at, double height_m, std::uint32_t own,
                                       const SonarRingDescription& ring) const {
  const Bounds reach = Bounds{at, at}.grown(ring.range_max_m + ring.ring_radius_m);
  near_segments_.clear();
  surfaces_.near(reach, height_m, height_m, near_);
  for (const std::uint32_t number : near_)
    if (const auto segment = cut(surfaces_.triangle(number), height_m)) near_segments_.push_back(*segment);
  near_corners_.find(near_segments_);
  obstacles_.near(reach, height_m, height_m, near_);
  caster_.movers().near(reach, height_m, height_m, near_bodies_);
  std::erase(near_bodies_, own);
}

void SonarEchoes::fire(const Vehicle& body, std::uint32_t own, std::size_t ring_number, std::uint64_t firing,
                       std::span<double> distances_m) const {
  const std::vector<SonarRingDescription>& rings = body.description().sensors<Sonars>();
  const SonarRingDescription& ring = rings.at(ring_number);
  const Pose& pose = body.state().pose;
  const double height_m = ring.height_m + body.state().height_m;
  WAITPOINT_CHECK(distances_m.size() == ring.count, "there are not as many distances as transducers");
  collect_surroundings(pose.position(), height_m, own, ring);
  emitters_.clear();
  for (const SonarRingDescription& other : rings) {
    if (!ring.crosstalk || !other.crosstalk) continue;
    for (std::uint32_t j = 0; j < other.count; ++j)
      if (Sonars::fires(other, j, firing)) emitters_.emplace_back(other, compose(pose, Sonars::mount(other, j)));
  }
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    if (!Sonars::fires(ring, i, firing)) continue;
    const SonarCone cone(ring, compose(pose, Sonars::mount(ring, i)));
    distances_m[i] = nearest_echo(cone, height_m, own);
    for (const SonarCone& emitter : emitters_) {
      const bool itself = emitter.origin() == cone.origin() && emitter.axis() == cone.axis();
      if (!itself && may_hear(cone, emitter))
        distances_m[i] = nearest_cross_echo(cone, emitter, height_m, own, distances_m[i]);
    }
  }
}

double SonarEchoes::nearest_echo(const SonarCone& cone, double height_m, std::uint32_t own) const {
  echoes_.clear();
  for (const std::uint32_t obstacle : near_) {
    WAITPOINT_FAST_CHECK(obstacle < corners_.size(), "an obstacle has no list of corners");
    cone.add(obstacles_.outline(obstacle), echoes_);
    for (const auto& [corner, other] : corners_[obstacle]) {
      if (obstacles_.reaches(other, height_m)) cone.add(corner, echoes_);
    }
  }
  for (const Outline& segment : near_segments_) cone.add_surface(segment, echoes_);
  for (const ConcaveCorner& corner : near_corners_.corners()) cone.add(corner, echoes_);
  for (const ConvexEdge& edge : near_corners_.edges())
    if (edge.is_before(cone.origin())) cone.add_edge(edge.at, echoes_);
  for (const std::uint32_t other : near_bodies_) cone.add(caster_.movers().outline(other), echoes_);
  std::sort(echoes_.begin(), echoes_.end(), [](const Echo& a, const Echo& b) {
    return std::tie(a.distance_m, a.direction.x, a.direction.y) < std::tie(b.distance_m, b.direction.x, b.direction.y);
  });
  for (const Echo& echo : echoes_) {
    const double clear_m = caster_.cast(cone.origin(), echo.direction, height_m, own, echo.distance_m);
    if (clear_m >= echo.distance_m - rounding_m) return echo.distance_m;
  }
  return std::numeric_limits<double>::infinity();
}

// The distance of the nearest echo if it is below `below_m`, else `below_m`.
double SonarEchoes::nearest_cross_echo(const SonarCone& listener, const SonarCone& emitter, double height_m,
                                       std::uint32_t own, double below_m) const {
  cross_echoes_.clear();
  for (const std::uint32_t obstacle : near_) {
    add_cross_echoes(emitter, listener, obstacles_.outline(obstacle), cross_echoes_);
    for (const auto& [corner, other] : corners_[obstacle]) {
      if (obstacles_.reaches(other, height_m)) add_cross_echoes(emitter, listener, corner, cross_echoes_);
    }
  }
  for (const Outline& segment : near_segments_) add_cross_echoes(emitter, listener, segment, cross_echoes_);
  for (const ConcaveCorner& corner : near_corners_.corners())
    add_cross_echoes(emitter, listener, corner, cross_echoes_);
  for (const std::uint32_t other : near_bodies_)
    add_cross_echoes(emitter, listener, caster_.movers().outline(other), cross_echoes_);
  for (const CrossEcho& echo : cross_echoes_) {
    if (echo.distance_m < below_m && clear(emitter.origin(), echo.at, height_m, own) &&
        clear(listener.origin(), echo.at, height_m, own))
      below_m = echo.distance_m;
  }
  return below_m;
}

bool SonarEchoes::clear(Point from, Point to, double height_m, std::uint32_t own) const {
  const Point way = to - from;
  const double distance_m = length(way);
  if (distance_m == 0) return true;
  return caster_.cast(from, (1 / distance_m) * way, height_m, own, distance_m) >= distance_m - rounding_m;
}

}  // namespace waitpoint::world
