// SPDX-License-Identifier: BSD-3-Clause
#include "modules/sick/extraction.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/exact_math.hpp"

namespace waitpoint::sick {
namespace {

double length_m(const posters::Segment& segment) { return length(segment.end - segment.start); }

// From the device's frame to the robot's. The angle's error rotates the line about the device, not about the robot.
void move_to_robot(const Pose& mount, posters::Segment& segment) {
  segment.start = transform(mount, segment.start);
  segment.end = transform(mount, segment.end);
  segment.normal_rad += mount.heading;
  const auto [sine, cosine] = exact::sincos(segment.normal_rad);
  segment.distance_m += cosine * mount.x + sine * mount.y;
  const double lever_m = cosine * mount.y - sine * mount.x;
  auto& [angle, mixed, distance] = segment.covariance;
  distance += lever_m * (2.0 * mixed + lever_m * angle);
  mixed += lever_m * angle;
  if (segment.distance_m < 0) {
    segment.distance_m = -segment.distance_m;
    segment.normal_rad += exact::pi;
    mixed = -mixed;
  }
  segment.normal_rad = exact::wrap_angle(segment.normal_rad);
}

// Keeps the longest segments if there are too many.
void keep(const posters::Segment& segment, posters::Segments& segments) {
  if (!segments.items.full()) return segments.items.push_back(segment);
  std::size_t shortest = 0;
  for (std::size_t i = 1; i < segments.items.size(); ++i) {
    if (length_m(segments.items[i]) < length_m(segments.items[shortest])) shortest = i;
  }
  if (length_m(segments.items[shortest]) < length_m(segment)) segments.items[shortest] = segment;
}

void sort_longest_first(posters::Segments& segments) {
  std::sort(segments.items.begin(), segments.items.end(), [](const posters::Segment& a, const posters::Segment& b) {
    const double la = length_m(a), lb = length_m(b);
    if (la != lb) return la > lb;
    if (a.normal_rad != b.normal_rad) return a.normal_rad < b.normal_rad;
    return a.start.x != b.start.x ? a.start.x < b.start.x : a.start.y < b.start.y;
  });
}

}  // namespace

void SegmentExtraction::extract(const posters::Echoes& echoes, posters::Segments& segments) const {
  thread_local const auto extraction = std::make_unique<Extraction>();
  extraction->extract(parameters_, echoes, segments);
}

void Extraction::extract(const SegmentExtractionParameters& parameters, const posters::Echoes& echoes,
                         posters::Segments& segments) {
  parameters_ = parameters;
  segments.date = echoes.scan.date;
  segments.number = echoes.scan.number;
  segments.items.clear();
  prepare_beams(echoes.scan);
  take_echoes(echoes.scan);
  runs_ = 0;
  for (std::uint32_t first = 0, i = 0; i < echoes_; ++i) {
    if (i + 1 < echoes_ && !breaks_after(i)) continue;
    split({first, i});
    first = i + 1;
  }
  merge();
  std::uint32_t found = 0;
  for (std::uint32_t i = 0; i < runs_; ++i) {
    posters::Segment segment;
    if (!finish(run_[i], segment)) continue;
    move_to_robot(echoes.mount, segment);
    keep(segment, segments);
    ++found;
  }
  if (found > segments.items.size()) sort_longest_first(segments);
}

void Extraction::prepare_beams(const posters::LaserReading& scan) {
  const auto beams = static_cast<std::uint32_t>(scan.range_m.size());
  if (beams == beams_ && scan.first_angle_rad == first_angle_rad_ && scan.angle_step_rad == angle_step_rad_) return;
  beams_ = beams;
  first_angle_rad_ = scan.first_angle_rad;
  angle_step_rad_ = scan.angle_step_rad;
  for (std::uint32_t i = 0; i < beams; ++i) {
    const auto [sine, cosine] = exact::sincos(first_angle_rad_ + i * angle_step_rad_);
    direction_[i] = {cosine, sine};
  }
}

void Extraction::take_echoes(const posters::LaserReading& scan) {
  const double quantisation = exact::square(parameters_.range_resolution_m) / 12.0;
  // A range rounded to the device's resolution may be half a step below the maximum.
  const double range_m_max = scan.range_max_m - 0.5 * parameters_.range_resolution_m;
  echoes_ = 0;
  for (std::uint32_t beam = 0; beam < beams_; ++beam) {
    const double range = scan.range_m[beam];
    if (!(range >= parameters_.range_min_m && range < range_m_max)) continue;
    const Point p = range * direction_[beam];
    const double beyond = range - parameters_.range_noise_near_m;
    const double noise =
        parameters_.range_noise_m + (beyond > 0 ? beyond * parameters_.range_noise_growth_m_per_m : 0.0);
    const std::uint32_t i = echoes_++;
    beam_[i] = beam;
    range_m_[i] = range;
    point_[i] = p;
    range_variance_[i] = noise * noise + quantisation;
    per_square_range_[i] = 1.0 / (range * range);
    const Moments& s = sum_[i];
    sum_[i + 1] = {s.x + p.x, s.y + p.y, s.xx + p.x * p.x, s.xy + p.x * p.y, s.yy + p.y * p.y};
  }
}

// On a wall met at the grazing angle g, the next beam at angle a is longer by r sin(a) / sin(g - a).
bool Extraction::breaks_after(std::uint32_t i) const {
  const double angle = (beam_[i + 1] - beam_[i]) * angle_step_rad_;
  if (beam_[i + 1] - beam_[i] > 1 && angle > parameters_.beam_gap_rad_max) return true;
  const double rest = parameters_.grazing_angle_rad - angle;
  if (rest <= 0) return true;
  const double nearer = std::min(range_m_[i], range_m_[i + 1]);
  return std::fabs(range_m_[i + 1] - range_m_[i]) > parameters_.jump_m_min + nearer * angle / rest;
}

// The variance of echo i across a line; `projection_m` is the length of the line's normal projected on the echo's ray.
double Extraction::variance_across(std::uint32_t i, double projection_m) const {
  const double along = projection_m * projection_m;
  const double square_range = range_m_[i] * range_m_[i];
  const double bearing = parameters_.bearing_noise_rad * parameters_.bearing_noise_rad;
  return range_variance_[i] * along * per_square_range_[i] + bearing * (square_range - along) +
         parameters_.roughness_m * parameters_.roughness_m;
}

// Splits at the farthest echo until the runs are straight; the first run first, so that runs_ stays counter-clockwise.
void Extraction::split(Run region) {
  std::uint32_t waiting = 0;
  stack_[waiting++] = region;
  while (waiting > 0) {
    const Run run = stack_[--waiting];
    if (run.points() < parameters_.points_min) continue;
    const Point a = point_[run.first], chord = point_[run.last] - a;
    const double chord_m = length(chord);
    if (chord_m < 1e-6) continue;
    const Point normal{-chord.y / chord_m, chord.x / chord_m};
    const double distance = dot(normal, a);
    double worst = parameters_.chi2_split;
    std::uint32_t at = run.first;
    for (std::uint32_t i = run.first + 1; i < run.last; ++i) {
      const double projection = dot(normal, point_[i]);
      const double squared = exact::square(projection - distance);
      const double bound = worst * variance_across(i, projection);
      if (squared <= bound) continue;
      worst = worst * squared / bound;
      at = i;
    }
    if (at == run.first) {
      run_[runs_++] = run;
    } else {
      // The echo at the corner belongs to both runs.
      stack_[waiting++] = {at, run.last};
      stack_[waiting++] = {run.first, at};
    }
  }
}

void Extraction::merge() {
  if (runs_ == 0) return;
  std::uint32_t last = 0;
  for (std::uint32_t i = 1; i < runs_; ++i) {
    const Run both{run_[last].first, run_[i].last};
    const double gap_m = length(point_[run_[i].first] - point_[run_[last].last]);
    if (gap_m <= parameters_.merge_gap_m_max && straight(both)) {
      run_[last] = both;
    } else {
      run_[++last] = run_[i];
    }
  }
  runs_ = last + 1;
}

bool Extraction::straight(Run run) const {
  const Line line = fit(run);
  for (std::uint32_t i = run.first; i <= run.last; ++i) {
    const double projection = dot(line.normal, point_[i]);
    if (exact::square(projection - line.distance_m) > parameters_.chi2_split * variance_across(i, projection))
      return false;
  }
  return true;
}

Extraction::Line Extraction::fit(Run run) const {
  const Moments &a = sum_[run.first], &b = sum_[run.last + 1];
  const double n = run.points();
  const Point centre{(b.x - a.x) / n, (b.y - a.y) / n};
  const double sxx = (b.xx - a.xx) - n * centre.x * centre.x;
  const double syy = (b.yy - a.yy) - n * centre.y * centre.y;
  const double sxy = (b.xy - a.xy) - n * centre.x * centre.y;
  // The normal is the direction of least scatter, at half the angle of (syy - sxx, -2 sxy).
  const double difference = syy - sxx, twice = -2.0 * sxy, size = exact::hypot(difference, twice);
  Point normal{1, 0};
  if (size > 0) {
    if (difference >= 0) {
      const double cosine = std::sqrt(0.5 * (1.0 + difference / size));
      normal = {cosine, twice / size / (2.0 * cosine)};
    } else {
      const double sine = std::sqrt(0.5 * (1.0 - difference / size));
      normal = {twice / size / (2.0 * sine), sine};
    }
  }
  double distance = dot(normal, centre);
  if (distance < 0) {
    distance = -distance;
    normal = {-normal.x, -normal.y};
  }
  return {centre, normal, distance};
}

// The line's angle and its offset at the centre are linear in the echoes' errors across the line: slope and mean of a
// straight-line regression over t, the coordinate along the line. Their covariance is then moved to the line's foot.
bool Extraction::finish(Run run, posters::Segment& segment) const {
  if (run.points() < parameters_.points_min) return false;
  const Line line = fit(run);
  const Point along{-line.normal.y, line.normal.x};
  const double n = run.points();
  double t2 = 0, t3 = 0, error2 = 0, v0 = 0, v1 = 0, v2 = 0, bias0 = 0, bias1 = 0;
  for (std::uint32_t i = run.first; i <= run.last; ++i) {
    const double t = dot(along, point_[i] - line.centre);
    const double projection = dot(line.normal, point_[i]);
    const double variance = variance_across(i, projection) - exact::square(parameters_.roughness_m);
    const double slant = projection / range_m_[i];
    t2 += t * t;
    t3 += t * t * t;
    error2 += exact::square(projection - line.distance_m) / variance;
    v0 += variance;
    v1 += t * variance;
    v2 += t * t * variance;
    bias0 += slant;
    bias1 += t * slant;
  }
  const double from = dot(along, point_[run.first] - line.centre), to = dot(along, point_[run.last] - line.centre);
  if (to - from < parameters_.length_m_min) return false;

  // The bow: a parabola in t without its mean and slope.
  double fit2 = 0, bow = 0;
  for (std::uint32_t i = run.first; i <= run.last; ++i) {
    const double t = dot(along, point_[i] - line.centre);
    const double q = t * t - t * t3 / t2 - t2 / n;
    fit2 += q * q;
    bow += q * (dot(line.normal, point_[i]) - line.distance_m);
  }
  if (std::fabs(bow) * exact::square(0.5 * (to - from)) > parameters_.bow_m_max * fit2) return false;

  const double scale = std::max(1.0, error2 / (n - 2.0));
  const double bias = exact::square(parameters_.range_bias_m);
  const double mean = bias0 / n, slope = bias1 / t2;
  const double angle = scale * v2 / (t2 * t2) + bias * slope * slope;
  const double mixed = scale * v1 / (n * t2) + bias * mean * slope;
  const double offset = scale * v0 / (n * n) + bias * mean * mean;
  // A rotation by d moves the foot's distance by lever d, with the lever the centre's coordinate along the line; a
  // counter-clockwise rotation of the line tilts the regression line by -d.
  const double lever = dot(along, line.centre);
  segment.covariance = {angle, lever * angle - mixed, offset - 2.0 * lever * mixed + lever * lever * angle};
  segment.start = line.centre + from * along;
  segment.end = line.centre + to * along;
  segment.normal_rad = exact::atan2(line.normal.y, line.normal.x);
  segment.distance_m = line.distance_m;
  segment.points = run.points();
  return true;
}

}  // namespace waitpoint::sick
