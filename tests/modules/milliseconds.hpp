// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint {

/// The time `n` milliseconds after the start.
inline Time ms(std::int64_t n) { return Time::from_ns(n * 1000000); }

}  // namespace waitpoint
