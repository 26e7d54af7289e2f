// SPDX-License-Identifier: BSD-3-Clause
// Poses in space, as files give them: a rotation about fixed axes (roll about x, then pitch about y, then yaw about z)
// and a position.
#pragma once

#include <array>

namespace waitpoint::world {

struct SpaceVector {
  double x = 0, y = 0, z = 0;

  /// True if the magnitude of each coordinate is at most `bound`; false for NaN.
  constexpr bool is_within(double bound) const {
    return -bound <= x && x <= bound && -bound <= y && y <= bound && -bound <= z && z <= bound;
  }
  friend constexpr SpaceVector operator+(SpaceVector a, SpaceVector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr SpaceVector operator*(double k, SpaceVector a) { return {k * a.x, k * a.y, k * a.z}; }
};

struct SpacePose {
  SpaceVector position;
  /// The frame's axes in the outer frame, unit vectors.
  std::array<SpaceVector, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  /// A vector of this frame, in the outer frame.
  SpaceVector turned(SpaceVector v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
};

SpacePose space_pose(SpaceVector position, double roll_rad, double pitch_rad, double yaw_rad);
/// `inner`, given in the frame `outer`, in the frame in which `outer` is given.
SpacePose compose(const SpacePose& outer, const SpacePose& inner);

}  // namespace waitpoint::world
