// SPDX-License-Identifier: BSD-3-Clause
// In place of bullet_world.cpp in builds without Bullet.
#include "world/bullet/bullet_world.hpp"

namespace waitpoint::world {

std::unique_ptr<VehicleWorld> make_bullet_world(const WorldDescription&, std::uint64_t) { return nullptr; }

}  // namespace waitpoint::world
