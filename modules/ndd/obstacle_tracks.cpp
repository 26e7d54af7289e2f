// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/obstacle_tracks.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::ndd {
namespace {

constexpr double gap_m = 0.25, range_m_max = 8;
constexpr double radius_m_max = 0.6;
constexpr std::size_t beams_min = 3;
constexpr double gate_m = 0.3;
constexpr double alpha = 0.5, beta = 0.17;  // nearly critically damped
constexpr std::uint32_t sightings_min = 5;
constexpr double moving_m_s = 0.15;
constexpr double kept_s = 1, kept_if_new_s = 0.2;

}  // namespace

void ObstacleTracks::see(const Pose& device, const posters::LaserReading& scan) {
  find_discs(device, scan);
  continue_tracks(scan.date);
  moving_.clear();
  for (const Track& track : tracks_)
    if (track.sightings >= sightings_min && length(track.velocity) > moving_m_s) moving_.push_back(track);
}

void ObstacleTracks::find_discs(const Pose& device, const posters::LaserReading& scan) {
  discs_.clear();
  const double range_max_m = std::min(range_m_max, scan.range_max_m);
  const auto range_m = [&](std::size_t i) { return static_cast<double>(scan.range_m[i]); };
  const std::size_t count = scan.range_m.size();
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    end = first + 1;
    if (range_m(first) >= range_max_m) continue;
    double sum_m = range_m(first), least_m = sum_m;
    for (; end < count && std::fabs(range_m(end) - range_m(end - 1)) <= gap_m; ++end) {
      sum_m += range_m(end);
      least_m = std::min(least_m, range_m(end));
    }
    const bool is_hidden_in_part =
        first == 0 || end == count || range_m(first - 1) < range_m(first) || range_m(end) < range_m(end - 1);
    const std::size_t beams = end - first;
    if (is_hidden_in_part || beams < beams_min) continue;
    const double half_angle = 0.5 * static_cast<double>(beams) * scan.angle_step_rad;
    if (half_angle >= 0.5) continue;
    // Of a disc's middle beams, since a least range is the lower the more beams there are.
    double near_m = 0;
    const std::size_t middle = beams - 2 * (beams / 3);
    for (std::size_t i = 0; i < middle; ++i) near_m += range_m(first + beams / 3 + i) / static_cast<double>(middle);
    const exact::SinCos half = exact::sincos(half_angle);
    const double centre_m = near_m / (1 - half.sin), radius_m = centre_m - near_m;
    if (radius_m > radius_m_max) continue;
    const double bearing = scan.first_angle_rad + 0.5 * static_cast<double>(first + end - 1) * scan.angle_step_rad;
    const auto [s, c] = exact::sincos(bearing);
    discs_.push_back({transform(device, {centre_m * c, centre_m * s}), radius_m, false});
  }
}

void ObstacleTracks::continue_tracks(Time date) {
  std::erase_if(tracks_, [&](const Track& track) {
    return (date - track.seen).seconds() > (track.sightings < sightings_min ? kept_if_new_s : kept_s);
  });
  for (Track& track : tracks_) {
    const Point expected = track.at(date);
    Disc* nearest = nullptr;
    double least_m = gate_m;
    for (Disc& disc : discs_) {
      const double distance_m = length(disc.centre - expected);
      if (disc.taken || distance_m >= least_m) continue;
      least_m = distance_m;
      nearest = &disc;
    }
    if (nearest == nullptr) continue;
    nearest->taken = true;
    const Point off = nearest->centre - expected;
    const double since_s = (date - track.seen).seconds();
    track.centre = expected + alpha * off;
    track.velocity = track.velocity + (beta / since_s) * off;
    track.radius_m += alpha * (nearest->radius_m - track.radius_m);
    track.seen = date;
    ++track.sightings;
  }
  for (const Disc& disc : discs_)
    if (!disc.taken) tracks_.push_back({disc.centre, {}, disc.radius_m, date, 1});
}

}  // namespace waitpoint::ndd
