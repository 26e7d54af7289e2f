// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/beam_caster.hpp"

#include <algorithm>
#include <numeric>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

std::vector<double> sliced_heights(const WorldDescription& description) {
  std::vector<double> heights;
  if (description.engine == Engine::fcl) return heights;
  for (const BodyDescription& body : description.bodies) {
    // Aerial bodies would need a slice at every height.
    if (body.base.kind == BaseDescription::Kind::aerial) continue;
    for (const LaserDescription& laser : body.sensors<Lasers>()) heights.push_back(laser.height_m);
    for (const SonarRingDescription& ring : body.sensors<Sonars>()) heights.push_back(ring.height_m);
    if (body.sensors<Infrareds>()) heights.push_back(body.sensors<Infrareds>()->height_m);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

}  // namespace

BeamCaster::BeamCaster(const WorldDescription& description, const Surfaces& surfaces, const Scene& obstacles,
                       Scene& movers)
    : obstacles_(obstacles),
      meshes_(description.meshes),
      movers_(movers),
      slices_beams_(description.engine != Engine::fcl),
      heights_m_(sliced_heights(description)),
      moving_(std::span<const Shape>()) {
  for (const double height_m : heights_m_) cuts_.push_back(surfaces.cut(height_m));
}

void BeamCaster::stand(std::span<const Shape> obstacles) {
  slices_.clear();
  for (std::size_t i = 0; i < heights_m_.size(); ++i) {
    std::vector<std::uint32_t> numbers = cuts_[i].meshes;
    for (std::uint32_t& number : numbers) number += static_cast<std::uint32_t>(obstacles.size());
    slices_.emplace_back(obstacles, heights_m_[i], cuts_[i].segments, numbers);
  }
}

void BeamCaster::move(std::span<const Shape> movers) {
  if (slices_beams_) moving_ = MovingSolids(movers);
  late_.clear();
  is_late_.assign(movers.size(), 0);
}

void BeamCaster::place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m) {
  WAITPOINT_FAST_CHECK(mover < is_late_.size(), "a mover that does not exist is placed");
  if (!slices_beams_) return movers_.place(mover, outline, z_low_m, z_high_m);
  moving_.place(mover, outline, z_low_m, z_high_m);
  if (is_late_[mover] != 0) return;
  is_late_[mover] = 1;
  late_.push_back(mover);
}

const Scene& BeamCaster::movers() const {
  for (const std::uint32_t mover : late_) {
    movers_.place(mover, moving_.outline(mover), moving_.z_low_m(mover), moving_.z_high_m(mover));
    is_late_[mover] = 0;
  }
  late_.clear();
  return movers_;
}

void BeamCaster::list_movers(std::vector<std::uint32_t>& movers) const {
  if (slices_beams_) return moving_.list_by_leaves(movers);
  movers.resize(movers_.size());
  std::iota(movers.begin(), movers.end(), 0u);
}

const Slice* BeamCaster::slice_at(double height_m) const {
  const auto found = std::lower_bound(heights_m_.begin(), heights_m_.end(), height_m);
  WAITPOINT_FAST_CHECK(slices_.size() == heights_m_.size(), "there is not one slice for each height");
  return found == heights_m_.end() || *found != height_m
             ? nullptr
             : &slices_[static_cast<std::size_t>(found - heights_m_.begin())];
}

void BeamCaster::cast(const Fan& fan, double height_m, std::uint32_t own, double range_max_m,
                      std::span<double> ranges_m) const {
  WAITPOINT_CHECK(fan.directions.size() == ranges_m.size(), "there are not as many directions as ranges");
  if (const Slice* slice = slice_at(height_m)) {
    buffer_.begin(fan, range_max_m);
    // Movers are mostly nearer than walls, but for many beams walls hide more of the movers than movers of the walls.
    const bool few = fan.directions.size() <= FewBeams::most;
    if (few) buffer_.lower(moving_, height_m, own);
    buffer_.lower(*slice);
    if (!few) buffer_.lower(moving_, height_m, own);
    std::copy(buffer_.ranges_m().begin(), buffer_.ranges_m().end(), ranges_m.begin());
    return;
  }
  directions_.clear();
  for (const Point& d : fan.directions)
    directions_.push_back({fan.axis.x * d.x - fan.axis.y * d.y, fan.axis.y * d.x + fan.axis.x * d.y});
  std::fill(ranges_m.begin(), ranges_m.end(), range_max_m);
  obstacles_.cast(fan.origin, directions_, height_m, Scene::none, ranges_m);
  meshes_.cast(fan.origin, directions_, height_m, ranges_m);
  movers().cast(fan.origin, directions_, height_m, own, ranges_m);
}

double BeamCaster::cast(Point origin, Point direction, double height_m, std::uint32_t own, double range_max_m) const {
  const Point ahead = {1, 0};
  double range_m = range_max_m;
  cast({origin, direction, 0, {&ahead, 1}}, height_m, own, range_max_m, {&range_m, 1});
  return range_m;
}

}  // namespace waitpoint::world
