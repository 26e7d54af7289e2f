// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/trajectory_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/executive/looks.hpp"
#include "modules/executive/module_start.hpp"
#include "modules/executive/tracking_law.hpp"

namespace waitpoint::executive {

using namespace std::chrono_literals;

namespace {

constexpr Duration period = 50ms;
constexpr double near_m = 0.3, far_m = 0.8;
constexpr double degree = exact::pi / 180, near_rad = 20 * degree;
constexpr Duration progress = 1s, patience = 30s;

/// How much of the trajectory's time passes in a second, for a robot this far from its place.
double pace(double away_m) { return std::clamp((far_m - away_m) / (far_m - near_m), 0.0, 1.0); }

}  // namespace

TrajectoryFollower::TrajectoryFollower(const ExecutiveSetup& setup)
    : names_(setup.names),
      trajectory_(setup.trajectory->text, setup.trajectory->file),
      start_(setup.start),
      client_(names_, "executive"),
      speed_(names_.create_poster<posters::SpeedReference>(speed_poster, "executive")),
      goals_(1) {
  goals_.front().goal = trajectory_.at(trajectory_.duration()).pose.position();
  goals_.front().visits = 1;
  const Pose first = trajectory_.at(Duration()).pose, off = between(first, start_.pose);
  if (length(off.position()) > near_m || std::fabs(off.heading) > near_rad)
    throw BadInput(setup.trajectory->named_in, setup.trajectory->named_at,
                   fmt::format("expected a start near the trajectory's first pose, [{:.2f}, {:.2f}, {:.0f}]", first.x,
                               first.y, first.heading / degree));
}

void TrajectoryFollower::connect() {
  for (const char* module : {"rflex", "sick", "pom"})
    if (names_.find_module(module) == nullptr)
      throw BadInput("the executive", std::string("needs the module '") + module + "'");
  connect_for_executive(names_, position_);
}

void TrajectoryFollower::run() {
  start_modules(client_, names_, start_);
  posters::FusedPosition position;
  while (position_.read(position) != genom::PosterStatus::ok && !stopping_) threads::this_thread::sleep_for(period);
  follow();
  client_.call("rflex", "Stop");
  client_.call("sick", "Stop");
}

void TrajectoryFollower::follow() {
  GoalRecord& end = goals_.front();
  Time next = threads::now(), progressed_at = next;
  Duration reached, progressed_to;
  while (!stopping_ && end.state == GoalState::ahead) {
    posters::FusedPosition position;
    position_.read(position);
    const TrajectoryPoint wanted = trajectory_.at(reached);
    const Pose& pose = position.position.pose;
    const double away_m = length(wanted.pose.position() - pose.position());
    drive(tracking_speeds(wanted, pose));
    next = next + period;
    if (reached >= progressed_to + progress) {
      progressed_to = reached;
      progressed_at = next;
    }
    if (reached >= trajectory_.duration() && away_m < near_m)
      end.state = GoalState::reached;
    else if (next - progressed_at > patience)
      end.state = GoalState::given_up;
    reached = std::min(reached + Duration::from_seconds(pace(away_m) * period.seconds()), trajectory_.duration());
    threads::this_thread::sleep_until(next);
  }
  end.date = threads::now();
  if (end.state == GoalState::reached) ++end.times_reached;
}

void TrajectoryFollower::drive(const posters::SpeedInput& speeds) {
  speed_.write({threads::now(), speeds.v_m_s, speeds.w_rad_s, ++references_});
}

}  // namespace waitpoint::executive
