// SPDX-License-Identifier: BSD-3-Clause
// The empirical distribution functions of two logs' samples, as a picture: a frame for each quantity.
#pragma once

#include <span>
#include <string>

#include "tools/fit/comparison.hpp"

namespace waitpoint::tools {

/// SVG. The names are those of the logs, for the legend.
std::string comparison_picture_svg(const std::string& first_name, std::span<const Sample> first,
                                   const std::string& second_name, std::span<const Sample> second);

}  // namespace waitpoint::tools
