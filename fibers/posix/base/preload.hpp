// SPDX-License-Identifier: BSD-3-Clause
// What is put in front of the libraries of a process.
#pragma once

namespace waitpoint::posix {

/// Programs that this one starts are not simulated: this library, the first of those that they would preload, is taken
/// away.
void leave_preload();
/// The same of the first folder that they would look for libraries in.
void leave_library_path();

}  // namespace waitpoint::posix
