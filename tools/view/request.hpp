// SPDX-License-Identifier: BSD-3-Clause
// Requests of viewers: JSON objects whose members are of the expected kind and within bounds. Everything else is
// BadInput of one line, and reaches no copy of the run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/time.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// {"id", "ask", ...}: an object of few levels, with the text "ask", and a number, a text or nothing as "id".
Json read_request(std::string_view text);

/// A time in nanoseconds, put between the start and a century; fractions are rounded.
Time time_of(const Json& value, const char* key);
Time time_in(const Json& request, const char* key);
/// A whole number from `least` to `most`; without the member `otherwise`, if it is given.
std::int64_t whole_number_in(const Json& request, const char* key, std::int64_t least, std::int64_t most,
                             std::optional<std::int64_t> otherwise = std::nullopt);
/// True or false; without the member `otherwise`, if it is given.
bool flag_in(const Json& request, const char* key, std::optional<bool> otherwise = std::nullopt);

}  // namespace waitpoint::tools::view
