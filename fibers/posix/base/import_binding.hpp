// SPDX-License-Identifier: BSD-3-Clause
// The library's own calls of functions: they reach the C library, or the library's own definitions, though the program
// comes first in the dynamic linker's search order. A global variable `send` of the program, or a function of that
// name, would take the layer's calls of send() else.
#pragma once

namespace waitpoint::posix {

/// Binds the functions that this library calls, but those that allocate memory, which are the program's if it has some.
/// Once, before all else that the library does.
void bind_imports();

}  // namespace waitpoint::posix
