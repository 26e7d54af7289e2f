// SPDX-License-Identifier: BSD-3-Clause
//
// dlsym(): a library that wraps pthread_create(), as allocators and profilers do, looks up the next definition. Behind
// the program's libraries that would be the C library's, which makes a system thread; the lookup returns ours instead.
#include <dlfcn.h>
#include <pthread.h>

#include <cstring>

#include "fibers/posix/base/interposed.hpp"

// dlsym() identifies its caller by the return address, so it can be wrapped only by a tail call, not by a C++ function.
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

// Of threads/thread.cpp.
[[gnu::visibility("hidden")]] int waitpoint_own_pthread_create(pthread_t* id, const pthread_attr_t* attributes,
                                                               void* (*start)(void*), void* argument) noexcept;

[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_ours_behind(void* where, const char* name) {
  if (where != RTLD_NEXT || name == nullptr || std::strcmp(name, "pthread_create") != 0) return nullptr;
  return reinterpret_cast<void*>(&waitpoint_own_pthread_create);
}

// dlvsym() finds it by its version, without a call to dlsym().
[[gnu::visibility("hidden"), gnu::used]] void* waitpoint_own_dlsym() {
  static constinit void* known = nullptr;
  for (const char* const version : {"GLIBC_2.34", "GLIBC_2.2.5"})
    if (known == nullptr) known = dlvsym(RTLD_NEXT, "dlsym", version);
  WAITPOINT_CHECK(known != nullptr, "the C library has no dlsym() of a version known here");
  return known;
}
}
