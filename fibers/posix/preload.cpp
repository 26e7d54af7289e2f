// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/preload.hpp"

#include <cstdlib>
#include <cstring>

namespace waitpoint::posix {
namespace {

void take_first_away(const char* variable) {
  const char* const all = std::getenv(variable);
  const char* const others = all == nullptr ? nullptr : std::strchr(all, ':');
  if (others == nullptr)
    unsetenv(variable);
  else
    setenv(variable, others + 1, 1);
}

}  // namespace

void leave_preload() { take_first_away("LD_PRELOAD"); }
void leave_library_path() { take_first_away("LD_LIBRARY_PATH"); }

}  // namespace waitpoint::posix
