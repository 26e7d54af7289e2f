// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/executive.hpp"

#include <algorithm>

namespace waitpoint::executive {

using genom::PosterStatus;
using posters::GoToInput;
using namespace std::chrono_literals;

namespace {
constexpr Duration look_period = 500ms;
constexpr std::size_t looks_kept = 20;  // slightly longer than the patience of `ndd`
}  // namespace

Executive::Executive(genom::NameSpace& names, const Parameters& parameters, std::shared_ptr<const KnownSpace> known,
                     const posters::KnownPose& start, const std::vector<Point>& goals, const RandomStream& random)
    : names_(names),
      parameters_(parameters),
      client_(names, "executive"),
      planner_(std::move(known), parameters.planning),
      mission_(planner_, parameters.mission, goals, random),
      start_(start) {}

void Executive::connect() {
  for (const char* module : {"rflex", "sick", "pom", "ndd"})
    if (names_.find_module(module) == nullptr)
      throw BadInput("the executive", std::string("needs the module '") + module + "'");
  for (genom::PosterLinkBase* link :
       {static_cast<genom::PosterLinkBase*>(&position_), static_cast<genom::PosterLinkBase*>(&echoes_)}) {
    genom::PosterBase* poster = names_.find_poster(link->name());
    if (poster == nullptr || !link->connect(*poster))
      throw BadInput("the executive",
                     "reads poster '" + link->name() + "', which no module of this robot writes with that type");
  }
}

void Executive::run() {
  start_modules();
  wait_for_position();
  // A separate statement: the order of evaluation of arguments differs between compilers, and the read may take time.
  Point here = position();
  const Order* order = planned(mission_.start(threads::now(), here));
  while (order->kind != Order::Kind::finished && !stopping_) {
    if (order->kind == Order::Kind::wait) {
      threads::this_thread::sleep_until(order->until);
      here = position();
      order = planned(mission_.waited(threads::now(), here));
      continue;
    }
    const std::optional<genom::Report> report = drive(order->via_points);
    if (!report) break;
    here = position();
    order = planned(*report == genom::ok ? mission_.arrived(threads::now(), here)
                                         : mission_.blocked(threads::now(), here, seen()));
  }
  stop_modules();
}

// Adds the cost of planning the order.
const Order* Executive::planned(const Order& order) const {
  if (order.kind != Order::Kind::finished) threads::compute(parameters_.plan_cost_us);
  return &order;
}

void Executive::start_modules() {
  client_.call("rflex", "SetPos", start_);
  client_.call("pom", "SetPos", start_);
  client_.send("sick", "ContinuousShot");
  // A robot without SLAM relies on its odometry.
  if (names_.find_module("segloc") != nullptr) client_.send("segloc", "Localise", start_);
  client_.send("rflex", "TrackSpeedStart");
}

void Executive::wait_for_position() {
  posters::FusedPosition position;
  posters::Echoes echoes;
  while ((position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty) && !stopping_)
    threads::this_thread::sleep_for(50ms);
}

void Executive::stop_modules() {
  client_.call("ndd", "Stop");
  client_.call("rflex", "Stop");
  client_.call("sick", "Stop");
}

Point Executive::position() const {
  posters::FusedPosition position;
  position_.read(position);
  return position.position.pose.position();
}

// Sends the via points and waits for the final report, recording echoes meanwhile; nothing if stopped. Via points
// beyond one request's capacity follow in the next.
std::optional<genom::Report> Executive::drive(std::span<const Point> via_points) {
  looks_.clear();
  while (!via_points.empty()) {
    GoToInput input;
    const std::size_t count = std::min(via_points.size(), posters::via_point_count_max);
    for (const Point point : via_points.first(count)) input.via.push_back(point);
    std::optional<std::uint32_t> request;
    while (!(request = client_.send("ndd", "GoTo", input))) threads::this_thread::sleep_for(look_period);
    std::optional<genom::Reply> reply;
    while (!reply || reply->send_id != *request || !reply->final) {
      if (stopping_) return std::nullopt;
      reply = client_.receive(look_period);
      if (!reply) look();
    }
    if (reply->report != genom::ok) return reply->report;
    via_points = via_points.subspan(count);
  }
  return genom::ok;
}

// Keeps the current echoes: when the way is reported as blocked, the robot may face away from the obstacle.
void Executive::look() {
  posters::FusedPosition position;
  posters::Echoes echoes;
  if (position_.read(position) == PosterStatus::empty || echoes_.read(echoes) == PosterStatus::empty) return;
  std::vector<Point> points;
  const Pose device = compose(position.position.pose, echoes.mount);
  for (std::size_t i = 0; i < echoes.scan.range_m.size(); ++i) {
    const double range = static_cast<double>(echoes.scan.range_m[i]);
    if (range >= parameters_.mark_range_m || range >= echoes.scan.range_max_m) continue;
    const auto [s, c] =
        exact::sincos(echoes.scan.first_angle_rad + echoes.scan.angle_step_rad * static_cast<double>(i));
    points.push_back(transform(device, {range * c, range * s}));
  }
  looks_.push_back(std::move(points));
  if (looks_.size() > looks_kept) looks_.pop_front();
}

std::vector<Point> Executive::seen() const {
  std::vector<Point> points;
  for (const std::vector<Point>& look : looks_) points.insert(points.end(), look.begin(), look.end());
  return points;
}

}  // namespace waitpoint::executive
