// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/library_return.hpp"

#include <unwind.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {
namespace {

// One callback for all pending returns.
void (*to_be_called)() = nullptr;

struct FrameSearch {
  std::uintptr_t interrupted;
  const LibraryRange& library;
  bool (*is_of_program)(std::uintptr_t);
  bool is_within = false;          ///< past the handler's frames
  std::uintptr_t* slot = nullptr;  ///< of the return address to the program
};

_Unwind_Reason_Code look_at(_Unwind_Context* frame, void* to) {
  auto& search = *static_cast<FrameSearch*>(to);
  const std::uintptr_t at = _Unwind_GetIP(frame);
  if (!search.is_within) {
    search.is_within = at == search.interrupted;
    return _URC_NO_REASON;
  }
  if (search.library.contains(at)) return _URC_NO_REASON;
  auto* const slot = reinterpret_cast<std::uintptr_t*>(_Unwind_GetCFA(frame)) - 1;
  if (*slot == at && search.is_of_program(at)) search.slot = slot;
  return _URC_END_OF_STACK;
}

}  // namespace

extern "C" {

// The library returns here instead of to the program. Return values (integers, and the registers of fxsave) are kept.
// While the callback runs, unwinders see the program as its caller.
void waitpoint_library_returned();
asm(R"(
  .pushsection .text
  .hidden waitpoint_library_returned
  .globl waitpoint_library_returned
  .type waitpoint_library_returned, @function
  .cfi_startproc
  .cfi_undefined %rip
  nop
waitpoint_library_returned:
  subq $8, %rsp
  pushq %rax
  pushq %rdx
  pushq %rbp
  movq %rsp, %rbp
  .cfi_def_cfa %rbp, 32
  .cfi_offset %rbp, -32
  .cfi_offset %rip, -8
  subq $512, %rsp
  andq $-16, %rsp
  fxsave64 (%rsp)
  leaq 24(%rbp), %rdi
  call waitpoint_after_library
  fxrstor64 (%rsp)
  movq %rbp, %rsp
  popq %rbp
  .cfi_def_cfa %rsp, 24
  .cfi_restore %rbp
  popq %rdx
  .cfi_def_cfa_offset 16
  popq %rax
  .cfi_def_cfa_offset 8
  ret
  .cfi_endproc
  .size waitpoint_library_returned, . - waitpoint_library_returned
  .popsection
)");

[[gnu::visibility("hidden"), gnu::used]] void waitpoint_after_library(std::uintptr_t* slot) {
  WAITPOINT_CHECK(to_be_called != nullptr && this_thread().library_returns_to != 0,
                  "a call of a library returns to the layer, which does not know where it came from");
  *slot = this_thread().library_returns_to;
  const int error = errno;
  to_be_called();
  errno = error;
}
}

bool call_after_return(std::uintptr_t interrupted, const LibraryRange& library, bool (*is_of_program)(std::uintptr_t),
                       void (*then)()) {
  FrameSearch search{interrupted, library, is_of_program};
  {
    const InKernel unwinding;  // it locks, and calls pthread_once(), which must not be simulated
    _Unwind_Backtrace(look_at, &search);
  }
  if (search.slot == nullptr) return false;
  WAITPOINT_CHECK(to_be_called == nullptr || to_be_called == then, "two callbacks wait for returns of a library");
  to_be_called = then;
  this_thread().library_returns_to = *search.slot;
  *search.slot = reinterpret_cast<std::uintptr_t>(&waitpoint_library_returned);
  return true;
}

}  // namespace waitpoint::posix
