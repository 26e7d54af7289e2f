// SPDX-License-Identifier: BSD-3-Clause
// The budget for analysing a failure: a number of runs, and seconds of the wall clock.
#pragma once

#include <cstdint>

#include "tools/output/progress.hpp"

namespace waitpoint::tools {

class Budget {
 public:
  Budget(std::uint64_t runs, double seconds) : runs_(runs), end_s_(wall_clock_s() + seconds) {}

  /// Takes one run; false when the budget is exhausted.
  bool take() {
    if (used_ == runs_ || wall_clock_s() >= end_s_) return false;
    ++used_;
    return true;
  }
  std::uint64_t used() const { return used_; }

 private:
  std::uint64_t runs_, used_ = 0;
  double end_s_;
};

}  // namespace waitpoint::tools
