// SPDX-License-Identifier: BSD-3-Clause
// The chance that a schedule shows a new reads-from pair: as a search estimates it, and as further schedules measure
// it.
#pragma once

#include <cstdint>

#include "fibers/explore/search/new_pair_chance.hpp"
#include "tests/fibers/explore/completeness/program.hpp"

namespace waitpoint::completeness {

/// Of one program.
struct Calibration {
  exploration::NewPairChance chance;  ///< of a sample
  double share = 0;  ///< of the further schedules, each compared with the sample: those with a new pair

  bool holds() const { return chance.lower_bound <= share && share <= chance.upper_bound; }
};

/// By `sampled` schedules of `random`, at least two, and as many further ones as `measured` says.
Calibration calibrate(const Program& program, std::uint64_t sampled, std::uint64_t measured);

}  // namespace waitpoint::completeness
