// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/code_place.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <cstdlib>
#include <memory>

namespace waitpoint::sync {

std::string demangled(const std::string& symbol) {
  // "m" alone would be "unsigned long".
  if (!symbol.starts_with("_Z")) return symbol;
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status),
                                                    std::free);
  return status == 0 ? name.get() : symbol;
}

CodePlace code_place_of(const void* return_address) {
  // The call is before the address it returns to.
  const char* const call = static_cast<const char*>(return_address) - 1;
  Dl_info info{};
  if (dladdr(call, &info) == 0 || info.dli_fname == nullptr) return {};
  return {info.dli_fname, reinterpret_cast<std::uintptr_t>(call) - reinterpret_cast<std::uintptr_t>(info.dli_fbase),
          info.dli_sname != nullptr ? info.dli_sname : ""};
}

}  // namespace waitpoint::sync
