// SPDX-License-Identifier: BSD-3-Clause
//
// The report of a bug of ours (core/error.hpp) without the C++ runtime that the library does not have.
#include <cstdio>
#include <cstdlib>

#include "core/error.hpp"

namespace waitpoint {

void bug(const char* file, int line, const char* condition, const char* message) {
  std::fprintf(stderr, "waitpoint: bug: %s (%s) at %s:%d\n", message, condition, file, line);
  waitpoint_describe_run();
  std::abort();
}

}  // namespace waitpoint
