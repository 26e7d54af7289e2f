// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/clocks/block_counter.hpp"

namespace waitpoint::kernel {

std::uint64_t passed_blocks = 0;

}  // namespace waitpoint::kernel
