// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/ipc/named_objects.hpp"

#include "fibers/posix/ipc/system_v_ends.hpp"

namespace waitpoint::posix {

void forget_named_objects() {
  forget_named_semaphores();
  system_v::forget_memory();
  system_v::forget_messages();
  system_v::forget_semaphores();
}

}  // namespace waitpoint::posix
