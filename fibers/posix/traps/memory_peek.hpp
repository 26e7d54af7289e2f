// SPDX-License-Identifier: BSD-3-Clause
// The program's memory, which may be protected, without a fault.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// False if it is not readable.
bool peek(std::uint64_t address, void* to, std::size_t bytes);
/// False if it is not writable.
bool poke(std::uint64_t address, const void* from, std::size_t bytes);

}  // namespace waitpoint::posix
