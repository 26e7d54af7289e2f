// SPDX-License-Identifier: BSD-3-Clause
// When sensors that no module reads are read for software outside.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::outside {

/// True at the first of the world's steps from each multiple of the sensor's period on: for the step that the world has
/// just done, `steps` in all, of length `step`.
inline bool is_due(Duration period, Duration step, std::uint64_t steps) {
  const Duration now = step * static_cast<std::int64_t>(steps);
  return steps == 0 || now / period > (now - step) / period;
}

}  // namespace waitpoint::outside
