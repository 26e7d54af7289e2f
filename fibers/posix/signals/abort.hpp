// SPDX-License-Identifier: BSD-3-Clause
// What abort() does before it ends the program.
#pragma once

namespace waitpoint::posix {

/// Sends SIGABRT to the running thread, if the program has a handler, which can only leave by a jump. It may be
/// blocked.
void raise_abort();

}  // namespace waitpoint::posix
