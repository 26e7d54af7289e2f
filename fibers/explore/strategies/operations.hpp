// SPDX-License-Identifier: BSD-3-Clause
// Sets of operations.
#pragma once

#include <cstdint>

#include "fibers/kernel/operation.hpp"

namespace waitpoint::exploration {

class Operations {
 public:
  template <class... Each>
  explicit constexpr Operations(Each... each) : bits_((... | bit(each))) {}

  constexpr bool contain(kernel::Operation operation) const { return (bits_ & bit(operation)) != 0; }

 private:
  static constexpr std::uint64_t bit(kernel::Operation operation) {
    return std::uint64_t{1} << static_cast<unsigned>(operation);
  }
  static_assert(static_cast<unsigned>(kernel::Operation::call) < 64, "an operation is a bit of a word");

  std::uint64_t bits_;
};

}  // namespace waitpoint::exploration
