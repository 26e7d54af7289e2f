// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/scan_samples.hpp"

#include <cmath>
#include <memory>

#include "modules/matching/refinement.hpp"
#include "modules/sick/segment_extraction.hpp"
#include "tools/fit/log_scan.hpp"

namespace waitpoint::tools {
namespace {

constexpr double of_line_m = 0.1;  // echoes farther from a line are of something else
constexpr double apart = 0.1;      // metres, or radians, between scans that are matched
constexpr unsigned pairs_least = 20;

double deviation_m(const posters::Segment& segment, const std::vector<Point>& echoes) {
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

/// The echoes in the laser's frame.
void points_of(const posters::LaserReading& scan, std::vector<Point>& points) {
  points.clear();
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (!(static_cast<double>(scan.range_m[i]) < scan.range_max_m)) continue;
    const auto [s, c] = exact::sincos(scan.first_angle_rad + static_cast<double>(i) * scan.angle_step_rad);
    points.push_back({static_cast<double>(scan.range_m[i]) * c, static_cast<double>(scan.range_m[i]) * s});
  }
}

bool is_apart(const Pose& a, const Pose& b) {
  const Pose step = between(a, b);
  return length(step.position()) >= apart || std::fabs(step.heading) >= apart;
}

}  // namespace

SegmentSamples segments_of(const logs::SensorLog& log) {
  const auto echoes = std::make_unique<posters::Echoes>();
  const auto segments = std::make_unique<posters::Segments>();
  const sick::SegmentExtraction extraction({});
  std::vector<Point> points;
  SegmentSamples samples;
  for (const logs::LoggedScan& scan : log.scans) {
    take_scan(scan, {}, *echoes);
    points_of(echoes->scan, points);
    extraction.extract(*echoes, *segments);
    samples.numbers.push_back(static_cast<double>(segments->items.size()));
    for (const posters::Segment& segment : segments->items) {
      samples.lengths_m.push_back(length(segment.end - segment.start));
      samples.deviations_m.push_back(deviation_m(segment, points));
    }
  }
  return samples;
}

MatchSamples matches_of(const ReplayedLog& log) {
  constexpr double cell_m = 0.05, reach_m = 0.3, score_deviation_m = 0.1;
  const auto echoes = std::make_unique<posters::Echoes>();
  std::vector<matching::SurfacePoint> before, points;
  Pose pose_before;
  MatchSamples samples;
  for (std::size_t i = 0; i < log.localised.size(); ++i) {
    if (!before.empty() && !is_apart(pose_before, log.localised[i])) continue;
    take_scan(log.log.scans[log.scans[i]], log.log.mount, *echoes);
    matching::surface_of(*echoes, {}, points);
    if (!before.empty() && !points.empty()) {
      matching::SurfaceMap map(cell_m, reach_m, score_deviation_m);
      map.add({}, before);
      const matching::Refined match = matching::refine(map, points, between(pose_before, log.localised[i]), {}, {});
      if (match.pairs >= pairs_least) {
        samples.deviations_m.push_back(match.deviation_m);
        samples.explained.push_back(match.explained);
      }
    }
    before.swap(points);
    pose_before = log.localised[i];
  }
  return samples;
}

}  // namespace waitpoint::tools
