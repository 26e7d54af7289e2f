// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/robots_air.hpp"

#include <dlfcn.h>

#include <cmath>

#include "core/number_text.hpp"

namespace waitpoint::nodes {
namespace {

posix::Air::Medium medium_on_air(const io::Medium& medium) {
  return {.latency_least = medium.latency_least,
          .latency_most = medium.latency_most,
          .latency_per_metre = medium.latency_per_metre,
          .range_check = medium.range_check,
          .bandwidth_bit_s = medium.bandwidth_bit_s,
          .queue_bytes = medium.queue_bytes,
          .range_m = std::isinf(medium.range_m) ? 0 : medium.range_m,
          .loss = medium.loss};
}

}  // namespace

RobotsAir::RobotsAir(const scenario::Scenario& scenario, const std::vector<std::size_t>& robots) : robots_(robots) {
  const bool has_medium = scenario.medium && robots.size() > 1;
  if (!has_medium && scenario.ros.delay == Duration()) return;
  if (robots.size() >= posix::Air::robots_max)
    throw scenario.robots[robots.back()].written.bad("expected at most " + std::to_string(posix::Air::robots_max - 1) +
                                                     " robots with nodes and a medium or delay between them");
  const auto take = reinterpret_cast<posix::Air::Take>(dlsym(RTLD_DEFAULT, posix::Air::symbol));
  if (take == nullptr || (air_ = take()) == nullptr) return;
  air_->delay = scenario.ros.delay;
  if (has_medium) air_->medium = medium_on_air(*scenario.medium);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    auto& name = air_->robots[number_on_air(i)].name;
    name[scenario.robots[robots[i]].name.copy(name, sizeof name - 1)] = '\0';
  }
  air_->has_medium = has_medium;
}

void RobotsAir::move(const world::World& world) {
  if (air_ == nullptr) return;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Point at = world.body(static_cast<world::BodyId>(robots_[i])).pose.position();
    posix::Air::Robot& robot = air_->robots[number_on_air(i)];
    robot.x_m = at.x;
    robot.y_m = at.y;
  }
}

std::string RobotsAir::losses() const {
  std::uint64_t lost = 0, sent_again = 0;
  if (air_ != nullptr)
    for (const auto& from : air_->links)
      for (const posix::Air::Link& link : from) lost += link.lost, sent_again += link.sent_again;
  std::string text;
  if (lost > 0) text += ", " + counted(lost, "message") + " lost between robots";
  if (sent_again > 0) text += ", " + counted(sent_again, "piece") + " sent again between robots";
  return text;
}

}  // namespace waitpoint::nodes
