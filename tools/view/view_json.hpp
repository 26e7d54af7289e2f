// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the view as JSON: times as integers of nanoseconds, lengths in metres to a tenth of a millimetre, angles
// in radians to a ten-thousandth. Shapes and structures of fields as JSON objects.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "core/field_text.hpp"
#include "core/pose.hpp"
#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools::view {

using Json = nlohmann::ordered_json;

/// A number with at most four decimals.
inline double rounded(double value) { return std::round(value * 1e4) / 1e4; }

/// As rounded(), appended as text: for values that are written many times a second.
void append_number(std::string& text, double value);
/// "[a,b,c]".
void append_numbers(std::string& text, std::span<const double> values);

/// {"name", "outline" or "x", "y", "radius", "low", "high", "known"}.
Json obstacle(const world::Obstacle& obstacle);
/// {"outline" or "radius", "low", "high"}: the shape of a body, in its own frame.
Json body(const world::Shape& shape);
/// {"name", "kind", "parts"}.
Json fields(const FieldShape& shape);

/// Texts of a run may have any bytes: invalid UTF-8 is replaced.
std::string text_of(const Json& json);

}  // namespace waitpoint::tools::view
