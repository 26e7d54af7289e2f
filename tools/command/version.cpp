// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/version.hpp"

#include <fmt/format.h>

#include "core/exact_math.hpp"

#ifndef WAITPOINT_VERSION
#define WAITPOINT_VERSION "unknown"
#endif
#ifndef WAITPOINT_FLAGS
#define WAITPOINT_FLAGS "unknown"
#endif

namespace waitpoint::tools {

std::string version_text() {
#ifdef __clang__
  constexpr const char* compiler = __VERSION__;
#else
  constexpr const char* compiler = "g++ " __VERSION__;
#endif
  return fmt::format("waitpoint {}\ncompiler  {}\nflags     {}\nmath      {:016x}", WAITPOINT_VERSION, compiler,
                     WAITPOINT_FLAGS, exact::fingerprint());
}

std::string version_line() {
  const std::string version = version_text();
  return version.substr(0, version.find('\n'));
}

}  // namespace waitpoint::tools
