// SPDX-License-Identifier: BSD-3-Clause
// Plays a log of sensors to a robot's modules, in the place of the bridge to a world: the base's reports and the
// laser's scans go to the posters of these devices at their dates in virtual time.
//
// No scan is lost: the record after a scan is written when the modules have read that scan and the base's report
// before it, which may be later than its date. Reports without a scan replace one another, as those of a base do.
//
// A report has the base's accumulated travel, sideways travel and turn. They are such that dead reckoning, which adds
// up arcs from one report that it reads to the next, comes to the pose of the log's odometry: each report is calculated
// from the last one that was read.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "modules/genom/name_space.hpp"
#include "modules/logs/playing_order.hpp"
#include "modules/logs/sensor_log.hpp"
#include "modules/playback/log_settings.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"
#include "modules/rflex/dead_reckoning.hpp"

namespace waitpoint::playback {

struct DevicePosters {
  std::string base = "rflex.reading", laser = "sick.reading";
};

/// The base's counters, and the pose to which dead reckoning comes by them.
struct Counted {
  rflex::DeadReckoning reckoning{{}, units_per_metre, units_per_radian};
  std::int64_t travel = 0, side = 0, turn = 0;
};

class LogPlayer {
 public:
  /// Longer than the period of any module.
  static constexpr Duration patience = std::chrono::minutes(10);

  /// Creates the posters. Log, order and names must outlive the player.
  LogPlayer(const logs::SensorLog& log, const logs::PlayingOrder& order, genom::NameSpace& names,
            const DevicePosters& posters);

  /// The body of the player's task, which is in the world's phase: returns when the last scan has been read.
  void run();

  std::uint64_t scans() const { return scan_.number; }
  /// The greatest time from a scan's date to its writing.
  Duration greatest_delay() const { return greatest_delay_; }
  /// The poster that was not read within `patience`, which ended the play; empty: none.
  const std::string& unread() const { return unread_; }
  /// The posters that the log feeds.
  std::array<const genom::PosterBase*, 2> posters() const { return {&base_, &laser_}; }

 private:
  bool wait_until_read();
  void write_report(const logs::Played& record);
  void write_scan(const logs::Played& record);

  const logs::SensorLog& log_;
  const logs::PlayingOrder& order_;
  genom::Poster<posters::BaseReading>& base_;
  genom::Poster<posters::LaserReading>& laser_;
  std::optional<Counted> read_, written_;
  posters::BaseReading report_;
  posters::LaserReading scan_;
  Duration greatest_delay_;
  std::string unread_;
};

}  // namespace waitpoint::playback
