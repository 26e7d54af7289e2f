// SPDX-License-Identifier: BSD-3-Clause
// Many draws of a random stream at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/random.hpp"

namespace waitpoint {

/// The pairs of standard normals with the indices from `first` on: the bits of RandomStream::normal_pair().
void normal_pairs(const RandomStream& stream, std::uint64_t tick, std::uint64_t first,
                  std::span<std::array<double, 2>> pairs);

}  // namespace waitpoint
