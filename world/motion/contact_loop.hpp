// SPDX-License-Identifier: BSD-3-Clause
// Moves all bodies of one step together, and finds the bodies that stop and the fractions at which they do.
//
// An event loop over contact times within the step. All contacts of the earliest instant are judged together, on the
// state before it. A body whose own motion closes a gap stops there for the rest of the step; a body that only opens
// gaps (hit from behind, for example) continues. The contacts of the stopped bodies are recomputed from that instant.
// Every pair is computed in the order of its bodies' positions, so neither numbers nor names of bodies change an
// outcome.
//
// Contacts are in a heap, and each body has a list of its pairs: the cost of a step depends on its events only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "world/motion/first_contact.hpp"

namespace waitpoint::world {

/// Reused from step to step, so that it allocates only while it grows.
class ContactLoop {
 public:
  void clear();
  /// Adds a body; bodies are numbered from 0 in the order they are added.
  void add_body(const Mover& body);
  /// Adds a fixed obstacle in the body's reach in this step.
  void add_obstacle(std::uint32_t body, const Mover& obstacle);
  void add_obstacle(std::uint32_t body, const Outline& obstacle, const Heights& heights = {}) {
    add_obstacle(body, Mover(obstacle, heights));
  }
  /// Adds two different bodies that may meet in this step; each pair at most once.
  void add_pair(std::uint32_t body, std::uint32_t other);
  void run();

  std::uint32_t bodies() const { return static_cast<std::uint32_t>(bodies_.size()); }
  /// After run(): the fraction of its arc at which the body stops; none if it moves to the end.
  const std::optional<double>& stop(std::uint32_t body) const { return bodies_[body].stop; }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  struct Body {
    Mover mover;
    std::optional<double> obstacle;  ///< fraction of the first contact with a fixed obstacle
    std::optional<double> stop;
    bool stops_now = false;
    std::uint32_t pairs = none;  ///< head of the list of its pairs, the last one first
  };
  struct Pair {
    std::uint32_t first, second;
    std::optional<Contact> contact;
    std::uint32_t next_of_first = none, next_of_second = none;
  };
  /// A contact at the time of its computation; later stops may have made it invalid.
  struct Event {
    double time;
    std::uint32_t body, pair;  ///< one of them is `none`: a body's first obstacle, or a pair
    bool operator>(const Event& other) const { return time > other.time; }
  };

  void wait_for(const Event& event);
  bool holds(const Event& event) const;
  std::optional<double> earliest();
  void judge(double now);
  void stops_now(std::uint32_t body);
  void stop_judged(double now);

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  std::vector<Event> events_;            // a heap, the earliest first
  std::vector<std::uint32_t> stopping_;  // the bodies that stop at this instant
};

}  // namespace waitpoint::world
