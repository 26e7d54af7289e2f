// SPDX-License-Identifier: BSD-3-Clause
// A robot's shape and where its sensors are, from a URDF (http://wiki.ros.org/urdf/XML).
//
//   <robot>      <link>, <joint>
//   <link>       name, <collision>
//   <collision>  <origin xyz rpy>, <geometry>: <box size>, <cylinder radius length>, <sphere radius>,
//                <mesh filename scale>
//   <joint>      name, type, <parent link>, <child link>, <origin xyz rpy>
//
// Links hang together by joints as a tree; joints that move stand at 0. A body of this world is one upright solid on
// the floor: where the file has one such, that; else the smaller of the upright box about all, and of the cylinder
// about all whose middle is the root link's. A mesh is taken as the upright
// prism over its convex outline as seen from above (what is thinner than 0.1 mm as the box about it), and told. Its
// file is a path relative to the URDF, also behind "file://", or "package://NAME/PATH": PATH in a folder NAME that the
// URDF is in, or that lies in one of those. Everything else (<visual>, <inertial>, <transmission>, <gazebo>, ...) is
// left out and told, so is a mesh whose file is missing or of a kind that this program does not read.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/space_pose.hpp"

namespace waitpoint::world {

/// A link's frame in the root link's. Heights are above the floor.
struct UrdfFrame {
  std::string link;
  SpacePose pose;
};

struct UrdfRobot {
  std::string name;
  Shape shape;                    ///< in the root link's frame
  std::vector<UrdfFrame> frames;  ///< of all links, the root first, each behind its parent
};

/// Reads the contents of a URDF file; `file` is its name, for messages. What reaches below the root link's height
/// stands on the floor, and all heights are counted from there. BadInput, naming file and line, for what is no XML or
/// no URDF, a number that is none or out of bounds, links that are no tree, more than 10 000 of them, and for a robot
/// of which nothing collides.
UrdfRobot parse_urdf(const std::string& contents, const std::string& file, LeftOut& left_out);

}  // namespace waitpoint::world
