// SPDX-License-Identifier: BSD-3-Clause
// Random numbers of the seed, where the system would give others to each run.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

std::uint64_t draw_random();
void fill_with_random(void* buffer, std::size_t size);
/// What the system has put into each new process (AT_RANDOM): drawn again.
void draw_random_bytes_of_the_process();

}  // namespace waitpoint::posix
