// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/segloc.hpp"

#include <cmath>

namespace waitpoint::segloc {

using genom::Nothing;
using genom::State;
using namespace std::chrono_literals;

namespace {
// Readers of the map poll it rarely; exporting so large a poster with every scan would be too often.
constexpr std::uint32_t scans_per_map = 20;
// The change to points: below this share of scans held by segments, as a running mean over so many.
constexpr double held_min = 0.4, held_scans = 20;
constexpr std::size_t early_max = 64;
}  // namespace

Parameters Segloc::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters);
  return parameters;
}

Segloc::Segloc(genom::ModuleSetup& setup)
    : Module(setup, 23),
      parameters_(read(setup.settings)),
      point_parameters_(read_point_parameters(setup.settings)),
      slam_(add_task("slam", {.period_ms = 20ms, .delay_ms = {}, .cost_us = {}})),
      segments_(read_poster<posters::Segments>("sick.segments")),
      odometry_(read_poster<posters::Odometry>("rflex.odometry")),
      echoes_(read_poster<posters::Echoes>("sick.echoes", false)),
      localisation_(add_poster<posters::Localisation>("localisation", slam_)),
      map_poster_(add_poster<posters::SegmentMap>("map", slam_)) {
  auto& localise = add_activity<posters::KnownPose>("Localise", slam_,
                                                    {.start =
                                                         [this](auto& activity) {
                                                           start(activity.input);
                                                           return State::exec;
                                                         },
                                                     .exec =
                                                         [this](auto&) {
                                                           this->localise();
                                                           return State::exec;
                                                         }},
                                                    {"Localise"});
  localise.cost = 1ms;
  setup.settings.read_described("localise_cost_us", localise.cost, "cost of a codel of the request Localise");
  add_control<Nothing>("Stop", [](const Nothing&, Nothing&) { return genom::ok; }, {"Localise"});
}

void Segloc::start(const posters::KnownPose& input) {
  PoseEstimate pose;
  pose.pose = input.pose;
  pose.covariance[0] = pose.covariance[4] = input.position_deviation_m * input.position_deviation_m;
  pose.covariance[8] = input.heading_deviation_rad * input.heading_deviation_rad;
  filter_.emplace(parameters_, pose);
  odometry_at_filter_.reset();
  points_.reset();
  early_.clear();
  held_ = 1;
  if (point_parameters_.from_start) change_to_points(false);
}

void Segloc::localise() {
  posters::Odometry odometry;
  if (odometry_.read(odometry) == genom::PosterStatus::empty) return;
  trail_.add(odometry.position.date, odometry.position.pose);
  if (!odometry_at_filter_) odometry_at_filter_ = odometry.position.pose;
  if (segments_.read(scan_) == genom::PosterStatus::empty || scan_.number == number_) return;
  // A scan is used once the odometry has passed its date.
  if (scan_.date > odometry.position.date) return;
  number_ = scan_.number;

  if (points_ != nullptr && scan_of_points_->scan.number != scan_.number &&
      (echoes_.read(*scan_of_points_) != genom::PosterStatus::ok || scan_of_points_->scan.number != scan_.number)) {
    return;  // its echoes are gone already
  }
  const Pose then = trail_.at(scan_.date);
  if (points_ == nullptr)
    use_segments(then);
  else
    use_points(then);
  odometry_at_filter_ = then;
}

void Segloc::use_segments(const Pose& then) {
  filter_->predict({between(*odometry_at_filter_, then), {}});
  const Observed observed = filter_->observe(scan_);
  const PoseEstimate estimate = filter_->position();
  localisation_.write({{scan_.date, estimate.pose, estimate.covariance}, observed.matched, observed.segments});
  if (scans_++ % scans_per_map == 0) export_map();
  if (early_.size() < early_max) early_.push_back({scan_.date, estimate.pose});
  if (filter_->astray())
    change_to_points(true);
  else if (!held_by_segments(observed))
    change_to_points(false);
}

// Two matched segments hold the pose, if they are not parallel, which most are not.
bool Segloc::held_by_segments(const Observed& observed) {
  held_ += ((observed.matched >= 2 ? 1.0 : 0.0) - held_) / held_scans;
  return held_ >= held_min;
}

void Segloc::change_to_points(bool lost) {
  if (!echoes_.connected()) return;
  std::vector<matching::SurfacePoint> known;
  for (const Landmark& landmark : filter_->landmarks()) {
    const Line& line = landmark.line;
    for (const auto& s : landmark.seen.stretches()) {
      for (double place = s.low_m; place <= s.high_m; place += point_parameters_.cell_m)
        known.push_back({line.at(place), {-line.normal.x, -line.normal.y}});
    }
  }
  points_ = std::make_unique<PointMap>(point_parameters_, filter_->position().pose, std::move(known), lost);
  scan_of_points_ = std::make_unique<posters::Echoes>();
  filter_.reset();
}

void Segloc::use_points(const Pose& then) {
  matching::SurfaceParameters surface;
  surface.range_m_max = point_parameters_.range_m_max;
  matching::surface_of(*scan_of_points_, surface, surface_);
  points_->observe(scan_.date, between(*odometry_at_filter_, then), surface_);
  posters::Localisation result;
  result.position = {scan_.date, points_->pose(), points_->covariance()};
  result.observed = static_cast<std::uint32_t>(surface_.size());
  result.matched = static_cast<std::uint32_t>(std::lround(points_->explained() * static_cast<double>(surface_.size())));
  result.lost = points_->lost();
  result.jumps = points_->jumps();
  localisation_.write(result);
  if (scans_++ % scans_per_map == 0) export_points();
}

std::vector<posters::StampedPose> Segloc::corrected() const {
  if (points_ == nullptr) return {};
  std::vector<posters::StampedPose> poses = early_;
  const std::vector<posters::StampedPose> later = points_->corrected();
  poses.insert(poses.end(), later.begin(), later.end());
  return poses;
}

// The segments of the present scan, at the pose that it has on the map of points.
void Segloc::export_points() {
  map_.date = scan_.date;
  map_.items.clear();
  const Pose here = points_->pose();
  for (const posters::Segment& segment : scan_.items)
    map_.items.push_back({transform(here, segment.start), transform(here, segment.end)});
  map_poster_.write(map_);
}

void Segloc::export_map() {
  map_.date = scan_.date;
  filter_->export_map(map_);
  map_poster_.write(map_);
}

}  // namespace waitpoint::segloc
