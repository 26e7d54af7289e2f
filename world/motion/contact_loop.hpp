// SPDX-License-Identifier: BSD-3-Clause
// Moves all bodies of one step together: who stops where.
//
// An event loop over contact times within the step. All contacts of the earliest instant are judged together, on the
// state before it; a body whose own motion closes a gap stops there for the rest of the step, one that only opens gaps
// (driven into from behind, say) goes on; the contacts of whoever stopped are found anew from that instant. Every pair
// is computed in the order of its bodies' positions, so neither numbers nor names of bodies can change an outcome.
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
  /// Something that stands in the body's reach in this step.
  void add_obstacle(std::uint32_t body, const Outline& obstacle, const Heights& heights = {});
  /// Two different bodies that may meet in this step, each pair once.
  void add_pair(std::uint32_t body, std::uint32_t other);
  void run();

  /// After run(): the fraction of its arc at which the body stops; none if it moves to the end.
  const std::optional<double>& stop(std::uint32_t body) const { return bodies_[body].stop; }

 private:
  struct Body {
    Mover mover;
    std::optional<double> obstacle;  ///< first contact with something that does not move
    std::optional<double> stop;
    bool stops_now = false;
  };
  struct Pair {
    std::uint32_t first, second;
    std::optional<Contact> contact;
  };

  std::optional<double> earliest() const;
  void judge(double now);
  void stop_judged(double now);

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
};

}  // namespace waitpoint::world
