// SPDX-License-Identifier: BSD-3-Clause
// The environment variables by which this library was loaded, undone for the programs that the process starts.
#pragma once

namespace waitpoint::posix {

/// Removes this library, the first of LD_PRELOAD: programs that this one starts are not simulated.
void leave_preload();
/// Removes the first folder of LD_LIBRARY_PATH.
void leave_library_path();

}  // namespace waitpoint::posix
