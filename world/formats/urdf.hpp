// SPDX-License-Identifier: BSD-3-Clause
// A robot's shape and the frames of its links, from a URDF (http://wiki.ros.org/urdf/XML).
//
//   <robot>      <link>, <joint>
//   <link>       name, <collision>
//   <collision>  <origin xyz rpy>, <geometry>: <box size>, <cylinder radius length>, <sphere radius>,
//                <mesh filename scale>
//   <joint>      name, type, <parent link>, <child link>, <origin xyz rpy>
//
// Links form a tree, connected by joints; movable joints are at 0. A body is one upright solid on the floor: the file's
// only solid if it is upright; else the smaller of the upright bounding box and of the bounding cylinder centred at the
// root link, or the prism over the convex hull of the projection if that is smaller by a tenth. A mesh becomes the
// upright prism over the convex hull of its projection (a mesh thinner than 0.1 mm its bounding box), with a warning.
// Its file is a path relative to the URDF, with or without "file://", or "package://NAME/PATH": PATH in a folder NAME
// that contains the URDF, or is in a folder that does. A robot without <collision> has the shape of its <visual>, with
// a warning. Arguments of xacro are replaced (world/formats/xacro_arguments.hpp). Everything else (<visual>,
// <inertial>, <transmission>, <gazebo>, ...) is left out with a warning, and so are meshes with a missing or
// unsupported file.
#pragma once

#include <string>
#include <vector>

#include "world/description.hpp"
#include "world/formats/left_out.hpp"
#include "world/formats/xacro_arguments.hpp"
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
  std::vector<UrdfFrame> frames;  ///< of all links, the root first, each after its parent
};

/// Reads the contents of a URDF file; `file` is its name, for messages. If the robot extends below the root link, its
/// lowest point is on the floor, and heights are counted from there. BadInput, naming file and line, for malformed XML
/// or URDF, an invalid number or one out of range, links that do not form a tree, more than 10 000 links, for a robot
/// without geometry, and for an argument that the file does not have.
UrdfRobot parse_urdf(const std::string& contents, const std::string& file, LeftOut& left_out,
                     const XacroArguments& arguments = {});

}  // namespace waitpoint::world
