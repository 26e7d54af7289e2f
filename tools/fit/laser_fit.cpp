// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/laser_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "modules/logs/playing_order.hpp"
#include "tools/fit/log_scan.hpp"
#include "tools/fit/median.hpp"

namespace waitpoint::tools {
namespace {

constexpr std::size_t scans_least = 10;
constexpr double still_m = 1e-4, still_rad = 1e-4;
constexpr double same_m = 0.05;  // greater differences are of something that moved, or of an edge
constexpr double apart_s_max = 2;

struct Scan {
  const logs::LoggedScan* scan;
  Time date;
  Pose odometry;
};

std::vector<Scan> in_order(const logs::SensorLog& log) {
  std::vector<Scan> scans;
  for (const logs::Played& record : logs::playing_order(log).records)
    if (record.scan) scans.push_back({&log.scans[*record.scan], record.date, record.odometry});
  return scans;
}

bool is_echo(const logs::LoggedScan& scan, std::size_t beam) {
  return scan.range_m[beam] > 0 && scan.range_m[beam] < scan.range_max_m;
}

bool is_still(const Scan& a, const Scan& b) {
  const Pose moved = between(a.odometry, b.odometry);
  return length(moved.position()) < still_m && std::fabs(moved.heading) < still_rad &&
         (b.date - a.date).seconds() < apart_s_max && a.scan->range_m.size() == b.scan->range_m.size();
}

double resolution_of(const logs::SensorLog& log) {
  constexpr double off_max = 2e-4, share_least = 0.99;
  for (const double step_m : {0.1, 0.05, 0.01, 0.005, 0.001}) {
    std::uint64_t readings = 0, multiples = 0;
    for (const logs::LoggedScan& scan : log.scans)
      for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
        if (!is_echo(scan, i)) continue;
        ++readings;
        const double steps = static_cast<double>(scan.range_m[i]) / step_m;
        if (std::fabs(steps - std::round(steps)) * step_m < off_max) ++multiples;
      }
    if (static_cast<double>(multiples) > share_least * static_cast<double>(readings)) return step_m;
  }
  return 0;
}

void fit_noise(const std::vector<Scan>& scans, LaserFit& fit) {
  double squares = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (!is_still(scans[i - 1], scans[i])) continue;
    const logs::LoggedScan &before = *scans[i - 1].scan, &after = *scans[i].scan;
    for (std::size_t beam = 0; beam < after.range_m.size(); ++beam) {
      const double difference = static_cast<double>(after.range_m[beam]) - static_cast<double>(before.range_m[beam]);
      if (!is_echo(before, beam) || !is_echo(after, beam) || std::fabs(difference) > same_m) continue;
      squares += difference * difference;
      ++fit.noise_pairs;
    }
  }
  if (fit.noise_pairs == 0) return;
  const double rounding = fit.resolution_m * fit.resolution_m / 12;
  fit.range_noise_m = std::sqrt(std::max(0.0, squares / static_cast<double>(fit.noise_pairs) / 2 - rounding));
}

void fit_dropout(const std::vector<Scan>& scans, LaserFit& fit) {
  std::uint64_t agreed = 0, dropped = 0;
  for (std::size_t i = 2; i < scans.size(); ++i) {
    if (!is_still(scans[i - 2], scans[i - 1]) || !is_still(scans[i - 1], scans[i])) continue;
    const logs::LoggedScan &first = *scans[i - 2].scan, &middle = *scans[i - 1].scan, &last = *scans[i].scan;
    for (std::size_t beam = 0; beam < last.range_m.size(); ++beam) {
      if (!is_echo(first, beam) || !is_echo(last, beam)) continue;
      if (std::fabs(static_cast<double>(first.range_m[beam] - last.range_m[beam])) > same_m) continue;
      ++agreed;
      dropped += is_echo(middle, beam) ? 0 : 1;
    }
  }
  if (agreed > 0) fit.dropout = static_cast<double>(dropped) / static_cast<double>(agreed);
}

void fit_timing(const std::vector<Scan>& scans, LaserFit& fit) {
  std::vector<double> times_s;
  for (std::size_t i = 1; i < scans.size(); ++i) times_s.push_back((scans[i].date - scans[i - 1].date).seconds());
  fit.period_s = median(times_s);
  double squares = 0;
  std::uint64_t count = 0;
  for (const double time_s : times_s) {
    if (time_s >= 1.5 * fit.period_s) {
      fit.missing += static_cast<std::uint64_t>(std::llround(time_s / fit.period_s)) - 1;
      continue;
    }
    squares += exact::square(time_s - fit.period_s);
    ++count;
  }
  fit.jitter_s = std::sqrt(squares / static_cast<double>(std::max<std::uint64_t>(count, 1)));
}

}  // namespace

LaserFit fit_laser(const logs::SensorLog& log) {
  if (log.scans.size() < scans_least)
    throw BadInput(log.file, "expected at least ten scans, found " + std::to_string(log.scans.size()));
  const std::vector<Scan> scans = in_order(log);
  const logs::LoggedScan& first = log.scans.front();
  if (first.range_m.size() < 2 || !(first.angle_step_rad > 0))
    throw BadInput(log.file, "expected scans of two beams or more, counter-clockwise, found " +
                                 std::to_string(first.range_m.size()));
  LaserFit fit;
  fit.stride = beam_stride(first.range_m.size());
  fit.beams = (first.range_m.size() + fit.stride - 1) / fit.stride;
  fit.field_of_view_rad =
      std::min(static_cast<double>((fit.beams - 1) * fit.stride) * first.angle_step_rad, 2 * exact::pi);
  fit.range_max_m = first.range_max_m;
  fit.resolution_m = resolution_of(log);
  fit_noise(scans, fit);
  fit_dropout(scans, fit);
  fit_timing(scans, fit);
  return fit;
}

}  // namespace waitpoint::tools
