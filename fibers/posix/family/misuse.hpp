// SPDX-License-Identifier: BSD-3-Clause
// Misuse of primitives and threads, which POSIX leaves undefined: the run continues as it would with the C library, and
// the misuse is reported.
#pragma once

#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {

/// The running thread misuses a primitive: "main" `does` "mutex m" `but`, and the name of `whom` unless null.
void note_misuse(const char* does, const Waitable& what, const char* but, const kernel::Task* whom = nullptr);
/// The same in words that need no more.
void note_misuse(const char* does);

/// Called with the sentence, unless null, in the thread.
extern void (*on_misuse)(const char* sentence);

/// Before the use of a primitive.
inline void check_is_there(const char* does, const Waitable& what) {
  if (__builtin_expect(what.is_freed, 0)) note_misuse(does, what, ", whose memory was freed");
}

}  // namespace waitpoint::posix
