// SPDX-License-Identifier: BSD-3-Clause
// A robot outside of the simulation, such as a real one: reports of its position move a body of the world.
//
//   at a step of the world with a report:  to the reported pose, along an arc that ends at contacts; farther than
//                                          jump_m: lifted and put down there, unless something is in the way
//   at the others, between=move:           on at the report's velocity, for silent_s at most; a report without one has
//                                          that from the report before it
//                  between=stay:           nowhere
//
// A report is about its date, which is before the virtual time at which it is taken in: the difference is its lag. With
// between=move the reported pose is moved on by it. All of this is in virtual time, and repeats.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/run/position_report.hpp"
#include "world/world.hpp"

namespace waitpoint::run {

struct ExternalSettings {
  std::string between = "move";  ///< or "stay"
  double jump_m = 0.5;
  Duration silent_s = std::chrono::seconds(1);       ///< without a report, it is told, and the body stays
  Duration late_s = std::chrono::milliseconds(200);  ///< lag from which a report is late

  static void fields(auto field) {
    field("between", &ExternalSettings::between);
    field("jump_m", &ExternalSettings::jump_m);
    field("silent_s", &ExternalSettings::silent_s);
    field("late_s", &ExternalSettings::late_s);
  }
};

class ExternalRobot {
 public:
  /// Receives notices for a person, once each time that a condition begins or ends.
  using Tell = std::function<void(Time now, const std::string& text)>;

  /// From now on the body is moved by reports alone. The world must outlive it.
  ExternalRobot(world::World& world, world::BodyId body, ExternalSettings settings, Time now, Tell tell);

  /// Between two steps of the world, at most once: takes a report, whose time is its date.
  void take(const PositionReport& report, Time now);
  /// Between two steps, after the report if there is one.
  void before_step(Time now);

  bridge::ExternalFigures figures() const;

 private:
  bool moves_on() const { return settings_.between == "move"; }
  world::Velocity velocity_of(const PositionReport& report, Duration silent) const;
  void note_lag(Duration lag, Time now);
  void go_to(const Pose& pose, const world::Velocity& velocity, Time now);
  void jump_to(const Pose& pose, const world::Velocity& velocity, Time now);

  world::World& world_;
  world::BodyId body_;
  ExternalSettings settings_;
  Tell tell_;
  Time last_taken_;
  std::optional<PositionReport> last_;
  std::vector<Duration> lags_;
  bridge::ExternalFigures figures_;
  bool is_silent_ = false, is_late_ = false, is_held_ = false, is_refused_ = false;
};

}  // namespace waitpoint::run
