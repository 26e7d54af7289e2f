// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/looks.hpp"

namespace waitpoint::executive {

using genom::PosterStatus;

namespace {
constexpr std::size_t looks_kept = 20;  // of two a second: slightly longer than the patience of `ndd`
}  // namespace

void connect_for_executive(const genom::NameSpace& names, genom::PosterLinkBase& link) {
  genom::PosterBase* poster = names.find_poster(link.name());
  if (poster == nullptr || !link.connect(*poster))
    throw BadInput("the executive",
                   "reads poster '" + link.name() + "', which no module of this robot writes with that type");
}

void Looks::connect(const genom::NameSpace& names) {
  connect_for_executive(names, position_);
  connect_for_executive(names, echoes_);
}

bool Looks::have_begun() const {
  posters::FusedPosition position;
  posters::Echoes echoes;
  return position_.read(position) == PosterStatus::ok && echoes_.read(echoes) == PosterStatus::ok;
}

Point Looks::position() const {
  posters::FusedPosition position;
  position_.read(position);
  return position.position.pose.position();
}

void Looks::look() {
  posters::FusedPosition position;
  posters::Echoes echoes;
  if (position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty) return;
  std::vector<Point> points;
  const Pose device = compose(position.position.pose, echoes.mount);
  for (std::size_t i = 0; i < echoes.scan.range_m.size(); ++i) {
    const double range = static_cast<double>(echoes.scan.range_m[i]);
    if (range >= range_m_max_ || range >= echoes.scan.range_max_m) continue;
    const auto [s, c] =
        exact::sincos(echoes.scan.first_angle_rad + echoes.scan.angle_step_rad * static_cast<double>(i));
    points.push_back(transform(device, {range * c, range * s}));
  }
  looks_.push_back(std::move(points));
  if (looks_.size() > looks_kept) looks_.pop_front();
}

std::vector<Point> Looks::seen() const {
  std::vector<Point> points;
  for (const std::vector<Point>& look : looks_) points.insert(points.end(), look.begin(), look.end());
  return points;
}

}  // namespace waitpoint::executive
