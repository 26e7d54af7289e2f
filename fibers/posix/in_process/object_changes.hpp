// SPDX-License-Identifier: BSD-3-Clause
// Changes of the file of a program or library for a copy that is loaded beside others.
#pragma once

#include <cstdint>

#include "fibers/posix/in_process/object_file.hpp"

namespace waitpoint::posix {

/// Addresses within a copy, 0 for none.
struct ProgramParts {
  std::uint64_t main = 0;
  // Removed from the copy, and called when the program begins and ends.
  std::uint64_t initialise = 0, finish = 0;
  std::uint64_t constructors = 0, constructors_bytes = 0;
  std::uint64_t destructors = 0, destructors_bytes = 0;
  // Of its references to other objects.
  std::uint64_t relocations = 0, relocations_bytes = 0;
  std::uint64_t symbols = 0, strings = 0;
  std::uint64_t protected_begin = 0, protected_end = 0;  ///< read-only once it is loaded
};

/// Takes out what the layer does in place of the dynamic linker, and what would make the copy one with others: its
/// name, and symbols that are unique to a process.
void take_parts(ObjectFile& object, ProgramParts& parts);

/// Makes the references of a loaded object to the C library's variable `environ` refer to another one.
void redirect_environ(char* base, const ProgramParts& parts, char*** to);

/// Where it asks for versions of symbols of the library `name`, it asks the one whose name has the offset `to` from the
/// table of strings.
void rename_in_versions(ObjectFile& object, const char* name, std::uint64_t to);

/// Hides these from debuggers, which look for the names in the section of strings only, and else read no symbols.
void hide_versions(ObjectFile& object);

/// Links it to a further library, whose name has this offset, in place of something that was taken out: its names are
/// looked for there, as natively among those of the process.
void add_need(ObjectFile& object, std::uint64_t name);

/// True if the library defines malloc(). One allocator serves the process: memory is passed between a program and the C
/// library.
bool is_allocator(const char* file);

}  // namespace waitpoint::posix
