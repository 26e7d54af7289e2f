// SPDX-License-Identifier: BSD-3-Clause
// Names of the program's variables and functions, from its symbol tables, including static ones, which are unknown to
// the dynamic linker.
#pragma once

#include <cstdint>

namespace waitpoint::posix {

/// "jobs_lock", or "queue+40" for a part of one; null where no symbol covers the address, as on the heap and on stacks.
/// The string is never freed. For reports: it reads the program's file. It uses nothing of the program's heap.
const char* symbol_at(const void* address);
/// The offset of an address of code in its module's file, as debugging information counts. `function` becomes the name
/// of the function there, or null.
std::uintptr_t function_at(const void* address, const char*& function);

}  // namespace waitpoint::posix
