// SPDX-License-Identifier: BSD-3-Clause
// Names of the program's variables, from its symbol tables, including static variables, which are unknown to the
// dynamic linker.
#pragma once

namespace waitpoint::posix {

/// "jobs_lock", or "queue+40" for a part of one; null where no symbol covers the address, as on the heap and on stacks.
/// The string is never freed. For reports: it reads the program's file. It uses nothing of the program's heap.
const char* symbol_at(const void* address);

}  // namespace waitpoint::posix
