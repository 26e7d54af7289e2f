// SPDX-License-Identifier: BSD-3-Clause
// Objects that programs share by names and keys: named semaphores, and System V's objects.
#pragma once

namespace waitpoint::posix {

/// Frees all of them when their last user has ended.
void forget_named_objects();

/// Before the first fork: the processes of the family share what they open.
void share_named_semaphores();
void forget_named_semaphores();

}  // namespace waitpoint::posix
