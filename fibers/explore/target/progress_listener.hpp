// SPDX-License-Identifier: BSD-3-Clause
// Is told how far an exploration is.
#pragma once

#include <cstdint>
#include <string>

namespace waitpoint::exploration {

class ProgressListener {
 public:
  virtual ~ProgressListener() = default;

  /// Counts so far: schedules, distinct ones, failures.
  virtual void update(std::uint64_t schedules, std::uint64_t distinct, std::uint64_t failures) = 0;
  /// Another activity, in words.
  virtual void update(const std::string& words) = 0;
  /// Other text follows.
  virtual void finish() = 0;
};

}  // namespace waitpoint::exploration
