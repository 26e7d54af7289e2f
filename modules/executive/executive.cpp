// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/executive.hpp"

#include <algorithm>

#include "modules/executive/module_start.hpp"

namespace waitpoint::executive {

using posters::GoToInput;
using namespace std::chrono_literals;

namespace {
constexpr Duration look_period = 500ms;
constexpr Duration survey_period = 50ms;
// Of the motions of a robot that is lost.
constexpr double find_turn_rad_s = 0.7, find_distance_m = 3;
constexpr Duration find_patience = 15s;

posters::GoToInput first_of(std::span<const Point> via_points) {
  posters::GoToInput input;
  for (const Point point : via_points.first(std::min(via_points.size(), posters::via_point_count_max)))
    input.via.push_back(point);
  return input;
}
}  // namespace

void read(genom::Settings& settings, Parameters& parameters) {
  settings.read(parameters);
  settings.check_not_negative(parameters);
  constexpr double leg_least_m = 0.05;
  settings.check_least("planning.leg_m_max", parameters.planning.leg_m_max, leg_least_m);
  constexpr double escape_most_m = 100;  // it is searched cell by cell
  settings.check_most("planning.escape_m_max", parameters.planning.escape_m_max, escape_most_m);
}

Executive::Executive(const ExecutiveSetup& setup)
    : names_(setup.names),
      parameters_(setup.parameters),
      client_(names_, "executive"),
      planner_(setup.known, parameters_.planning),
      mission_(planner_, parameters_.mission, setup.goals, setup.random),
      start_(setup.start),
      looks_(parameters_.mark_range_m) {
  if (parameters_.replan_ms > Duration()) surveyor_.emplace(planner_.space().map(), parameters_.seen_range_m);
}

void Executive::connect() {
  for (const char* module : {"rflex", "sick", "pom", "ndd"})
    if (names_.find_module(module) == nullptr)
      throw BadInput("the executive", std::string("needs the module '") + module + "'");
  looks_.connect(names_);
  if (surveyor_) surveyor_->connect(names_);
  whereabouts_.connect(names_);
  if (!parameters_.start_known && !whereabouts_.has_localisation())
    throw BadInput("the executive", "needs the module 'locate' for a start that is not known");
}

void Executive::run() {
  start_modules(client_, names_, parameters_.start_known ? std::optional(start_) : std::nullopt);
  wait_for_position();
  if (lost()) find_robot();
  // A separate statement: the order of evaluation of arguments differs between compilers, and the read may take time.
  Point position = place_of_planning();
  const MissionOrder* order = planned(mission_.start(threads::now(), position));
  while (order->kind != MissionOrder::Kind::finished && !stopping_) {
    if (order->kind == MissionOrder::Kind::wait) {
      wait_until(order->until);
      position = place_of_planning();
      order = planned(mission_.waited(threads::now(), position));
      continue;
    }
    const std::optional<genom::Report> report = drive(order->via_points);
    if (!report && lost() && !stopping_) {
      find_robot();
      position = place_of_planning();
      order = planned(mission_.waited(threads::now(), position));
      continue;
    }
    if (!report) break;
    position = place_of_planning();
    order = planned(*report == genom::ok ? mission_.arrived(threads::now(), position)
                                         : mission_.blocked(threads::now(), position, looks_.seen()));
  }
  stop_modules();
}

// Adds the cost of planning the order.
const MissionOrder* Executive::planned(const MissionOrder& order) const {
  if (order.kind != MissionOrder::Kind::finished) threads::compute(parameters_.plan_cost_us);
  return &order;
}

void Executive::wait_for_position() {
  while (!looks_.have_begun() && !stopping_) threads::this_thread::sleep_for(50ms);
}

// The view of one turn decides in most places; among similar rooms it takes several.
void Executive::find_robot() {
  const Time until = threads::now() + Duration::from_seconds(parameters_.find_s);
  client_.call("ndd", "Stop");
  while (lost() && !stopping_ && threads::now() < until) {
    turn_on_the_spot(until);
    if (lost()) drive_on();
  }
  looks_.clear();
  if (surveyor_) surveyor_->forget();  // it was seen elsewhere
}

void Executive::turn_on_the_spot(Time until) {
  const Time whole = threads::now() + Duration::from_seconds(2 * exact::pi / find_turn_rad_s);
  client_.send("rflex", "GotoSpeed", posters::SpeedInput{.w_rad_s = find_turn_rad_s});
  while (lost() && !stopping_ && threads::now() < std::min(whole, until)) threads::this_thread::sleep_for(look_period);
  client_.send("rflex", "TrackSpeedStart");
}

void Executive::drive_on() {
  const auto place = whereabouts_.open_place(parameters_.planning.robot_radius_m, find_distance_m);
  if (!place) return;
  GoToInput input;
  input.via.push_back(*place);
  const Time patience = threads::now() + find_patience;
  const std::optional<std::uint32_t> request = client_.send("ndd", "GoTo", input);
  while (request && lost() && !stopping_ && threads::now() < patience) {
    const std::optional<genom::Reply> reply = client_.receive(look_period);
    if (reply && reply->send_id == *request && reply->final) return;
  }
  client_.call("ndd", "Stop");
}

void Executive::stop_modules() {
  client_.call("ndd", "Stop");
  client_.call("rflex", "Stop");
  client_.call("sick", "Stop");
}

void Executive::look() {
  if (surveyor_)
    surveyor_->look();
  else
    looks_.look();
}

// Where to plan from, with the obstacles seen until now.
Point Executive::place_of_planning() {
  if (surveyor_) {
    surveyor_->look();
    planner_.space().see(surveyor_->seen());
  }
  return looks_.position();
}

void Executive::wait_until(Time until) {
  if (!surveyor_) return threads::this_thread::sleep_until(until);
  while (threads::now() < until && !stopping_) {
    threads::this_thread::sleep_for(survey_period);
    surveyor_->look();
  }
}

// The via points to follow: `via_points`, or those of a better route, which `ndd` has got.
std::span<const Point> Executive::reroute(std::span<const Point> via_points) {
  if (threads::now() < next_plan_) return via_points;
  next_plan_ = threads::now() + parameters_.replan_ms;
  const Point position = place_of_planning();
  const MissionOrder* const order = mission_.replanned(position);
  threads::compute(parameters_.plan_cost_us);
  if (order == nullptr || !client_.send("ndd", "Reroute", first_of(order->via_points))) return via_points;
  return order->via_points;
}

// Sends the via points and waits for the final report, looking meanwhile; nothing if stopped, or lost. Via points
// beyond one request's capacity follow in the next.
std::optional<genom::Report> Executive::drive(std::span<const Point> via_points) {
  looks_.clear();
  const Duration period = surveyor_ ? survey_period : look_period;
  while (!via_points.empty()) {
    std::optional<std::uint32_t> request;
    while (!(request = client_.send("ndd", "GoTo", first_of(via_points)))) threads::this_thread::sleep_for(look_period);
    std::optional<genom::Reply> reply;
    while (!reply || reply->send_id != *request || !reply->final) {
      if (stopping_ || lost()) return std::nullopt;
      reply = client_.receive(period);
      if (reply) continue;
      look();
      if (surveyor_) via_points = reroute(via_points);
    }
    if (reply->report != genom::ok) return reply->report;
    via_points = via_points.subspan(std::min(via_points.size(), posters::via_point_count_max));
  }
  return genom::ok;
}

}  // namespace waitpoint::executive
