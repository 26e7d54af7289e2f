// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/contact_loop.hpp"

#include <tuple>

#include "core/error.hpp"

namespace waitpoint::world {

void ContactLoop::clear() {
  bodies_.clear();
  pairs_.clear();
}

void ContactLoop::add_body(const Mover& body) { bodies_.push_back({body, std::nullopt, std::nullopt, false}); }

void ContactLoop::add_obstacle(std::uint32_t body, const Outline& obstacle, const Heights& heights) {
  Body& b = bodies_[body];
  const std::optional<Contact> contact = first_contact(b.mover, Mover(obstacle, heights), 0);
  if (contact && (!b.obstacle || contact->fraction < *b.obstacle)) b.obstacle = contact->fraction;
}

void ContactLoop::add_pair(std::uint32_t body, std::uint32_t other) {
  // Two bodies are at one point only if one is above the other.
  const Mover &a = bodies_[body].mover, &b = bodies_[other].mover;
  const Point p = a.start().centre, q = b.start().centre;
  const bool in_order = std::tie(p.x, p.y, a.heights().low_m) < std::tie(q.x, q.y, b.heights().low_m);
  Pair pair = {in_order ? body : other, in_order ? other : body, std::nullopt};
  pair.contact = first_contact(bodies_[pair.first].mover, bodies_[pair.second].mover, 0);
  pairs_.push_back(pair);
}

std::optional<double> ContactLoop::earliest() const {
  std::optional<double> time;
  const auto take = [&](double t) {
    if (!time || t < *time) time = t;
  };
  for (const Body& body : bodies_) {
    if (!body.stop && body.obstacle) take(*body.obstacle);
  }
  for (const Pair& pair : pairs_) {
    if (pair.contact) take(pair.contact->fraction);
  }
  return time;
}

void ContactLoop::judge(double now) {
  for (Body& body : bodies_) body.stops_now = !body.stop && body.obstacle == now;
  for (const Pair& pair : pairs_) {
    if (!pair.contact || pair.contact->fraction != now) continue;
    Body &first = bodies_[pair.first], &second = bodies_[pair.second];
    if (pair.contact->first_closes && first.mover.moves()) first.stops_now = true;
    if (pair.contact->second_closes && second.mover.moves()) second.stops_now = true;
    WAITPOINT_CHECK(first.stops_now || second.stops_now, "a contact that nobody's motion closes");
  }
}

void ContactLoop::stop_judged(double now) {
  for (Body& body : bodies_) {
    if (!body.stops_now) continue;
    body.stop = now;
    body.mover = body.mover.stopped_at(now);
  }
  for (Pair& pair : pairs_) {
    const Body &first = bodies_[pair.first], &second = bodies_[pair.second];
    if (first.stops_now || second.stops_now) pair.contact = first_contact(first.mover, second.mover, now);
  }
}

void ContactLoop::run() {
  // Every round stops a body for good, so there are at most as many rounds as bodies.
  while (const std::optional<double> now = earliest()) {
    judge(*now);
    stop_judged(*now);
  }
}

}  // namespace waitpoint::world
