// SPDX-License-Identifier: BSD-3-Clause
// Shapes in a scenario: a box by two opposite corners, a rotated box by centre and size, a vertical cylinder by centre
// and radius, each from `low_m` (default 0) to `height_m` above the floor.
//
//   {corners_m: [x0, y0, x1, y1]}      {centre_m: [x, y], size_m: [length, width], heading_deg: 30}
//   {centre_m: [x, y], radius_m: 0.3}
#pragma once

#include <string>
#include <vector>

#include "modules/scenario/keys.hpp"
#include "modules/scenario/place_reader.hpp"
#include "modules/scenario/yaml_reader.hpp"
#include "world/description.hpp"

namespace waitpoint::scenario {

inline constexpr NumberRange friction_number{0, 1e3, "a number from 0 to 1000"};
inline constexpr NumberRange mass_number{1e-3, 1e6, "a number of kg from 0.001 to 1000000"};

const KeyTable& body_shape_keys();
const KeyTable& obstacle_keys();

/// A robot's body in its own frame: `centre_m` is optional, `height_m` is not.
world::Shape read_body_shape(const YamlNode& node);

/// The shape's name, or "shape N" without one; N is `number`, its position in the list, from 1.
std::string shape_name(const YamlNode& node, std::size_t number);

/// A shape of the world; a cylinder or rotated box needs `centre_m`. `height_m` is the default height.
world::Obstacle read_obstacle(const YamlNode& node, double height_m, std::size_t number);

}  // namespace waitpoint::scenario
