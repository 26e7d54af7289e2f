// SPDX-License-Identifier: BSD-3-Clause
#include "world/bullet/drive_forces.hpp"

#include <algorithm>

#include "world/bullet/loose_solid.hpp"

namespace waitpoint::world {
namespace {

using Kind = BaseDescription::Kind;

bool goes_anyway(Kind kind) { return kind == Kind::omni || kind == Kind::aerial; }

}  // namespace

DriveAim forces_of(const BodyDescription& body) {
  const BaseDescription& base = body.base;
  const double grip_n = base.grip * base.mass_kg * gravity_m_s2;
  DriveAim forces;
  forces.force_n = base.drive_force_n > 0 ? base.drive_force_n : 2 * base.mass_kg * base.v_acceleration_m_s2;
  if (base.kind != Kind::aerial) forces.force_n = std::min(forces.force_n, grip_n);
  forces.side_force_n = goes_anyway(base.kind) ? forces.force_n : grip_n;
  forces.torque_nm = 2 * inertia_kg_m2(body.shape, base.mass_kg) * base.w_acceleration_rad_s2;
  forces.climb_force_n = 2 * base.mass_kg * base.climb_acceleration_m_s2;
  return forces;
}

}  // namespace waitpoint::world
