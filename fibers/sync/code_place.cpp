// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/code_place.hpp"

#include <dlfcn.h>

namespace waitpoint::sync {

CodePlace code_place_of(const void* return_address) {
  // The call is before the address it returns to.
  const char* const call = static_cast<const char*>(return_address) - 1;
  Dl_info info{};
  if (dladdr(call, &info) == 0 || info.dli_fname == nullptr) return {};
  return {info.dli_fname, reinterpret_cast<std::uintptr_t>(call) - reinterpret_cast<std::uintptr_t>(info.dli_fbase),
          info.dli_sname != nullptr ? info.dli_sname : ""};
}

}  // namespace waitpoint::sync
