// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/executive.hpp"

#include <algorithm>

namespace waitpoint::executive {

using posters::GoToInput;
using namespace std::chrono_literals;

namespace {
constexpr Duration look_period = 500ms;
}  // namespace

Executive::Executive(genom::NameSpace& names, const Parameters& parameters, std::shared_ptr<const KnownSpace> known,
                     const posters::KnownPose& start, const std::vector<Point>& goals, const RandomStream& random)
    : names_(names),
      parameters_(parameters),
      client_(names, "executive"),
      planner_(std::move(known), parameters.planning),
      mission_(planner_, parameters.mission, goals, random),
      start_(start),
      looks_(parameters.mark_range_m) {}

void Executive::connect() {
  for (const char* module : {"rflex", "sick", "pom", "ndd"})
    if (names_.find_module(module) == nullptr)
      throw BadInput("the executive", std::string("needs the module '") + module + "'");
  looks_.connect(names_);
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
                                         : mission_.blocked(threads::now(), here, looks_.seen()));
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
  // A robot without localisation relies on its odometry.
  for (const char* module : {"segloc", "locate"})
    if (names_.find_module(module) != nullptr) client_.send(module, "Localise", start_);
  client_.send("rflex", "TrackSpeedStart");
}

void Executive::wait_for_position() {
  while (!looks_.have_begun() && !stopping_) threads::this_thread::sleep_for(50ms);
}

void Executive::stop_modules() {
  client_.call("ndd", "Stop");
  client_.call("rflex", "Stop");
  client_.call("sick", "Stop");
}

Point Executive::position() const { return looks_.position(); }

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
      if (!reply) looks_.look();
    }
    if (reply->report != genom::ok) return reply->report;
    via_points = via_points.subspan(count);
  }
  return genom::ok;
}

}  // namespace waitpoint::executive
