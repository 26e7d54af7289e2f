// SPDX-License-Identifier: BSD-3-Clause
// A schedule of a scenario as a file, for schedules too long for a token.
//
//   waitpoint schedule 1
//   scenario 9f3a2c1b00112233                     digest of the scenario's files and options
//   drawn portfolio 1 17                          strategy, seed, number: the source of the noise
//   from 0.000000000                              end of the shared part in the default order
//   digest wp1:0123456789abcdef 4Fx0s             of the run; its trail, if known
//   task 00000000000000aa 12 00000000000000bb 7   event 7 of task bb occurs instead of event 12 of task aa
//   computing 00000000000000aa 13 62              event 13 of task aa chooses alternative 62
//
// From the sixth line on: the switches away from the default order, in any order. They name tasks and their event
// numbers, so that the file remains valid when the code around them is edited.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/explore/schedules/trail.hpp"
#include "fibers/explore/strategies/schedule.hpp"

namespace waitpoint::tools {

struct StoredSchedule {
  std::uint64_t fingerprint = 0;
  std::string strategy;
  std::uint64_t seed = 0, number = 0;
  Time from;
  std::uint64_t digest = 0;
  std::vector<exploration::Switch> switches;
  exploration::Trail trail = {};
};

/// The line of the file, counted from 1, of switch number `index`.
inline constexpr int line_of_switch(std::size_t index) { return static_cast<int>(index) + 6; }

std::string to_text(const StoredSchedule& schedule);
/// BadInput, with file and line, for an invalid file.
StoredSchedule read_schedule(const std::filesystem::path& file);

}  // namespace waitpoint::tools
