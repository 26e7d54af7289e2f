// SPDX-License-Identifier: BSD-3-Clause
#include "modules/playback/log_player.hpp"

#include <algorithm>
#include <cmath>

#include "fibers/sync/threads.hpp"

namespace waitpoint::playback {
namespace {

using namespace std::chrono_literals;

constexpr Duration look_period = 1ms;
constexpr Duration of_speed_least = 1ms;  // of shorter times no speed follows
constexpr const char* writer = "the log's player";

std::int64_t units(double value, double per_unit) { return static_cast<std::int64_t>(std::llround(value * per_unit)); }

}  // namespace

LogPlayer::LogPlayer(const logs::SensorLog& log, const logs::PlayingOrder& order, genom::NameSpace& names,
                     const DevicePosters& posters)
    : log_(log),
      order_(order),
      base_(names.create_poster<posters::BaseReading>(posters.base, writer)),
      laser_(names.create_poster<posters::LaserReading>(posters.laser, writer)) {}

// Dead reckoning begins at the first report that is read, which must be the first of the log.
void LogPlayer::run() {
  bool is_awaited = false;
  for (const logs::Played& record : order_.records) {
    threads::this_thread::sleep_until(record.date);
    if (is_awaited && !wait_until_read()) return;
    is_awaited = record.scan || !written_;
    write_report(record);
    if (record.scan) write_scan(record);
  }
  if (is_awaited) wait_until_read();
}

bool LogPlayer::wait_until_read() {
  const Time latest = threads::now() + patience;
  const auto is_scan_read = [this] { return scan_.number == 0 || laser_.was_read(); };
  while (!base_.was_read() || !is_scan_read()) {
    if (threads::now() >= latest) {
      unread_ = is_scan_read() ? base_.name() : laser_.name();
      return false;
    }
    threads::this_thread::sleep_for(std::chrono::nanoseconds(look_period.ns()));
  }
  return true;
}

void LogPlayer::write_report(const logs::Played& record) {
  if (!written_) {
    written_.emplace();
    written_->reckoning.set(record.odometry);
    written_->reckoning.advance(record.date, 0, 0, 0);
    read_ = written_;
  } else {
    if (base_.was_read()) read_ = written_;
    const posters::PositionEstimate& from = read_->reckoning.position();
    Counted next = *read_;
    const std::int64_t turned = units(exact::wrap_angle(record.odometry.heading - from.pose.heading), units_per_radian);
    const double turn_rad = static_cast<double>(turned) / units_per_radian;
    const auto [s, c] = exact::sincos(from.pose.heading + 0.5 * turn_rad);
    const double dx = record.odometry.x - from.pose.x, dy = record.odometry.y - from.pose.y;
    next.travel += units(dx * c + dy * s, units_per_metre);
    next.side += units(dy * c - dx * s, units_per_metre);
    next.turn += turned;
    next.reckoning.advance(record.date, next.travel, next.turn, next.side);
    const Duration since = record.date - from.date;
    if (since >= of_speed_least) {
      report_.v_m_s = static_cast<double>(next.travel - read_->travel) / units_per_metre / since.seconds();
      report_.w_rad_s = turn_rad / since.seconds();
    }
    written_ = next;
  }
  report_.date = record.date;
  report_.travel_units = written_->travel;
  report_.side_units = written_->side;
  report_.turn_units = written_->turn;
  base_.write(report_);
}

void LogPlayer::write_scan(const logs::Played& record) {
  const logs::LoggedScan& scan = log_.scans[*record.scan];
  // Of more beams than the poster holds, every n-th.
  const std::size_t every = (scan.range_m.size() + world::Lasers::count_max - 1) / world::Lasers::count_max;
  ++scan_.number;
  scan_.date = record.date;
  scan_.first_angle_rad = scan.first_angle_rad;
  scan_.angle_step_rad = scan.angle_step_rad * static_cast<double>(std::max<std::size_t>(every, 1));
  scan_.range_max_m = scan.range_max_m;
  scan_.range_m.clear();
  for (std::size_t i = 0; i < scan.range_m.size(); i += every) scan_.range_m.push_back(scan.range_m[i]);
  laser_.write(scan_);
  greatest_delay_ = std::max(greatest_delay_, threads::now() - record.date);
}

}  // namespace waitpoint::playback
