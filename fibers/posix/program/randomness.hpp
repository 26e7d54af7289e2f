// SPDX-License-Identifier: BSD-3-Clause
// Random numbers derived from the seed, in place of the system's, which differ in each run.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// The streams of numbers: those of one do not depend on how many of the others were drawn.
enum class Numbers { of_the_system, of_file_names, of_datagrams, count };

std::uint64_t draw_random(Numbers = Numbers::of_the_system);
void fill_with_random(void* buffer, std::size_t size);
/// Redraws the kernel's random bytes for a new process (AT_RANDOM).
void draw_random_bytes_of_the_process();

}  // namespace waitpoint::posix
