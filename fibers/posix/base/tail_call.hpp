// SPDX-License-Identifier: BSD-3-Clause
// A wrapper of a function that identifies its caller by the return address, as dlsym() and dlopen() do: it can be
// wrapped only by a tail call, not by a C++ function.
#pragma once

/// Assembler: calls `function`, and keeps the first two arguments and the alignment of the stack.
#define WAITPOINT_CALL_BESIDE_ARGUMENTS(function) \
  "  pushq %rdi\n"                                \
  "  .cfi_adjust_cfa_offset 8\n"                  \
  "  pushq %rsi\n"                                \
  "  .cfi_adjust_cfa_offset 8\n"                  \
  "  subq $8, %rsp\n"                             \
  "  .cfi_adjust_cfa_offset 8\n"                  \
  "  call " #function                             \
  "\n"                                            \
  "  addq $8, %rsp\n"                             \
  "  .cfi_adjust_cfa_offset -8\n"                 \
  "  popq %rsi\n"                                 \
  "  .cfi_adjust_cfa_offset -8\n"                 \
  "  popq %rdi\n"                                 \
  "  .cfi_adjust_cfa_offset -8\n"

/// Defines `name`, a function of two arguments: returns what `ours` does, unless null; else it becomes the function
/// whose address `own` returns.
#define WAITPOINT_TAIL_CALL(name, ours, own) \
  asm("  .text\n"                                            \
      "  .globl " #name "\n"                                 \
      "  .type " #name ", @function\n" #name                 \
      ":\n"                                                  \
      "  .cfi_startproc\n"                                   \
      "  endbr64\n" WAITPOINT_CALL_BESIDE_ARGUMENTS(ours)    \
      "  testq %rax, %rax\n"                                 \
      "  je 1f\n"                                            \
      "  ret\n"                                              \
      "1:\n" WAITPOINT_CALL_BESIDE_ARGUMENTS(own)            \
      "  jmpq *%rax\n"                                       \
      "  .cfi_endproc\n"                                     \
      "  .size " #name ", .-" #name "\n")
