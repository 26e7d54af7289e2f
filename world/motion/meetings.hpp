// SPDX-License-Identifier: BSD-3-Clause
// The broad phase: the pairs of bodies, and of a body and an obstacle, that may touch in a step. Only these go through
// the contact loop.
//
// Neighbour lists serve many steps, with a reserve per pair: the sum of the paths that the two may travel before they
// can touch. A step then costs one comparison per body and one per listed pair; a pair whose reserve is used up is
// measured again, and goes through the contact loop only if it is near. Lists are rebuilt when bodies may have left the
// skin. (Verlet, "Computer experiments on classical fluids", Physical Review 159, 1967: lists with a skin.)
//
//   listed        everything within the skin of the body's bounds when the lists were built
//   skin used up  the sum, over the steps since, of twice the longest path of each step
//
// Pairs left out could not have had a contact: outcomes equal those of a test of all pairs, to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "world/motion/contact_loop.hpp"
#include "world/slice/moving_solids.hpp"

namespace waitpoint::world {

/// The bodies and obstacles, in their state before the step.
class MeetingPlace {
 public:
  virtual ~MeetingPlace() = default;
  virtual const Outline& outline(std::uint32_t body) const = 0;
  /// The body on its arc of this step.
  virtual Mover mover(std::uint32_t body) const = 0;
  /// The obstacles that the body could meet and that overlap these bounds; `found` is overwritten.
  virtual void near(std::uint32_t body, const Bounds& bounds, std::vector<std::uint32_t>& found) const = 0;
  virtual Mover obstacle(std::uint32_t obstacle) const = 0;
  /// A lower bound of the planar gap of a body and the part of an obstacle that it could meet at its heights in the
  /// step.
  virtual double gap_m(std::uint32_t body, std::uint32_t obstacle) const = 0;
};

class Meetings {
 public:
  /// For bodies with these shapes; the place must outlive it.
  Meetings(const MeetingPlace& place, std::span<const Shape> bodies);

  /// To be called when bodies or obstacles have changed by other means than steps.
  void forget() { listed_ = false; }

  /// A body's motion in a step: its path as in Mover::path_m().
  struct Motion {
    double path_m = 0;
    bool moves = false;
  };
  /// Finds the bodies that stop. One motion per body; bodies start where the previous step has left them.
  void step(std::span<const Motion> motions);
  /// After step(): the fraction of its arc at which the body stops; none if it moves to the end.
  std::optional<double> stop(std::uint32_t body) const {
    return in_loop_[body] == none ? std::nullopt : contacts_.stop(in_loop_[body]);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  struct Obstacle {
    std::uint32_t number;
    double reserve_m;  ///< no contact until the body's path since the lists were built exceeds this
  };
  struct Pair {
    std::uint32_t body, other;
    double reserve_m;  ///< likewise for the sum of both paths
  };
  struct Body {
    double way_m = 0;      ///< path since the lists were built, including this step
    double reserve_m = 0;  ///< the least of its obstacles'
    std::uint32_t first_obstacle = 0, last_obstacle = 0;
  };

  void list(double path_max_m);
  void meet_obstacles(std::uint32_t body, const Motion& motion);
  void meet(Pair& pair, std::span<const Motion> motions);
  std::uint32_t in_loop(std::uint32_t body);

  const MeetingPlace& place_;
  MovingSolids solids_;  // the bodies in their poses when the lists were built
  bool listed_ = false;
  double skin_m_ = 0, skin_used_m_ = 0;
  std::vector<Body> bodies_;
  std::vector<Obstacle> obstacles_;
  std::vector<Pair> pairs_;

  ContactLoop contacts_;
  std::vector<std::uint32_t> in_loop_;  // per body: its number in `contacts_`, or none
  std::vector<std::uint32_t> entered_;
  std::vector<std::uint32_t> near_;
};

}  // namespace waitpoint::world
