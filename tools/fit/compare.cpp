// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "modules/sick/segment_extraction.hpp"
#include "tools/command/interruption.hpp"
#include "tools/fit/odometry_fit.hpp"
#include "tools/fit/two_samples.hpp"
#include "tools/output/output_file.hpp"
#include "tools/replay/playback_run.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

constexpr double stretch_m = 2;
constexpr double of_line_m = 0.1;  // echoes farther from a line are of something else

/// The deviation of the echoes between a segment's ends from its line.
double residual_m(const posters::Segment& segment, const std::vector<Point>& echoes) {
  const Point along = segment.end - segment.start;
  const double length_m = length(along);
  double squares = 0;
  std::uint64_t count = 0;
  for (const Point echo : echoes) {
    const double at = dot(echo - segment.start, along) / length_m, off = cross(along, echo - segment.start) / length_m;
    if (at < 0 || at > length_m || std::fabs(off) > of_line_m) continue;
    squares += off * off;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

/// Adds the number, lengths and residuals of the segments of each scan.
void add_segments(const logs::SensorLog& log, Sample& numbers, Sample& lengths, Sample& residuals) {
  const auto echoes = std::make_unique<posters::Echoes>();
  const auto segments = std::make_unique<posters::Segments>();
  const sick::SegmentExtraction extraction({});
  std::vector<Point> points;
  for (const logs::LoggedScan& scan : log.scans) {
    if (scan.range_m.size() > posters::beam_count_max) continue;
    echoes->scan.first_angle_rad = scan.first_angle_rad;
    echoes->scan.angle_step_rad = scan.angle_step_rad;
    echoes->scan.range_max_m = scan.range_max_m;
    echoes->scan.range_m.clear();
    points.clear();
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      echoes->scan.range_m.push_back(scan.range_m[i]);
      if (!(scan.range_m[i] < scan.range_max_m)) continue;
      const auto [s, c] = exact::sincos(scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad);
      points.push_back({scan.range_m[i] * c, scan.range_m[i] * s});
    }
    extraction.extract(*echoes, *segments);
    numbers.values.push_back(static_cast<double>(segments->items.size()));
    for (const posters::Segment& segment : segments->items) {
      lengths.values.push_back(length(segment.end - segment.start));
      residuals.values.push_back(residual_m(segment, points));
    }
  }
}

struct Described {
  double median = 0, deviation = 0;
};

Described described(std::vector<double> values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += exact::square(value - mean) / count;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return {*middle, std::sqrt(squares)};
}

}  // namespace

CompareArguments::CompareArguments(CommandLine& line)
    : command_(line.add_command(
          "compare", "Compares two logs, such as of a real robot and of a simulated one (docs/fidelity.md).")) {
  source_.add(command_);
  command_.argument("OTHER", other_, "the other log, with the same options", Command::Presence::required);
}

CompareOptions CompareArguments::options() const {
  CompareOptions options{source_.options(), source_.options()};
  options.second.log = other_;
  return options;
}

std::vector<Sample> samples_of(const ReplayedLog& log) {
  Sample travel{"odometry's travel error in 2 m, m", {}}, turn{"odometry's heading error in 2 m, rad", {}};
  for (const Stretch& of : stretches_of(log.measured, log.localised, stretch_m)) {
    travel.values.push_back(of.measured_travel_m - of.travel_m);
    turn.values.push_back(of.measured_turn_rad - of.turn_rad);
  }
  Sample times{"time between scans, s", {}};
  std::optional<Time> before;
  for (const logs::Played& record : log.order.records) {
    if (!record.scan) continue;
    if (before) times.values.push_back((record.date - *before).seconds());
    before = record.date;
  }
  Sample numbers{"segments of a scan", {}}, lengths{"length of a segment, m", {}},
      residuals{"deviation of a segment's echoes, m", {}};
  add_segments(log.log, numbers, lengths, residuals);
  return {std::move(travel),  std::move(turn),    std::move(times),
          std::move(numbers), std::move(lengths), std::move(residuals)};
}

std::string comparison_text(const std::vector<Sample>& first, const std::vector<Sample>& second) {
  std::string text = fmt::format("  {:<38}{:>7} {:>9} {:>9}   {:>7} {:>9} {:>9}   {:>6} {:>8}\n", "quantity", "number",
                                 "median", "deviation", "number", "median", "deviation", "D", "p");
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::vector<double>&a = first[i].values, &b = second[i].values;
    if (a.empty() || b.empty()) {
      text += fmt::format("  {:<38}{:>7} {:>27}{:>7}\n", first[i].quantity, a.size(), "", b.size());
      continue;
    }
    const Described of_a = described(a), of_b = described(b);
    const TwoSamples both = compare_samples(a, b);
    text += fmt::format("  {:<38}{:>7} {:>9.4f} {:>9.4f}   {:>7} {:>9.4f} {:>9.4f}   {:>6.3f} {:>8.2g}\n",
                        first[i].quantity, a.size(), of_a.median, of_a.deviation, b.size(), of_b.median, of_b.deviation,
                        both.distance, both.probability);
  }
  return text;
}

int compare(const CompareOptions& options, std::span<const genom::ModuleType> types) {
  heed_signals();
  const RunWatchdog watchdog(RunWatchdog::usual_limit_s);
  const std::optional<ReplayedLog> first = replayed_log(options.first, types);
  if (!first) return interrupted_status;
  const std::optional<ReplayedLog> second = replayed_log(options.second, types);
  if (!second) return interrupted_status;
  write_standard_output(fmt::format("{} and {}\n\n{}", first->log.file, second->log.file,
                                    comparison_text(samples_of(*first), samples_of(*second))));
  return 0;
}

}  // namespace waitpoint::tools
