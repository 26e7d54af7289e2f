// SPDX-License-Identifier: BSD-3-Clause
// Stamps of logs as text: seconds with any number of decimals, kept to the nanosecond. Seconds since 1970 have more
// digits than a double.
#pragma once

#include <optional>
#include <string_view>

#include "core/time.hpp"

namespace waitpoint::logs {

/// Nothing unless the whole text is a decimal number, also with an exponent, whose nanoseconds a Time holds.
std::optional<Time> parse_stamp(std::string_view text);

}  // namespace waitpoint::logs
