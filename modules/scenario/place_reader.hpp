// SPDX-License-Identifier: BSD-3-Clause
// Points and poses in a scenario: lists of numbers, or maps of them.
#pragma once

#include "core/pose.hpp"
#include "modules/scenario/form.hpp"

namespace waitpoint::scenario {

inline constexpr NumberRange heading_range{-3600, 3600, "degrees within ten turns"};

/// `[x, y]` or `{x_m: x, y_m: y}`.
Form<Point> point_form();
/// `[x, y, heading_deg]`, `[x, y]` or `{x_m: x, y_m: y, heading_deg: h}`.
Form<Pose> pose_form();
/// Of a heading in radians, in (-pi, pi].
Form<double> heading_form();

Point read_point(const YamlNode& node, std::string_view what);
Pose read_pose(const YamlNode& node, std::string_view what);
/// The key `heading_deg`; 0 if it is not given.
double read_heading(const YamlMap& map);

}  // namespace waitpoint::scenario
