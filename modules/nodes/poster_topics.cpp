// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/poster_topics.hpp"

#include "core/nearest_name.hpp"
#include "modules/messages/readings.hpp"
#include "modules/messages/wire.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/position.hpp"
#include "world/sensors/types/sensors.hpp"

namespace waitpoint::nodes {
namespace {

// The date of a value; nothing for one that is not to be used.
std::optional<Time> date_of(const posters::FusedPosition& fused) { return fused.position.date; }
std::optional<Time> date_of(const posters::Localisation& found) {
  return found.lost ? std::nullopt : std::optional(found.position.date);
}
std::optional<Time> date_of(const posters::Odometry& odometry) { return odometry.position.date; }
std::optional<Time> date_of(const posters::Echoes& echoes) { return echoes.scan.date; }
std::optional<Time> date_of(const posters::SpeedReference& speed) { return speed.date; }
/// Of a sensor's reading.
std::optional<Time> date_of(const auto& reading) {
  if constexpr (requires { reading.number; })
    if (reading.number == 0) return std::nullopt;
  return reading.date;
}

auto message_of(const posters::FusedPosition& fused, const PosterFrames&) {
  return messages::message_of(fused.position, "map");
}
auto message_of(const posters::Localisation& found, const PosterFrames&) {
  return messages::message_of(found.position, "map");
}
auto message_of(const posters::Odometry& odometry, const PosterFrames& frames) {
  return messages::message_of(odometry, frames.prefix + "modules_odom", frames.prefix + "base_link");
}
auto message_of(const posters::Echoes& echoes, const PosterFrames& frames) {
  messages::sensor_msgs::LaserScan message = messages::message_of(echoes.scan, frames.laser);
  message.scan_time = static_cast<float>(frames.scan_time_s);
  return message;
}
auto message_of(const posters::SpeedReference& speed, const PosterFrames&) {
  return messages::geometry_msgs::Twist{{speed.v_m_s, speed.side_m_s, speed.climb_m_s}, {0, 0, speed.w_rad_s}};
}
auto message_of(const auto& reading, const PosterFrames& frames) {
  bool in_world_frame = false;
  world::Sensors::for_each([&]<class S>() {
    if constexpr (requires { S::in_world_frame; })
      in_world_frame |= std::is_same_v<typename S::Reading, std::remove_cvref_t<decltype(reading)>>;
  });
  return messages::message_of(reading, in_world_frame ? "map" : frames.prefix + "base_link");
}

}  // namespace

// Null for a poster of another type.
template <class T>
std::function<std::optional<PosterTopics::Value>(const std::optional<Time>&)> PosterTopics::look_at(
    const genom::PosterBase& base) const {
  const auto* const poster = dynamic_cast<const genom::Poster<T>*>(&base);
  if (poster == nullptr) return nullptr;
  return [poster, this](const std::optional<Time>& published) -> std::optional<Value> {
    const std::optional<T> value = poster->look();
    const std::optional<Time> date = value ? date_of(*value) : std::nullopt;
    if (!date || date == published) return std::nullopt;
    auto message = message_of(*value, frames_);
    if constexpr (requires { message.header; })
      message.header.stamp = messages::stamp_of(frames_.begin + date->since_start());
    return Value{*date, &messages::ros1_type<decltype(message)>(), messages::encode<messages::Wire::ros1>(message)};
  };
}

template <class... Types>
bool PosterTopics::find_look(const genom::PosterBase& base, Row& row) const {
  bool is_found = ((row.look = look_at<Types>(base)) || ...);
  world::Sensors::for_each([&]<class S>() {
    if constexpr (requires(const typename S::Reading& reading) { messages::message_of(reading, std::string()); })
      is_found = is_found || (row.look = look_at<typename S::Reading>(base));
  });
  return is_found;
}

PosterTopics::PosterTopics(const scenario::NodesScenario& nodes, const genom::NameSpace& names, PosterFrames frames)
    : frames_(std::move(frames)) {
  for (const scenario::PosterTopic& entry : scenario::poster_topics(nodes)) {
    const genom::PosterBase* const poster = names.find_poster(entry.poster);
    if (poster == nullptr) {
      std::vector<std::string_view> known;
      for (const auto& [name, other] : names.posters()) known.push_back(name);
      throw entry.written.bad("no module writes poster '" + entry.poster + "'" + did_you_mean(entry.poster, known));
    }
    Row& row = rows_.emplace_back(Row{entry.topic, nullptr});
    if (!find_look<posters::FusedPosition, posters::Localisation, posters::Odometry, posters::Echoes,
                   posters::SpeedReference>(*poster, row))
      throw entry.written.bad("poster '" + entry.poster +
                              "' cannot be a topic: expected a position, odometry, echoes, a speed, inertial "
                              "readings or position fixes");
  }
}

void PosterTopics::publish(NodeSide& nodes, const std::function<std::string(const std::string& topic)>& global) {
  constexpr std::uint32_t queue = 10;
  for (Row& row : rows_) {
    const std::optional<Value> value = row.look(row.published);
    if (!value) continue;
    row.published = value->date;
    if (!row.advertised) row.advertised = nodes.advertise(global(row.topic), *value->type, queue, false);
    nodes.publish(*row.advertised, value->bytes);
  }
}

}  // namespace waitpoint::nodes
