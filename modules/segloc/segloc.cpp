// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/segloc.hpp"

namespace waitpoint::segloc {

using genom::Nothing;
using genom::State;
using namespace std::chrono_literals;

namespace {
// Readers of the map poll it rarely; exporting so large a poster with every scan would be too often.
constexpr std::uint32_t scans_per_map = 20;
}  // namespace

Parameters Segloc::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters);
  check(parameters);
  return parameters;
}

Segloc::Segloc(genom::ModuleSetup& setup)
    : Module(setup, 23),
      parameters_(read(setup.settings)),
      slam_(add_task("slam", {.period_ms = 20ms, .delay_ms = {}, .cost_us = {}})),
      segments_(read_poster<posters::Segments>("sick.segments")),
      odometry_(read_poster<posters::Odometry>("rflex.odometry")),
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
  setup.settings.read_one("localise_cost_us", localise.cost);
  add_control<Nothing>("Stop", [](const Nothing&, Nothing&) { return genom::ok; }, {"Localise"});
}

void Segloc::start(const posters::KnownPose& input) {
  PoseEstimate pose;
  pose.pose = input.pose;
  pose.covariance[0] = pose.covariance[4] = input.position_deviation_m * input.position_deviation_m;
  pose.covariance[8] = input.heading_deviation_rad * input.heading_deviation_rad;
  filter_.emplace(parameters_, pose);
  odometry_at_filter_.reset();
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

  const Pose then = trail_.at(scan_.date);
  filter_->predict({between(*odometry_at_filter_, then), {}});
  odometry_at_filter_ = then;
  const Observed observed = filter_->observe(scan_);
  const PoseEstimate estimate = filter_->position();
  localisation_.write({{scan_.date, estimate.pose, estimate.covariance}, observed.matched, observed.segments});
  if (scans_++ % scans_per_map == 0) export_map();
}

void Segloc::export_map() {
  map_.date = scan_.date;
  filter_->export_map(map_);
  map_poster_.write(map_);
}

}  // namespace waitpoint::segloc
