// SPDX-License-Identifier: BSD-3-Clause
// Code that a program makes at run time, as just-in-time compilers do: memory that is no part of a loaded file becomes
// executable. Its accesses to memory are no switch points, so that its size is reported.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// This memory is executable from now on; counted once, and not at all if it belongs to a loaded file.
void note_executable(const void* begin, std::size_t bytes);
/// Adds its bytes to `total` from now on; first those from before the run, of constructors.
void count_generated_code(std::uint64_t& total);

}  // namespace waitpoint::posix
