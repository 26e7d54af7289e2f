// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/repeatability.hpp"

#include <dlfcn.h>
#include <unwind.h>

#include <cstdint>
#include <cstdio>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/symbols.hpp"
#include "fibers/posix/program/program.hpp"

namespace waitpoint::posix {
namespace {

const void* base_of_library_with(const void* address) {
  Dl_info information{};
  return dladdr(address, &information) != 0 ? information.dli_fbase : nullptr;
}

/// The innermost frame that is neither ours nor the C library's.
struct FrameOfProgram {
  const void* own = base_of_library_with(reinterpret_cast<const void*>(&note_unrepeatable));
  const void* c_library = base_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  std::uintptr_t at = 0;
};

_Unwind_Reason_Code look_at_frame(_Unwind_Context* frame, void* to) {
  auto& search = *static_cast<FrameOfProgram*>(to);
  int is_before = 0;
  const std::uintptr_t at = _Unwind_GetIPInfo(frame, &is_before);
  const void* const base = base_of_library_with(reinterpret_cast<const void*>(at));
  if (base == search.own || base == search.c_library) return _URC_NO_REASON;
  search.at = is_before != 0 ? at : at - 1;  // the call, not what follows it
  return _URC_END_OF_STACK;
}

void write_place(char* text, std::size_t size) {
  FrameOfProgram search;
  {
    const InKernel unwinding;  // its locks are not to be simulated
    _Unwind_Backtrace(look_at_frame, &search);
  }
  const auto* const address = reinterpret_cast<const void*>(search.at);
  Dl_info information{};
  if (search.at == 0 || dladdr(address, &information) == 0 || information.dli_fname == nullptr) {
    std::snprintf(text, size, "at an unknown place");
    return;
  }
  const char* function = nullptr;
  const std::uintptr_t offset = function_at(address, function);
  std::snprintf(text, size, "at %s (%s+0x%llx)", function != nullptr ? function : "an unnamed function",
                information.dli_fname, static_cast<unsigned long long>(offset));
}

}  // namespace

void note_unrepeatable(const char* source) {
  if (!is_simulated() || record == nullptr || !record->settings.strict) return;
  char place[512], reason[1024];
  write_place(place, sizeof place);
  std::snprintf(reason, sizeof reason, "--strict: %.300s does not repeat: used by %s, %s", source,
                kernel::running->name, place);
  refuse(reason);
}

}  // namespace waitpoint::posix
