// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/poster_topics.hpp"

#include <fmt/format.h>

#include "core/nearest_name.hpp"
#include "modules/nodes/world_topics.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/inertial.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::nodes {
namespace {

std::optional<PosterReading> reading_of(const posters::PositionEstimate& position) {
  return PosterReading{0, position.date.since_start().ns(), PoseReading{place_of(position.pose), position.covariance}};
}

std::optional<PosterReading> reading_of(const posters::FusedPosition& fused) { return reading_of(fused.position); }

std::optional<PosterReading> reading_of(const posters::Localisation& localisation) {
  return localisation.lost ? std::nullopt : reading_of(localisation.position);
}

std::optional<PosterReading> reading_of(const posters::Odometry& odometry) {
  return PosterReading{0, odometry.position.date.since_start().ns(),
                       OdometryReading{place_of(odometry.position.pose, odometry.height_m),
                                       odometry.position.covariance, Speeds{odometry.v_m_s, 0, 0, odometry.w_rad_s}}};
}

std::optional<PosterReading> reading_of(const posters::Echoes& echoes) {
  const posters::LaserReading& scan = echoes.scan;
  EchoesReading reading{scan.first_angle_rad, scan.angle_step_rad, scan.range_max_m, {}};
  reading.ranges.assign(scan.range_m.begin(), scan.range_m.end());
  return PosterReading{0, scan.date.since_start().ns(), std::move(reading)};
}

std::optional<PosterReading> reading_of(const posters::SpeedReference& speed) {
  return PosterReading{0, speed.date.since_start().ns(),
                       Speeds{speed.v_m_s, speed.side_m_s, speed.climb_m_s, speed.w_rad_s}};
}

std::optional<PosterReading> reading_of(const posters::Inertial& inertial) {
  return PosterReading{0, inertial.date.since_start().ns(),
                       ImuReading{inertial.turn_rad_s, inertial.ahead_m_s2, inertial.left_m_s2, inertial.up_m_s2}};
}

using Look = std::function<std::optional<PosterReading>()>;

// Null for a poster of another type.
template <class T>
Look look_at(const genom::PosterBase& base, std::size_t topic) {
  const auto* const poster = dynamic_cast<const genom::Poster<T>*>(&base);
  if (poster == nullptr) return nullptr;
  return [poster, topic]() -> std::optional<PosterReading> {
    const std::optional<T> value = poster->look();
    std::optional<PosterReading> reading = value ? reading_of(*value) : std::nullopt;
    if (reading) reading->topic = topic;
    return reading;
  };
}

template <class... Types>
Look look_at_any(const genom::PosterBase& base, std::size_t topic) {
  Look look;
  (void)((look = look_at<Types>(base, topic)) || ...);
  return look;
}

}  // namespace

PosterTopics::PosterTopics(const std::vector<scenario::PosterTopic>& table, const genom::NameSpace& names) {
  rows_.reserve(table.size());
  for (const scenario::PosterTopic& row : table) {
    const genom::PosterBase* const poster = names.find_poster(row.poster);
    if (poster == nullptr) {
      std::vector<std::string_view> known;
      for (const auto& [name, entry] : names.posters()) known.push_back(name);
      throw row.written.bad("no module writes poster '" + row.poster + "'" + did_you_mean(row.poster, known));
    }
    Look look = look_at_any<posters::FusedPosition, posters::Localisation, posters::Odometry, posters::Echoes,
                            posters::SpeedReference, posters::Inertial>(*poster, rows_.size());
    if (look == nullptr)
      throw row.written.bad("poster '" + row.poster +
                            "' cannot be a topic: expected a position, odometry, echoes, a speed or inertial readings");
    rows_.push_back({std::move(look), std::nullopt});
  }
}

void PosterTopics::read(std::vector<PosterReading>& readings) {
  for (Row& row : rows_) {
    std::optional<PosterReading> reading = row.look();
    if (!reading || row.given_ns == reading->date_ns) continue;
    row.given_ns = reading->date_ns;
    readings.push_back(std::move(*reading));
  }
}

}  // namespace waitpoint::nodes
