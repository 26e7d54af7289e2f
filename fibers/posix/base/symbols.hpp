// SPDX-License-Identifier: BSD-3-Clause
// The program's variables by name, as its symbol tables have them: those of static variables too, which the dynamic
// linker does not know.
#pragma once

namespace waitpoint::posix {

/// "jobs_lock", or "queue+40" for a part of one; null where no symbol has the address, as on the heap and on stacks.
/// What is returned stays. It reads the program's file, so it is for reports; nothing is taken from the program's heap.
const char* symbol_at(const void* address);

}  // namespace waitpoint::posix
