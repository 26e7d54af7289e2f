// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/base/preload.hpp"

#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

// Through the C library's own functions: a program may define these names, as shells do, and be uninitialised yet.
void take_first_away(const char* variable) {
  const char* const all = WAITPOINT_NEXT(getenv)(variable);
  const char* const others = all == nullptr ? nullptr : std::strchr(all, ':');
  if (others == nullptr)
    WAITPOINT_NEXT(unsetenv)(variable);
  else
    WAITPOINT_NEXT(setenv)(variable, others + 1, 1);
}

}  // namespace

void leave_preload() { take_first_away("LD_PRELOAD"); }
void leave_library_path() { take_first_away("LD_LIBRARY_PATH"); }

}  // namespace waitpoint::posix
