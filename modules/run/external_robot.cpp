// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/external_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace waitpoint::run {
namespace {

std::string shown(Duration duration) { return fmt::format("{:g} s", duration.seconds()); }

std::string shown(const Pose& pose) { return fmt::format("({:.2f}, {:.2f})", pose.x, pose.y); }

}  // namespace

ExternalRobot::ExternalRobot(world::World& world, world::BodyId body, ExternalSettings settings, Time now, Tell tell)
    : world_(world), body_(body), settings_(std::move(settings)), tell_(std::move(tell)), last_taken_(now) {
  const auto refused = world_.guide_body(body_, std::nullopt, {});
  WAITPOINT_CHECK(!refused, "an external robot in a world that does not guide bodies");
}

void ExternalRobot::take(const PositionReport& report, Time now) {
  const Duration silent = now - last_taken_, lag = now.since_start() - Duration::from_seconds(report.time_s);
  if (is_silent_) tell_(now, "reports again, after " + shown(silent));
  is_silent_ = false;
  note_lag(lag, now);
  const world::Velocity velocity = moves_on() ? velocity_of(report, silent) : world::Velocity();
  Pose pose = report.pose;
  if (moves_on() && lag > Duration())
    pose = world::Arc::of(pose, velocity, std::min(lag, settings_.silent_s).seconds()).end();
  go_to(pose, velocity, now);
  last_ = report;
  last_taken_ = now;
}

// By the report itself, or else by the way since the one before.
world::Velocity ExternalRobot::velocity_of(const PositionReport& report, Duration silent) const {
  if (report.velocity) return *report.velocity;
  const double time_s = last_ ? report.time_s - last_->time_s : 0;
  if (!(time_s > 0) || silent > settings_.silent_s) return {};
  const Point moved = report.pose.position() - last_->pose.position();
  if (length(moved) > settings_.jump_m) return {};
  const world::Arc way = world::Arc::between(last_->pose, moved, report.pose.heading - last_->pose.heading, 0);
  return {way.distance_m / time_s, way.turn_rad / time_s, way.side_m / time_s};
}

void ExternalRobot::note_lag(Duration lag, Time now) {
  ++figures_.reports;
  lags_.push_back(lag);
  const bool late = lag > settings_.late_s;
  if (late) ++figures_.late;
  if (late != is_late_)
    tell_(now, late ? "reports are late: by " + shown(lag) + ", more than " + shown(settings_.late_s)
                    : "reports are in time again: after " + shown(lag));
  is_late_ = late;
}

void ExternalRobot::go_to(const Pose& pose, const world::Velocity& velocity, Time now) {
  const Pose body_pose = world_.body(body_).pose;
  if (length(pose.position() - body_pose.position()) > settings_.jump_m) return jump_to(pose, velocity, now);
  is_refused_ = false;
  world_.guide_body(body_, pose, velocity);
}

void ExternalRobot::jump_to(const Pose& pose, const world::Velocity& velocity, Time now) {
  const double distance_m = length(pose.position() - world_.body(body_).pose.position());
  const std::optional<std::string> in_the_way = world_.move_body(body_, pose);
  world_.guide_body(body_, std::nullopt, in_the_way ? world::Velocity() : velocity);
  if (in_the_way) {
    ++figures_.refused;
    if (!is_refused_)
      tell_(now, fmt::format("stays at {}: '{}' is in the way at the reported place {}", shown(world_.body(body_).pose),
                             *in_the_way, shown(pose)));
  } else {
    ++figures_.jumps;
    tell_(now, fmt::format("jump of {:.2f} m to {}", distance_m, shown(pose)));
  }
  is_refused_ = in_the_way.has_value();
}

void ExternalRobot::before_step(Time now) {
  const world::BodyState& body = world_.body(body_);
  if (body.stalled != is_held_)
    tell_(now, (body.stalled ? "stopped by a contact at " : "free again at ") + shown(body.pose));
  is_held_ = body.stalled;
  if (is_silent_ || now - last_taken_ <= settings_.silent_s) return;
  is_silent_ = true;
  ++figures_.silences;
  world_.guide_body(body_, std::nullopt, {});
  tell_(now, (last_ ? "no report for " : "no report yet for ") + shown(settings_.silent_s) + ": it stays at " +
                 shown(body.pose));
}

bridge::ExternalFigures ExternalRobot::figures() const {
  bridge::ExternalFigures figures = figures_;
  if (lags_.empty()) return figures;
  std::vector<Duration> lags = lags_;
  std::sort(lags.begin(), lags.end());
  figures.lag = bridge::ReportLag{lags.front(), lags[(lags.size() - 1) / 2], lags.back()};
  return figures;
}

}  // namespace waitpoint::run
