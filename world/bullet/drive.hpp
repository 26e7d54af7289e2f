// SPDX-License-Identifier: BSD-3-Clause
// A drive: motors of limited force between a hull and the floor, as a constraint.
//
// Its rows are velocities of the hull: along, across, about the vertical (and upwards, in the air). The solver finds
// the impulses that bring them to their targets, each within force times step, together with all contacts: so a drive
// held by a wall exerts its greatest force and no more, and a free one reaches its target exactly.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "world/bullet/drive_aim.hpp"

namespace waitpoint::world {

class Drive final : public btTypedConstraint {
 public:
  Drive(btRigidBody& hull, bool flies) : btTypedConstraint(MAX_CONSTRAINT_TYPE, hull), flies_(flies) {}

  /// Sets the target of the following steps. The motors act along and across `direction`, at `from_centre`: a
  /// horizontal vector in the world frame from the hull's centre.
  void aim(const DriveAim& aim, Point direction, Point from_centre) {
    aim_ = aim;
    direction_ = direction;
    from_centre_ = from_centre;
  }

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = flies_ ? 4 : 3;
    info->nub = 0;
  }

  void getInfo2(btConstraintInfo2* info) override {
    const btVector3 at(from_centre_.x, from_centre_.y, 0);
    const btVector3 along(direction_.x, direction_.y, 0), across(-direction_.y, direction_.x, 0), up(0, 0, 1);
    set(*info, 0, along, at.cross(along), aim_.velocity.v_m_s, aim_.force_n);
    set(*info, 1, across, at.cross(across), aim_.velocity.side_m_s, aim_.side_force_n);
    set(*info, 2, btVector3(0, 0, 0), up, aim_.velocity.w_rad_s, aim_.torque_nm);
    if (flies_) set(*info, 3, up, btVector3(0, 0, 0), aim_.velocity.climb_m_s, aim_.climb_force_n);
  }

  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  static void set(btConstraintInfo2& info, int row, const btVector3& way, const btVector3& turn, double target,
                  double force) {
    const int first = row * info.rowskip;
    for (int k = 0; k < 3; ++k) {
      info.m_J1linearAxis[first + k] = way[k];
      info.m_J1angularAxis[first + k] = turn[k];
    }
    info.m_constraintError[first] = target;
    info.m_upperLimit[first] = force / info.fps;
    info.m_lowerLimit[first] = -force / info.fps;
  }

  bool flies_;
  DriveAim aim_;
  Point direction_ = {1, 0}, from_centre_;
};

}  // namespace waitpoint::world
