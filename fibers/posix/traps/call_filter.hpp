// SPDX-License-Identifier: BSD-3-Clause
// Filters of the system's (seccomp) that trap system calls by the address of the code that makes them: the process gets
// SIGSYS in place of the call. A filter cannot be removed.
#pragma once

#include <cstdint>

#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {

/// Of code in a range: the waits on futexes; these, and reading and writing; reading and writing of one descriptor.
enum class Trapped : std::uint8_t { futexes, futexes_and_streams, stream };

/// False for a range whose addresses a filter cannot compare.
bool can_be_told_from_others(LibraryRange range);
/// `descriptor`: with Trapped::stream. False if the system does not allow it.
bool install_filter(LibraryRange range, Trapped what, std::uint32_t descriptor = 0);

}  // namespace waitpoint::posix
