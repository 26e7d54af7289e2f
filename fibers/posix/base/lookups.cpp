// SPDX-License-Identifier: BSD-3-Clause
//
// dlsym(): a library that has a pthread_create() of its own looks for the one behind it, to call that. Allocators and
// profilers do. Behind the program's libraries only the C library has one, and what that makes would be a thread of the
// system: what is found is ours.
#include <dlfcn.h>
#include <pthread.h>

#include <cstring>

#include "fibers/posix/base/interposed.hpp"

// Whose call it is, dlsym() sees by where it returns to, so that no function of C++ can stand in front of it.
asm(R"(
  .text
  .globl dlsym
  .type dlsym, @function
dlsym:
  .cfi_startproc
  endbr64
  pushq %rdi
  .cfi_adjust_cfa_offset 8
  pushq %rsi
  .cfi_adjust_cfa_offset 8
  subq $8, %rsp
  .cfi_adjust_cfa_offset 8
  call waitpoint_ours_behind
  addq $8, %rsp
  .cfi_adjust_cfa_offset -8
  popq %rsi
  .cfi_adjust_cfa_offset -8
  popq %rdi
  .cfi_adjust_cfa_offset -8
  testq %rax, %rax
  je 1f
  ret
1:
  pushq %rdi
  .cfi_adjust_cfa_offset 8
  pushq %rsi
  .cfi_adjust_cfa_offset 8
  subq $8, %rsp
  .cfi_adjust_cfa_offset 8
  call waitpoint_own_dlsym
  addq $8, %rsp
  .cfi_adjust_cfa_offset -8
  popq %rsi
  .cfi_adjust_cfa_offset -8
  popq %rdi
  .cfi_adjust_cfa_offset -8
  jmpq *%rax
  .cfi_endproc
  .size dlsym, .-dlsym
)");

extern "C" {

[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_ours_behind(void* where, const char* name) {
  if (where != RTLD_NEXT || name == nullptr || std::strcmp(name, "pthread_create") != 0) return nullptr;
  return reinterpret_cast<void*>(&pthread_create);
}

// By its version it is found without itself.
[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_own_dlsym() {
  static constinit void* known = nullptr;
  for (const char* const version : {"GLIBC_2.34", "GLIBC_2.2.5"})
    if (known == nullptr) known = dlvsym(RTLD_NEXT, "dlsym", version);
  WAITPOINT_CHECK(known != nullptr, "the C library has no dlsym() of a known version");
  return known;
}
}
