// SPDX-License-Identifier: BSD-3-Clause
// Who may touch whom or what in a step, so that only they are asked for contacts.
//
// Neighbours are listed once for many steps, and each with a reserve: how far the two may go, together, before they can
// touch. A step then costs a comparison a body and one a listed pair; who has used up a reserve is measured again, and
// only who is that near goes through the contact loop. Lists are made anew when bodies may have come past their edge.
// (Verlet, "Computer experiments on classical fluids", Physical Review 159, 1967: lists with a skin.)
//
//   listed        all that was within the skin of the body's bounds when lists were made
//   skin used up  twice the longest path of each step since, in sum
//
// What is left out could not have had a contact: outcomes are those of asking all about all, to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "world/motion/contact_loop.hpp"
#include "world/slice/moving_solids.hpp"

namespace waitpoint::world {

/// What moves and stands, as it is before the step.
class MeetingPlace {
 public:
  virtual ~MeetingPlace() = default;
  virtual const Outline& outline(std::uint32_t body) const = 0;
  /// The body on its arc of this step.
  virtual Mover mover(std::uint32_t body) const = 0;
  /// The obstacles that the body could meet, and whose bounds overlap these; `found` is overwritten.
  virtual void near(std::uint32_t body, const Bounds& bounds, std::vector<std::uint32_t>& found) const = 0;
  virtual Mover obstacle(std::uint32_t obstacle) const = 0;
  /// How far the body is from an obstacle as seen from above: from what of it the body could meet without moving in the
  /// plane, or less.
  virtual double gap_m(std::uint32_t body, std::uint32_t obstacle) const = 0;
};

class Meetings {
 public:
  /// Of bodies with these outlines; the place must outlive it.
  Meetings(const MeetingPlace& place, std::span<const Shape> bodies);

  /// A hand has changed where bodies or obstacles are.
  void forget() { listed_ = false; }

  /// How a body moves in a step: its path as Mover's path_m(), and whether it moves at all.
  struct Motion {
    double path_m = 0;
    bool moves = false;
  };
  /// Finds who stops. Bodies start where the step before has left them.
  void step(std::span<const Motion> motions);
  /// After step(): the fraction of its arc at which the body stops; none if it moves to the end.
  std::optional<double> stop(std::uint32_t body) const {
    return in_loop_[body] == none ? std::nullopt : contacts_.stop(in_loop_[body]);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  struct Obstacle {
    std::uint32_t number;
    double reserve_m;  ///< no contact until the body's way since lists were made is longer
  };
  struct Pair {
    std::uint32_t body, other;
    double reserve_m;  ///< likewise of both ways together
  };
  struct Body {
    double way_m = 0;      ///< since lists were made, with this step
    double reserve_m = 0;  ///< the least of its obstacles'
    std::uint32_t first_obstacle = 0, last_obstacle = 0;
  };

  void list(double path_max_m);
  void meet_obstacles(std::uint32_t body, const Motion& motion);
  void meet(Pair& pair, std::span<const Motion> motions);
  std::uint32_t in_loop(std::uint32_t body);

  const MeetingPlace& place_;
  MovingSolids solids_;  // the bodies where they were when lists were made
  bool listed_ = false;
  double skin_m_ = 0, skin_used_m_ = 0;
  std::vector<Body> bodies_;
  std::vector<Obstacle> obstacles_;
  std::vector<Pair> pairs_;

  ContactLoop contacts_;
  std::vector<std::uint32_t> in_loop_;  // of each body its number there
  std::vector<std::uint32_t> entered_;
  std::vector<std::uint32_t> near_;
};

}  // namespace waitpoint::world
