// SPDX-License-Identifier: BSD-3-Clause
// The processor whose instructions a source may name, in assembly or by intrinsics: x86-64, 64-bit ARM, or none.
//
// None in builds with -Dportable=true (WAITPOINT_PORTABLE) and on other processors: the rest is C++ as GCC and clang
// compile it, their vectors included. Every source that names instructions has such a version, which gives the same
// bits. What belongs to a processor's binary interface, as the registers in a signal's context, is no matter of this
// header.
#pragma once

#if defined(__x86_64__) && !defined(WAITPOINT_PORTABLE)
#define WAITPOINT_X86_64 1
#else
#define WAITPOINT_X86_64 0
#endif

#if defined(__aarch64__) && !defined(WAITPOINT_PORTABLE)
#define WAITPOINT_AARCH64 1
#else
#define WAITPOINT_AARCH64 0
#endif
