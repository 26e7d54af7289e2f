// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/contact_loop.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "core/error.hpp"

namespace waitpoint::world {

void ContactLoop::clear() {
  bodies_.clear();
  pairs_.clear();
  events_.clear();
}

void ContactLoop::add_body(const Mover& body) { bodies_.push_back({body, std::nullopt, std::nullopt}); }

void ContactLoop::add_obstacle(std::uint32_t body, const Mover& obstacle) {
  WAITPOINT_CHECK(body < bodies_.size() && !obstacle.moves(), "an obstacle moves, or its body was not added");
  Body& b = bodies_[body];
  const std::optional<Contact> contact = first_contact(b.mover, obstacle, 0);
  if (!contact || (b.obstacle && contact->fraction >= *b.obstacle)) return;
  b.obstacle = contact->fraction;
  wait_for({contact->fraction, body, none});
}

void ContactLoop::add_pair(std::uint32_t body, std::uint32_t other) {
  WAITPOINT_CHECK(body != other && body < bodies_.size() && other < bodies_.size(),
                  "a pair is of one body, or of one that was not added");
  // Two bodies are at one point only if one is above the other.
  const Mover &a = bodies_[body].mover, &b = bodies_[other].mover;
  const Point p = a.start().centre, q = b.start().centre;
  const bool in_order = std::tie(p.x, p.y, a.heights().low_m) < std::tie(q.x, q.y, b.heights().low_m);
  Pair pair = {in_order ? body : other, in_order ? other : body, std::nullopt};
  Body &first = bodies_[pair.first], &second = bodies_[pair.second];
  pair.contact = first_contact(first.mover, second.mover, 0);
  pair.next_of_first = first.pairs;
  pair.next_of_second = second.pairs;
  first.pairs = second.pairs = static_cast<std::uint32_t>(pairs_.size());
  if (pair.contact) wait_for({pair.contact->fraction, none, first.pairs});
  pairs_.push_back(pair);
}

void ContactLoop::wait_for(const Event& event) {
  WAITPOINT_CHECK(0 <= event.time && event.time < 1, "a contact is not within its step");
  WAITPOINT_FAST_CHECK((event.body == none) != (event.pair == none),
                       "a contact is not either an obstacle's or a pair's");
  events_.push_back(event);
  std::push_heap(events_.begin(), events_.end(), std::greater<>());
}

// True if the event is still valid: stops invalidate later ones.
bool ContactLoop::holds(const Event& event) const {
  if (event.pair == none) return !bodies_[event.body].stop && bodies_[event.body].obstacle == event.time;
  const std::optional<Contact>& contact = pairs_[event.pair].contact;
  return contact && contact->fraction == event.time;
}

std::optional<double> ContactLoop::earliest() {
  while (!events_.empty() && !holds(events_.front())) {
    std::pop_heap(events_.begin(), events_.end(), std::greater<>());
    events_.pop_back();
  }
  if (events_.empty()) return std::nullopt;
  return events_.front().time;
}

void ContactLoop::stops_now(std::uint32_t body) {
  if (bodies_[body].stops_now) return;
  bodies_[body].stops_now = true;
  stopping_.push_back(body);
}

void ContactLoop::judge(double now) {
  stopping_.clear();
  while (earliest() == now) {
    std::pop_heap(events_.begin(), events_.end(), std::greater<>());
    const Event event = events_.back();
    events_.pop_back();
    if (event.pair == none) {
      stops_now(event.body);
      continue;
    }
    const Pair& pair = pairs_[event.pair];
    if (pair.contact->first_closes && bodies_[pair.first].mover.moves()) stops_now(pair.first);
    if (pair.contact->second_closes && bodies_[pair.second].mover.moves()) stops_now(pair.second);
    WAITPOINT_CHECK(bodies_[pair.first].stops_now || bodies_[pair.second].stops_now,
                    "a contact that neither body's motion closes");
  }
}

void ContactLoop::stop_judged(double now) {
  for (const std::uint32_t number : stopping_) {
    Body& body = bodies_[number];
    body.stop = now;
    body.mover = body.mover.stopped_at(now);
    body.stops_now = false;
  }
  for (const std::uint32_t number : stopping_) {
    for (std::uint32_t at = bodies_[number].pairs; at != none;) {
      Pair& pair = pairs_[at];
      WAITPOINT_FAST_CHECK(pair.first == number || pair.second == number, "a body's list has a pair of two others");
      pair.contact = first_contact(bodies_[pair.first].mover, bodies_[pair.second].mover, now);
      if (pair.contact) wait_for({pair.contact->fraction, none, at});
      at = pair.first == number ? pair.next_of_first : pair.next_of_second;
    }
  }
}

void ContactLoop::run() {
  // Every round stops a body for the rest of the step, so there are at most as many rounds as bodies.
  double last = 0;
  std::size_t rounds = 0;
  while (const std::optional<double> now = earliest()) {
    WAITPOINT_CHECK(last <= *now, "a contact comes after a later one");
    WAITPOINT_CHECK(rounds < bodies_.size(), "more contacts than bodies stop a step");
    last = *now;
    ++rounds;
    judge(*now);
    stop_judged(*now);
  }
}

}  // namespace waitpoint::world
