// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/locate.hpp"

namespace waitpoint::locate {

using genom::Nothing;
using genom::State;
using namespace std::chrono_literals;

namespace {

void check(const genom::Settings& settings, const Parameters& p) {
  const auto within = [&](const char* key, double value, double least, double most) {
    settings.check_least(key, value, least);
    settings.check_most(key, value, most);
  };
  const auto& [tracking, finding] = p;
  within("tracking.independent_share", tracking.independent_share, 0.001, 1);
  within("tracking.position_floor_m", tracking.position_floor_m, 1e-4, 10);
  within("tracking.heading_floor_rad", tracking.heading_floor_rad, 1e-4, 1);
  within("tracking.explained_min", tracking.explained_min, 0.01, 1);
  within("tracking.lost_scans", tracking.lost_scans, 1, 1e6);
  within("tracking.rest_scans", tracking.rest_scans, 1, 1e6);
  within("finding.view_turn_rad", finding.view_turn_rad, 0.01, 100);
  within("finding.view_travel_m", finding.view_travel_m, 0.01, 1000);
  within("finding.views_min", finding.views_min, 1, 1000);
  within("finding.views_max", finding.views_max, 1, 1000);
  within("finding.score_min", finding.score_min, 0.01, 1);
  within("finding.rival_share", finding.rival_share, 0.01, 1);
  within("finding.explained_min", finding.explained_min, 0.01, 1);
  if (finding.views_min > finding.views_max) {
    // At the one that is given: the defaults are in order.
    if (settings.has("finding.views_min"))
      settings.check_most("finding.views_min", finding.views_min, finding.views_max);
    settings.check_least("finding.views_max", finding.views_max, finding.views_min);
  }
}

}  // namespace

Parameters read_parameters(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters);
  check(settings, parameters);
  return parameters;
}

Locate::Locate(genom::ModuleSetup& setup)
    : Module(setup, 27),
      parameters_(read_parameters(setup.settings)),
      map_(setup.known_map),
      locating_(add_task("locating", {.period_ms = 20ms, .delay_ms = {}, .cost_us = {}})),
      echoes_(read_poster<posters::Echoes>("sick.echoes")),
      odometry_(read_poster<posters::Odometry>("rflex.odometry")),
      localisation_poster_(add_poster<posters::Localisation>("localisation", locating_)),
      search_cost_us_(200ms) {
  if (map_ == nullptr) throw BadInput("locate", "expected a known map");
  setup.settings.read_described("search_cost_us", search_cost_us_, "cost of a search on the whole map");
  const auto run = [this](auto&) {
    locate();
    return State::exec;
  };
  auto& localise = add_activity<posters::KnownPose>("Localise", locating_,
                                                    {.start =
                                                         [this](auto& activity) {
                                                           start(activity.input);
                                                           return State::exec;
                                                         },
                                                     .exec = run},
                                                    {"Localise", "Find"});
  auto& find = add_activity<Nothing>("Find", locating_,
                                     {.start =
                                          [this](auto&) {
                                            start(std::nullopt);
                                            return State::exec;
                                          },
                                      .exec = run},
                                     {"Localise", "Find"});
  localise.cost = find.cost = 1ms;
  setup.settings.read_described("localise_cost_us", localise.cost, "cost of a codel of the request Localise");
  setup.settings.read_described("find_cost_us", find.cost, "cost of a codel of the request Find");
  add_control<Nothing>("Stop", [](const Nothing&, Nothing&) { return genom::ok; }, {"Localise", "Find"});
}

void Locate::start(const std::optional<posters::KnownPose>& known) {
  if (surfaces_ == nullptr) surfaces_ = std::make_unique<const MapSurfaces>(*map_);
  tracker_.reset();
  finder_.reset();
  odometry_at_tracker_.reset();
  if (!known) return;
  posters::UncertainPose pose = {known->pose, {}};
  pose.covariance[0] = pose.covariance[4] = exact::square(known->position_deviation_m);
  pose.covariance[8] = exact::square(known->heading_deviation_rad);
  tracker_.emplace(surfaces_->fine, parameters_.tracking, pose);
}

void Locate::locate() {
  posters::Odometry odometry;
  if (odometry_.read(odometry) == genom::PosterStatus::empty) return;
  trail_.add(odometry.position.date, odometry.position.pose);
  if (!odometry_at_tracker_) odometry_at_tracker_ = odometry.position.pose;
  if (echoes_.read(scan_) == genom::PosterStatus::empty || scan_.scan.number == number_) return;
  // A scan is used once the odometry has passed its date.
  if (scan_.scan.date > odometry.position.date) return;
  number_ = scan_.scan.number;
  matching::surface_of(scan_, {}, points_);
  const Pose then = trail_.at(scan_.scan.date);
  localisation_.position.date = scan_.scan.date;
  localisation_.observed = static_cast<std::uint32_t>(points_.size());
  if (tracker_) {
    track(then);
  } else {
    find(then);
  }
  localisation_poster_.write(localisation_);
}

void Locate::track(const Pose& odometry) {
  tracker_->predict(between(*odometry_at_tracker_, odometry));
  odometry_at_tracker_ = odometry;
  tracker_->update(points_);
  localisation_.position.pose = tracker_->estimate().pose;
  localisation_.position.covariance = tracker_->estimate().covariance;
  localisation_.matched = static_cast<std::uint32_t>(tracker_->explained() * static_cast<double>(points_.size()));
  localisation_.lost = tracker_->lost();
  if (localisation_.lost) tracker_.reset();
}

void Locate::find(const Pose& odometry) {
  localisation_.lost = true;
  localisation_.matched = 0;
  if (!finder_) finder_.emplace(*surfaces_, parameters_.finding);
  const Finding finding = finder_->look(odometry, points_);
  if (finding != Finding::unchanged && finding != Finding::too_little) threads::compute(search_cost_us_);
  if (finding != Finding::found) return;
  posters::UncertainPose pose = {finder_->pose(), {}};
  pose.covariance[0] = pose.covariance[4] = exact::square(0.05);
  pose.covariance[8] = exact::square(0.02);
  tracker_.emplace(surfaces_->fine, parameters_.tracking, pose);
  finder_.reset();
  odometry_at_tracker_ = odometry;
  localisation_.lost = false;
  ++localisation_.jumps;
  localisation_.position.pose = pose.pose;
  localisation_.position.covariance = pose.covariance;
}

}  // namespace waitpoint::locate
