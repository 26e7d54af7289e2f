// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/whereabouts.hpp"

#include <algorithm>
#include <cmath>

#include "modules/executive/looks.hpp"

namespace waitpoint::executive {

using genom::PosterStatus;

void Whereabouts::connect(const genom::NameSpace& names) {
  has_localisation_ = names.find_poster(localisation_.name()) != nullptr;
  if (has_localisation_) connect_for_executive(names, localisation_);
  connect_for_executive(names, position_);
  connect_for_executive(names, echoes_);
}

bool Whereabouts::lost(bool before) const {
  posters::Localisation localisation;
  if (!has_localisation_) return false;
  return localisation_.read(localisation) == PosterStatus::empty ? before : localisation.lost;
}

std::optional<Point> Whereabouts::open_place(double radius_m, double distance_m_max) const {
  posters::FusedPosition position;
  posters::Echoes echoes;
  if (position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty)
    return std::nullopt;
  const posters::LaserReading& scan = echoes.scan;
  std::vector<Point> directions;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const auto [s, c] = exact::sincos(scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(i));
    directions.push_back({c, s});
  }
  // Of each eighth beam: how far a lane of one and a half hulls' width is free.
  constexpr std::size_t beams_apart = 8;
  double best_m = radius_m;
  Point best;
  for (std::size_t i = 0; i < directions.size(); i += beams_apart) {
    double free_m = distance_m_max;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const Point echo = static_cast<double>(scan.range_m[k]) * directions[k];
      const double along_m = dot(echo, directions[i]), across_m = cross(directions[i], echo);
      if (along_m > 0 && std::fabs(across_m) < 1.5 * radius_m) free_m = std::min(free_m, along_m - 2 * radius_m);
    }
    if (free_m > best_m) {
      best_m = free_m;
      best = free_m * directions[i];
    }
  }
  if (best_m == radius_m) return std::nullopt;
  return transform(compose(position.position.pose, echoes.mount), best);
}

}  // namespace waitpoint::executive
