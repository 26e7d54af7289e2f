// SPDX-License-Identifier: BSD-3-Clause
// What programs share by names and keys: named semaphores, and System V's objects.
#pragma once

namespace waitpoint::posix {

/// All of them, when nobody is left that uses any.
void forget_named_objects();

/// Before the first fork: what the processes open is theirs together.
void share_named_semaphores();
void forget_named_semaphores();

}  // namespace waitpoint::posix
